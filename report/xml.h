// Text for XML, HTML, SVG and JSON.
#pragma once

#include <string>

namespace trunnion {

/// Safe as XML or HTML text and inside quoted attributes; control characters become '?'.
std::string escape_xml(const std::string& text);
/// Bytes that are not UTF-8 (comments of old controls) become '?': JSON and XML take nothing else.
std::string valid_utf8(const std::string& text);

}  // namespace trunnion
