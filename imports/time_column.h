// Times of the rows of one file: stamps, seconds, ticks of a clock, or only their order.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "imports/clocks.h"
#include "imports/columns.h"

namespace trunnion::imports {

class TimeColumn {
  public:
    /// The given column, or one named `time`, `time_s`, `timestamp`, `date` ..., or a date next to
    /// a time of day or its decimal hours; else the fact step_s; else one minute a row, with a
    /// note.
    TimeColumn(const TextTable& table, const Facts& facts,
               std::optional<std::size_t> column = std::nullopt);

    /// Seconds; absolute if the file has dates. Throws InputError for a text that is not a time.
    double time_s(const TextTable& table, std::size_t row,
                  const std::vector<records::TableCell>& cells) const;
    bool is_column(std::size_t k) const { return column_ == k || date_ == k; }
    bool is_told() const { return column_.has_value(); }  ///< the file has times
    bool dated() const { return dated_; }                 ///< seconds since 1970
    bool invented() const { return !column_ && step_s_ == one_minute_s; }
    std::string words() const;  ///< "times from 'Timestamp'", "0.1 s a row" ...
    /// A note on the unit in which the numbers are read, unless they are plain seconds.
    void note_unit(const TextTable& table, std::vector<std::string>& notes) const;

  private:
    static constexpr double one_minute_s = 60.0;
    void find(const TextTable& table, const Facts& facts, std::optional<std::size_t> column);
    void read_numbers(const TextTable& table, const Facts& facts);
    double stamp_s(const TextTable& table, std::size_t row, const records::TableCell& cell) const;

    std::optional<std::size_t> column_, date_;
    bool stamps_ = false, hours_ = false, dated_ = false, counts_rows_ = false;
    double factor_ = 1.0, first_ = 0.0, step_s_ = one_minute_s;
    std::string name_, unit_words_;
};

}  // namespace trunnion::imports
