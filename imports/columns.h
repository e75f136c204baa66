// Which column of a file holds what, and its numbers in mm, rad and s.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imports/facts.h"
#include "imports/text_table.h"
#include "imports/units.h"

namespace trunnion::imports {

/// The words of a name in lower case: "X1_ActualPosition" is x1, actual, position.
std::vector<std::string> words_of(const std::string& name);
/// Lower case, letters and digits only.
std::string plain_name(const std::string& name);

/// The column with one of these names (plain); throws InputError when two have one.
std::optional<std::size_t> find_column(const TextTable& table,
                                       const std::vector<std::string>& names);

/// A column as numbers of one quantity.
struct NumberColumn {
    std::size_t index = 0;
    double factor = 1.0;  ///< to mm, rad or s
};
/// The unit stands with the column, else in `otherwise`; throws InputError where neither tells it,
/// or where the unit is one of another quantity.
NumberColumn number_column(const TextTable& table, std::size_t index, Quantity quantity,
                           const std::string& otherwise);
/// The first list of names that a column has (find_column).
std::optional<std::size_t> find_first_column(const TextTable& table,
                                             const std::vector<std::vector<std::string>>& lists);
/// One number; an empty cell, or a unit behind the number, throws InputError with its place.
double number_in(const TextTable& table, std::size_t row,
                 const std::vector<records::TableCell>& cells, const NumberColumn& column);

/// Times of the rows of one file.
class TimeColumn {
  public:
    /// The column told, or one named `time`, `time_s`, `timestamp`, `date` ..., or a date beside a
    /// time of day; without one the fact step_s; without that one minute a row, with a note.
    TimeColumn(const TextTable& table, const Facts& facts,
               std::optional<std::size_t> column = std::nullopt);

    /// Seconds; absolute where the file has dates. Throws InputError for a text that is no time.
    double time_s(const TextTable& table, std::size_t row,
                  const std::vector<records::TableCell>& cells) const;
    bool is_column(std::size_t k) const { return column_ == k || date_ == k; }
    bool dated() const { return dated_; }  ///< seconds since 1970
    bool invented() const { return !column_ && step_s_ == one_minute_s; }
    std::string words() const;  ///< "times from 'Timestamp'", "0.1 s a row" ...

  private:
    static constexpr double one_minute_s = 60.0;
    std::optional<std::size_t> column_, date_;
    bool stamps_ = false, dated_ = false;
    double factor_ = 1.0, step_s_ = one_minute_s;
    std::string name_;
};

}  // namespace trunnion::imports
