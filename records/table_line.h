// One line of a CSV table, split into cells that know their column, for messages with position.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/finite.h"

namespace trunnion::records {

struct TableCell {
    std::string_view text;  ///< without enclosing quotes and blanks; "" inside quotes stays doubled
    int column = 1;         ///< of the first character, from 1
    bool quoted = false;

    std::string plain() const;  ///< with "" inside quotes reduced to one
};

struct TableLine {
    std::string_view text;
    int number = 0;
    std::string_view path;

    [[noreturn]] void fail(const std::string& message, int column) const;
    /// Throws InputError for an unclosed quote or text after a closing quote.
    void split(char separator, std::vector<TableCell>& cells) const;
    /// Throws InputError unless the cell is a finite number with a decimal point.
    Finite number_of(const TableCell& cell, std::string_view what) const;
};

std::string_view without_blanks(std::string_view text);
/// Removes and returns the next line of `text`, without its line end (LF, CRLF or a lone CR).
std::string_view take_line(std::string_view& text);
/// What separates the columns of a table with this header line: spreadsheets also use tabs and
/// semicolons.
char separator_of(std::string_view header);
/// The text as a cell, quoted if necessary.
std::string cell_text(const std::string& text);

}  // namespace trunnion::records
