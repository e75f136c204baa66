#include "imports/time_column.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "imports/times.h"

namespace trunnion::imports {
namespace {

constexpr double seconds_a_day = 86400.0, seconds_an_hour = 3600.0;
/// More seconds than a table of readings may last: they are counted from another year.
constexpr double longest_s = 1e7;
constexpr std::size_t sample_rows = 1000;

/// Numbers of the first rows; a cell without one is left out.
std::vector<double> numbers_in(const TextTable& table, std::size_t column) {
    std::vector<double> numbers;
    std::vector<records::TableCell> cells;
    for (std::size_t i = 0; i < std::min(table.size(), sample_rows); ++i) {
        table.read(i, cells);
        if (const auto value = table.find_number(cells[column].text)) numbers.push_back(*value);
    }
    return numbers;
}

/// Beside a date: not 0, 1, 2, which may count the rows.
bool hours_of_a_day(const std::vector<double>& numbers) {
    return !count_rows(numbers) && std::all_of(numbers.begin(), numbers.end(), [](double hour) {
        return hour >= 0.0 && hour <= 24.0;
    });
}

}  // namespace

TimeColumn::TimeColumn(const TextTable& table, const Facts& facts,
                       std::optional<std::size_t> column) {
    find(table, facts, column);
    if (!column_) return;
    name_ = table.columns()[*column_].name;
    std::vector<records::TableCell> cells;
    table.read(0, cells);
    stamps_ = !table.find_number(cells[*column_].text);
    if (!stamps_) read_numbers(table, facts);
    dated_ = (stamps_ || hours_) && time_s(table, 0, cells) > seconds_a_day;
}

void TimeColumn::find(const TextTable& table, const Facts& facts,
                      std::optional<std::size_t> column) {
    const auto date = find_column(table, {"date", "datum"});
    auto clock =
        find_column(table, {"time", "times", "timestamp", "datetime", "zeit", "zeitstempel", "t",
                            "uhrzeit", "clock", "timems", "elapsed", "elapsedtime", "utc"});
    if (!clock && date)
        clock = find_column(table, {"ut", "hour", "hours", "timeofday", "utchours", "uthours"});
    column_ = column ? column : clock ? clock : date;
    if (!column && clock) date_ = date;
    if (const auto step = facts.positive("step_s", Quantity::time, "s")) step_s_ = *step;
}

/// Seconds, or a unit that is told, or that the numbers cannot do without.
void TimeColumn::read_numbers(const TextTable& table, const Facts& facts) {
    const std::vector<double> numbers = numbers_in(table, *column_);
    const bool named = !table.columns()[*column_].unit.empty();
    factor_ = number_column(table, *column_, Quantity::time, "s").factor;
    hours_ = date_ && hours_of_a_day(numbers) && (!named || factor_ == seconds_an_hour);
    if (hours_) {
        factor_ = seconds_an_hour;
        unit_words_ = "taken as decimal hours of the day";
    } else if (named) {
        if (numbers.empty() || numbers.front() * factor_ < longest_s) return;
        first_ = numbers.front();
        unit_words_ = "counted from the first row";
    } else if (const auto clock = clock_of(numbers)) {
        factor_ = clock->tick_s;
        first_ = numbers.front();
        unit_words_ = "taken as " + clock->words + ", counted from the first row";
    } else if (count_rows(numbers)) {
        counts_rows_ = true;
        const bool told = facts.has("step_s");
        if (told) factor_ = step_s_;
        unit_words_ =
            told ? fmt::format("taken as numbers of the rows, {} s apart", step_s_)
                 : "taken as seconds; if it only counts the rows, --with step_s=0.001 tells the "
                   "time between them";
    } else if (!numbers.empty() && numbers.front() > longest_s) {
        unit_words_ = "without unit taken as seconds; another unit is told in its name: 't [us]'";
    }
}

double TimeColumn::stamp_s(const TextTable& table, std::size_t row,
                           const records::TableCell& cell) const {
    const auto time = seconds_of(cell.text);
    if (!time)
        table.line(row).fail("'" + std::string(cell.text) +
                                 "' is no time as 2024-03-01T08:15:30 (01/02/2024 is two days)",
                             cell.column);
    return *time;
}

double TimeColumn::time_s(const TextTable& table, std::size_t row,
                          const std::vector<records::TableCell>& cells) const {
    if (!column_) return step_s_ * static_cast<double>(row);
    const bool dated = date_ && (stamps_ || hours_);
    const double day_s = dated ? stamp_s(table, row, cells[*date_]) : 0.0;
    if (stamps_) return day_s + stamp_s(table, row, cells[*column_]);
    return day_s + (number_in(table, row, cells, {*column_, 1.0}) - first_) * factor_;
}

std::string TimeColumn::words() const {
    if (column_) return "times from '" + name_ + '\'';
    return invented() ? "no times: rows one minute apart" : fmt::format("{} s a row", step_s_);
}

void TimeColumn::note_unit(const TextTable& table, std::vector<std::string>& notes) const {
    if (unit_words_.empty()) return;
    const char* how = counts_rows_ ? " without unit, in steps of 1," : "";
    notes.push_back(fmt::format("{}: '{}'{} {}", table.path(), name_, how, unit_words_));
}

}  // namespace trunnion::imports
