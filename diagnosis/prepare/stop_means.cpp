#include "diagnosis/prepare/stop_means.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t least_stops = 4;  ///< assumed
constexpr double most_of_time = 0.25;   ///< of the table, at one stop: else time is what is tested

bool reads_at_rest(records::Device device) {
    return device == records::Device::linear || device == records::Device::angle ||
           device == records::Device::point;
}

/// Rows of one stop of the axes that one target has in one direction.
using Group = std::vector<std::size_t>;

/// What an instrument reads there.
using SightLine = std::tuple<records::Device, std::string, std::string, std::array<double, 3>>;

SightLine sight_line_of(const records::Reading& row) {
    const Vector3& d = row.direction_M;
    return {row.device, row.feature, row.instrument, {d.x(), d.y(), d.z()}};
}

/// True where nothing has moved or changed from one row to the next.
bool at_rest(const records::Reading& a, const records::Reading& b) {
    return a.commanded == b.commanded && a.test == b.test && a.part == b.part &&
           a.session == b.session && a.mode == b.mode && a.load_kg == b.load_kg &&
           a.clamped == b.clamped && a.spindle_rad == b.spindle_rad &&
           a.extension_mm == b.extension_mm;
}

/// The groups of all stops, each in the order of its first row. A row without a device is a place
/// of the axes, too.
std::vector<Group> groups_of(const records::ReadingTable& table) {
    std::vector<Group> groups;
    std::map<SightLine, std::size_t> here;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const records::Reading& row = table.rows[i];
        if (i > 0 && !at_rest(table.rows[i - 1], row)) here.clear();
        if (!reads_at_rest(row.device) || !row.value_mm) continue;
        const auto [at, is_first] = here.try_emplace(sight_line_of(row), groups.size());
        if (is_first) groups.emplace_back();
        groups[at->second].push_back(i);
    }
    return groups;
}

double duration_s(const records::ReadingTable& table, const Group& group) {
    return table.rows[group.back()].time_s - table.rows[group.front()].time_s;
}

/// The first row with the mean value of all.
records::Reading mean_of(const records::ReadingTable& table, const Group& group) {
    records::Reading mean = table.rows[group.front()];
    double sum = 0.0;
    for (const std::size_t i : group) sum += *table.rows[i].value_mm - *mean.value_mm;
    *mean.value_mm += sum / static_cast<double>(group.size());
    return mean;
}

}  // namespace

std::optional<StopMeans> means_of_stops(
    const records::ReadingTable& table,
    const std::function<bool(const records::Reading&)>& is_stated) {
    const bool stated = std::any_of(table.rows.begin(), table.rows.end(), [&](const auto& row) {
        return reads_at_rest(row.device) && is_stated(row);
    });
    if (table.rows.empty() || stated) return std::nullopt;
    const std::vector<Group> groups = groups_of(table);
    const double most_s = most_of_time * (table.rows.back().time_s - table.rows.front().time_s);
    const auto is_mean = [](const Group& group) { return group.size() > 1; };
    StopMeans found;
    for (const Group& group : groups) {
        if (!is_mean(group)) continue;
        if (duration_s(table, group) > most_s) return std::nullopt;
        found.readings += group.size();
        ++found.means;
    }
    if (found.means < least_stops) return std::nullopt;
    found.table = table;
    std::vector<bool> drop(table.rows.size(), false);
    for (const Group& group : groups) {
        if (!is_mean(group)) continue;
        found.table.rows[group.front()] = mean_of(table, group);
        for (std::size_t k = 1; k < group.size(); ++k) drop[group[k]] = true;
    }
    std::size_t at = 0;
    std::erase_if(found.table.rows, [&](const records::Reading&) { return drop[at++]; });
    return found;
}

}  // namespace trunnion::diagnosis
