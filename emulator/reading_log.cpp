#include "emulator/reading_log.h"

#include <algorithm>

namespace trunnion::emulator {
namespace {

/// Moves kept between two readings before those that say nothing about a side are dropped.
constexpr std::size_t kept_stops = 64;
/// Between rows of different positions, even where a move takes no time.
constexpr double shortest_time_s = 1e-6;

int sign_of(double v) {
    return (v > 0.0) - (v < 0.0);
}

/// True when a -> c says the same about every axis's last direction as a -> b -> c.
bool passes_through(const AxisPositions& a, const AxisPositions& b, const AxisPositions& c) {
    for (std::size_t i = 0; i < axis_count; ++i) {
        const int last = sign_of(c.value[i] - b.value[i]);
        const int whole = sign_of(c.value[i] - a.value[i]);
        if (whole != (last != 0 ? last : sign_of(b.value[i] - a.value[i]))) return false;
    }
    return true;
}

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
    const auto column = [&](const char* name, const auto& differs) {
        if (std::any_of(table_.rows.begin(), table_.rows.end(), differs))
            table_.optional_columns.emplace_back(name);
    };
    column("spindle_deg", [](const records::Reading& r) { return r.spindle_rad != 0.0; });
    column("temperature_c", [](const records::Reading& r) { return r.temperature_c != 20.0; });
    column("load_kg", [](const records::Reading& r) { return r.load_kg != 0.0; });
    column("clamped", [](const records::Reading& r) { return r.clamped; });
    column("extension_mm", [](const records::Reading& r) { return r.extension_mm != 0.0; });
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
    const std::size_t n = stops_.size();
    if (n > 0 && stops_.back().at == to) return;
    if (n == 0 && !table_.rows.empty() && table_.rows.back().commanded == to) return;
    if (n >= 2 && stops_[n - 2].test == test_ &&
        passes_through(stops_[n - 2].at, stops_[n - 1].at, to))
        stops_.pop_back();
    stops_.push_back({to, time_s, mode, test_});
    if (stops_.size() > kept_stops) prune();
}

/// Keeps the last motion of every axis, and where they stand.
void ReadingLog::prune() {
    std::vector<bool> needed(stops_.size(), false);
    needed.back() = true;
    for (std::size_t i = 0; i < axis_count; ++i)
        for (std::size_t k = stops_.size() - 1; k > 0; --k)
            if (stops_[k].at.value[i] != stops_[k - 1].at.value[i]) {
                needed[k] = needed[k - 1] = true;
                break;
            }
    std::vector<Stop> kept;
    for (std::size_t k = 0; k < stops_.size(); ++k)
        if (k == 0 || needed[k]) kept.push_back(std::move(stops_[k]));
    stops_ = std::move(kept);
}

records::Reading ReadingLog::row_of(const Stop& stop) {
    records::Reading row;
    row.commanded = stop.at;
    row.time_s = stop.time_s;
    row.mode = stop.mode;
    row.test = stop.test;
    return row;
}

AxisSample ReadingLog::sample_of(records::Reading row) const {
    std::vector<records::Reading> rows;
    if (!table_.rows.empty()) rows.push_back(table_.rows.back());
    for (const Stop& stop : stops_) rows.push_back(row_of(stop));
    if (!stops_.empty() && stops_.back().at == row.commanded) rows.pop_back();
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
    if (!stops_.empty() && stops_.back().at == row.commanded) stops_.pop_back();
    for (const Stop& stop : stops_) {
        records::Reading passing = row_of(stop);
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

std::vector<AxisSample> ReadingLog::pass_samples() const {
    const auto rows = std::span(table_.rows).subspan(stretch_);
    std::vector<AxisSample> all = records::samples_of(rows, table_.axes, before_stretch_);
    all.erase(all.begin(), all.begin() + static_cast<long>(pass_begin() - stretch_));
    return all;
}

}  // namespace trunnion::emulator
