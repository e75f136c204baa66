// Text broken into lines.
#pragma once

#include <string>
#include <vector>

namespace trunnion::report {

/// Splits text into lines of at most `width` columns, at words only.
std::vector<std::string> wrapped(const std::string& text, std::size_t width);
/// The text in lines that fit a terminal (80 columns); the first line is indented by `indent`
/// blanks, the others by two more.
std::string paragraph(const std::string& text, std::size_t indent);

}  // namespace trunnion::report
