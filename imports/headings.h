// Headings above a table, and those that announce results instead of readings.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "imports/text_table.h"

namespace trunnion::imports {

/// Headings of the table whose names are in lines[at], the nearest first: lines marked by #, each
/// with fewer marks than the one below it; without one in its head (from lines[begin] on) a line of
/// words there.
std::vector<TextTable::Line> headings_above(const std::vector<TextTable::Line>& lines,
                                            std::size_t begin, std::size_t at);

/// True if a heading between `told` and the line `before` ends the section that `told` begins: both
/// marked by #, of its rank or above. Comment lines that follow one another are one heading.
bool section_ends(const std::vector<TextTable::Line>& lines, const TextTable::Line& told,
                  int before);

/// The words of a heading without its mark: "Results".
std::string heading_words(std::string_view text);

/// 0 for a heading of readings; 1 for "Results", which may be those of the measurement; 2 for
/// "Mean deviations", "Calculations", "Summary".
int result_words(const std::vector<TextTable::Line>& headings);

}  // namespace trunnion::imports
