// Splitting of a line into cells, and interpretation of a cell.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "records/table_line.h"

namespace trunnion::imports {

/// Format of the numbers of a file.
struct Dialect {
    char separator = ',';  ///< a blank: consecutive blanks and tabs count as one
    bool decimal_comma = false;

    std::optional<double> find_number(std::string_view text) const;
};

/// Cells of a line, also of a blank line.
std::vector<records::TableCell> cells_of(const records::TableLine& line, char separator);
/// The same, separated only by two blanks or a tab: "Soll X   Ist X" has two cells.
std::vector<records::TableCell> cells_apart(std::string_view text);
/// Removes empty cells at the end, which spreadsheets add.
void drop_empty_end(std::vector<records::TableCell>& cells);

/// Empty, "-", "nan", "n/a", "***": a missing value.
bool is_missing(std::string_view text);
/// True when any cell is a number.
bool has_number(const std::vector<records::TableCell>& cells, const Dialect& dialect);
/// True for a line that can belong to a table: some cell is a number, a time or a missing value.
bool is_data(const std::vector<records::TableCell>& cells, const Dialect& dialect);
/// The dialect of these lines: the separator that splits the most consecutive lines alike. Throws
/// InputError (with position) where a comma may be both separator and decimal mark.
Dialect dialect_of(const std::vector<records::TableLine>& lines);

}  // namespace trunnion::imports
