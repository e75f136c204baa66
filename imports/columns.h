// Assignment of columns, and their numbers in mm, rad and s.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imports/facts.h"
#include "imports/text_table.h"
#include "imports/units.h"

namespace trunnion::imports {

/// The words of a name in lower case: "X1_ActualPosition" gives x1, actual, position.
std::vector<std::string> words_of(const std::string& name);
/// The words of a name without indices at its end: "Reference(i,j)" gives "reference".
std::string without_index(const std::string& name);
/// Lower case, letters and digits only, without indices at its end.
std::string plain_name(const std::string& name);

/// The column with one of these names (in the form of plain_name()); throws InputError when two
/// columns match.
std::optional<std::size_t> find_column(const TextTable& table,
                                       const std::vector<std::string>& names);

/// A column of standard uncertainties: sigma, sd, std, u ...
std::optional<std::size_t> sigma_column(const TextTable& table);

/// The cells of a line of a table.
struct LineCells {
    const TextTable& table;
    std::size_t row;
    const std::vector<records::TableCell>& cells;
};

/// A column of numbers of one quantity.
struct NumberColumn {
    std::size_t index = 0;
    double factor = 1.0;       ///< to mm, rad or s
    bool sexagesimal = false;  ///< degrees or hours, which may be written as -12:34:56.7
    bool limited = false;      ///< to `largest_number`: not for seconds since 1970
};
/// mm, rad, mm/s: the reader accepts at most 1e9 mm or degrees (records/table_line.h).
constexpr double largest_number = 1e7;
constexpr const char* beyond_largest =
    "a number beyond 1e7 mm, rad or s: is it the right column and unit?";
/// The unit comes from the column, else from `otherwise`; throws InputError when neither gives it,
/// or when it belongs to another quantity.
NumberColumn number_column(const TextTable& table, std::size_t index, Quantity quantity,
                           const std::string& otherwise);
/// The column for the first list of names that matches (find_column).
std::optional<std::size_t> find_first_column(const TextTable& table,
                                             const std::vector<std::vector<std::string>>& lists);
/// One number; of degrees or hours also -12:34:56.7 (minutes and seconds below 60). An empty cell,
/// a number beyond the limit of its column, or a unit after it throws InputError with its position.
double number_in(const TextTable& table, std::size_t row,
                 const std::vector<records::TableCell>& cells, const NumberColumn& column);

}  // namespace trunnion::imports
