#include "emulator/reading_log.h"

#include <algorithm>

namespace trunnion {
namespace {

/// Moves kept between two readings; a longer way than this says nothing more about approach.
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

ReadingLog::ReadingLog(std::vector<Axis> axes, std::string test) : test_(std::move(test)) {
    table_.axes = std::move(axes);
    table_.optional_columns = {"mode", "feed_mm_min"};
    table_.comment = {{"schema", "trunnion.readings/1"}, {"source", "simulated"}};
}

ReadingTable ReadingLog::take() {
    const auto column = [&](const char* name, const auto& differs) {
        if (std::any_of(table_.rows.begin(), table_.rows.end(), differs))
            table_.optional_columns.emplace_back(name);
    };
    column("spindle_deg", [](const Reading& r) { return r.spindle_rad != 0.0; });
    column("temperature_c", [](const Reading& r) { return r.temperature_c != 20.0; });
    column("load_kg", [](const Reading& r) { return r.load_kg != 0.0; });
    column("clamped", [](const Reading& r) { return r.clamped; });
    column("extension_mm", [](const Reading& r) { return r.extension_mm != 0.0; });
    return std::move(table_);
}

void ReadingLog::set_test(std::string test) {
    test_ = std::move(test);
}

void ReadingLog::passed(const AxisPositions& to, double time_s, PositioningMode mode) {
    const std::size_t n = stops_.size();
    if (n > 0 && stops_.back().at == to) return;
    if (n >= 2 && passes_through(stops_[n - 2].at, stops_[n - 1].at, to)) stops_.pop_back();
    stops_.push_back({to, time_s, mode});
    if (stops_.size() > kept_stops) stops_.pop_front();
}

void ReadingLog::append(Reading row) {
    if (!table_.rows.empty()) {
        const Reading& last = table_.rows.back();
        if (row.commanded != last.commanded)
            row.time_s = std::max(row.time_s, last.time_s + shortest_time_s);
    }
    row.index = static_cast<int>(table_.rows.size());
    row.test = test_;
    table_.rows.push_back(std::move(row));
}

void ReadingLog::add(Reading row) {
    if (row.device == Device::ballbar) stops_.clear();  // its rows tell velocities themselves
    const bool begins = table_.rows.empty() || table_.rows.back().test != test_;
    for (std::size_t i = begins ? 0 : 1; i < stops_.size(); ++i) {
        Reading stop;
        stop.commanded = stops_[i].at;
        stop.time_s = stops_[i].time_s;
        stop.mode = stops_[i].mode;
        stop.feature = row.feature;
        append(std::move(stop));
    }
    stops_.clear();
    stops_.push_back({row.commanded, row.time_s, row.mode});
    append(std::move(row));
}

}  // namespace trunnion
