// One line of a file cut into cells, and what a cell holds.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "records/table_line.h"

namespace trunnion::imports {

/// How the numbers of a file are written.
struct Dialect {
    char separator = ',';  ///< a blank: runs of blanks and tabs count as one
    bool decimal_comma = false;

    std::optional<double> find_number(std::string_view text) const;
};

/// Cells of a line; a line of blanks too.
std::vector<records::TableCell> cells_of(const records::TableLine& line, char separator);
/// The same, only two blanks or a tab separate: "Soll X   Ist X" has two.
std::vector<records::TableCell> cells_apart(std::string_view text);
/// Without the empty cells at the end, which spreadsheets add.
void drop_empty_end(std::vector<records::TableCell>& cells);

/// Empty, "-", "nan", "n/a", "***": no value was taken here.
bool is_missing(std::string_view text);
/// Any cell is a number.
bool has_number(const std::vector<records::TableCell>& cells, const Dialect& dialect);
/// A line that a table can hold: a number, a time or a mark for a missing value in some cell.
bool is_data(const std::vector<records::TableCell>& cells, const Dialect& dialect);
/// The dialect of these lines: the separator that cuts the most lines in a row alike. Throws
/// InputError (place) where a comma may be separator and decimal mark at once.
Dialect dialect_of(const std::vector<records::TableLine>& lines);

}  // namespace trunnion::imports
