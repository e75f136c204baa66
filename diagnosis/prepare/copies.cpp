#include "diagnosis/prepare/copies.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t least_copies = 10;
constexpr double least_part = 0.5, least_ratio = 3.0;

/// Rows that one sensor reads in one direction.
using Stream = std::tuple<std::string, records::Device, std::string, std::array<double, 3>>;

Stream stream_of(const records::Reading& row) {
    const Vector3& d = row.direction_M;
    return {row.test, row.device, row.feature, {d.x(), d.y(), d.z()}};
}

/// True for rows at one position under one condition: another load may leave a reading as it was.
bool same_place(const records::Reading& a, const records::Reading& b) {
    return a.commanded == b.commanded && a.session == b.session && a.instrument == b.instrument &&
           a.mode == b.mode && a.load_kg == b.load_kg && a.clamped == b.clamped &&
           a.spindle_rad == b.spindle_rad && a.extension_mm == b.extension_mm &&
           a.temperature_c == b.temperature_c;
}

/// Which rows are copies, and what their number is measured by.
struct Copies {
    std::vector<bool> is_copy;
    std::size_t count = 0, followers = 0;  ///< followers: rows after one at the same position
    double by_chance = 0.0;                ///< probability that two of the values are equal
};

Copies copies_of(const records::ReadingTable& table) {
    Copies found{std::vector<bool>(table.rows.size(), false)};
    std::map<Stream, const records::Reading*> last;
    std::map<double, double> values;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const records::Reading& row = table.rows[i];
        if (row.device == records::Device::none || !row.value_mm) continue;
        values[*row.value_mm] += 1.0;
        const auto [at, first] = last.try_emplace(stream_of(row), &row);
        const records::Reading& before = *std::exchange(at->second, &row);
        if (first || !same_place(before, row)) continue;
        ++found.followers;
        found.is_copy[i] = *before.value_mm == *row.value_mm;
        found.count += found.is_copy[i] ? 1 : 0;
    }
    double all = 0.0, squares = 0.0;
    for (const auto& [value, count] : values) {
        all += count;
        squares += count * count;
    }
    if (all > 0.0) found.by_chance = squares / (all * all);
    return found;
}

}  // namespace

std::optional<records::ReadingTable> without_copies(const records::ReadingTable& table) {
    const Copies found = copies_of(table);
    const double part = static_cast<double>(found.count) /
                        static_cast<double>(std::max<std::size_t>(1, found.followers));
    if (found.count < least_copies || part <= least_part || part <= least_ratio * found.by_chance)
        return std::nullopt;
    records::ReadingTable once = table;
    once.rows.clear();
    for (std::size_t i = 0; i < table.rows.size(); ++i)
        if (!found.is_copy[i]) once.rows.push_back(table.rows[i]);
    return once;
}

}  // namespace trunnion::diagnosis
