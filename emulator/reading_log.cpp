#include "emulator/reading_log.h"

#include <algorithm>

namespace trunnion::emulator {
namespace {

/// Minimum time between rows of different positions, even for moves of zero duration.
constexpr double shortest_time_s = 1e-6;

}  // namespace

ReadingLog::ReadingLog(std::vector<Axis> axes, const AxisSides& sides, std::string test)
    : test_(std::move(test)),
      names_{test_},
      history_(sides, records::rows_rounding),
      before_stretch_(sides, records::rows_rounding) {
    table_.axes = std::move(axes);
    table_.optional_columns = {"mode", "feed_mm_min"};
    table_.comment = {{"schema", "trunnion.readings/1"}, {"source", "simulated"}};
    table_.side_before = sides;
}

records::ReadingTable ReadingLog::take() {
    for (std::string& name : records::shop_columns(table_.rows))
        table_.optional_columns.push_back(std::move(name));
    return std::move(table_);
}

void ReadingLog::set_test(std::string test) {
    test_ = std::move(test);
    names_.insert(test_);
}

void ReadingLog::set_pass(const std::string& test) {
    test_ = test;
    for (int k = 2; !names_.insert(test_).second; ++k) test_ = test + '_' + std::to_string(k);
}

void ReadingLog::passed(const AxisPositions& to, double time_s, PositioningMode mode) {
    records::Reading stop;
    stop.commanded = to;
    stop.time_s = time_s;
    stop.mode = mode;
    stop.test = test_;
    stops_.pass(stop, table_.rows.empty() ? nullptr : &table_.rows.back().commanded);
}

AxisSample ReadingLog::sample_of(records::Reading row) const {
    std::vector<records::Reading> rows;
    if (!table_.rows.empty()) rows.push_back(table_.rows.back());
    for (records::Reading& stop : stops_.before(row.commanded)) rows.push_back(std::move(stop));
    row.test = test_;
    rows.push_back(std::move(row));
    return records::samples_of(rows, table_.axes, history_).back();
}

void ReadingLog::append(records::Reading row) {
    const records::Reading* last = table_.rows.empty() ? nullptr : &table_.rows.back();
    if (last) {
        const double step_s = row.commanded == last->commanded ? 0.0 : shortest_time_s;
        row.time_s = std::max(row.time_s, last->time_s + step_s);
    }
    history_.advance(row.commanded);
    if (last && records::way_unknown(*last, row)) {
        history_.begin_anew();
        stretch_ = table_.rows.size();
        before_stretch_ = history_;
    }
    row.index = static_cast<int>(table_.rows.size());
    table_.rows.push_back(std::move(row));
}

void ReadingLog::add(records::Reading row) {
    for (records::Reading& passing : stops_.before(row.commanded)) {
        passing.feature = row.feature;
        append(std::move(passing));
    }
    stops_.clear();
    row.test = test_;
    append(std::move(row));
}

std::size_t ReadingLog::pass_begin() const {
    std::size_t begin = table_.rows.size();
    while (begin > stretch_ && table_.rows[begin - 1].test == test_) --begin;
    return begin;
}

std::span<records::Reading> ReadingLog::pass() {
    return std::span(table_.rows).subspan(pass_begin());
}

std::vector<AxisSample> ReadingLog::pass_samples(const TimeConstants& constants) const {
    const auto rows = std::span(table_.rows).subspan(stretch_);
    std::vector<AxisSample> all =
        records::samples_of(rows, table_.axes, before_stretch_, {}, constants);
    all.erase(all.begin(), all.begin() + static_cast<long>(pass_begin() - stretch_));
    return all;
}

}  // namespace trunnion::emulator
