// Text broken into lines.
#pragma once

#include <string>
#include <vector>

namespace trunnion::report {

/// Lines of at most `width` places; words are kept whole.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);

}  // namespace trunnion::report
