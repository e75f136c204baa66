// Text broken into lines.
#pragma once

#include <string>
#include <vector>

namespace trunnion::report {

/// Lines of at most `width` places; words are kept whole.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);
/// The text in lines that fit a terminal (90 places), the first one behind `indent` blanks, the
/// others two further in.
std::string paragraph(const std::string& text, std::size_t indent);

}  // namespace trunnion::report
