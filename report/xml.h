// Text for XML, HTML, SVG and JSON.
#pragma once

#include <string>

#include "base/text.h"

namespace trunnion::report {

/// Escapes text for XML or HTML, including quoted attributes; control characters become '?'.
std::string escape_xml(const std::string& text);

}  // namespace trunnion::report
