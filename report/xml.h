// Text for XML, HTML, SVG and JSON.
#pragma once

#include <string>

#include "base/text.h"

namespace trunnion::report {

/// Safe as XML or HTML text and inside quoted attributes; control characters become '?'.
std::string escape_xml(const std::string& text);

}  // namespace trunnion::report
