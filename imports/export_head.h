// The head of an export of signals: a line "Name" with their names, lines of their properties, and
// the rows, which begin with the time.
#pragma once

#include <optional>
#include <vector>

#include "imports/text_table.h"

namespace trunnion::imports {

struct ExportHead {
    std::size_t names = 0, first_row = 0;  ///< indices of lines
    std::optional<std::size_t> units;
};

/// The first one at or after lines[begin]; empty without two lines of properties between names
/// and rows.
std::optional<ExportHead> find_export_head(const std::vector<TextTable::Line>& lines,
                                           std::size_t begin, const Dialect& dialect);

}  // namespace trunnion::imports
