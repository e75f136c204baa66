#include "diagnosis/prepare/cycles.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/units.h"
#include "diagnosis/prepare/noise.h"

namespace trunnion::diagnosis {
namespace {

/// Different places among positions: those within a thousandth of the range are one.
std::size_t count_of_places(std::vector<double> positions) {
    constexpr double same = 1e-3;
    std::sort(positions.begin(), positions.end());
    const double near = same * (positions.back() - positions.front());
    std::size_t count = 1;
    for (std::size_t k = 1; k < positions.size(); ++k)
        if (positions[k] - positions[k - 1] > near) ++count;
    return count;
}

/// Rows of one test, which follow each other.
struct RowsOfTest {
    std::size_t first = 0, end = 0;
};

/// Numbers the cycles of a test, from `number` on. The way there and back over one target again and
/// again is no cycle: its zero would be the error of that target. A cycle sees half of the targets
/// of its test at least, and the next one goes back over them.
void number_cycles(const emulator::Replay& replay, Axis axis, const RowsOfTest& rows,
                   Eigen::Index number, std::vector<Eigen::Index>& cycle) {
    const auto at = [&](std::size_t i) { return replay.sample(i).position[axis]; };
    std::vector<double> all, seen;
    for (std::size_t i = rows.first; i < rows.end; ++i) all.push_back(at(i));
    const auto [low, high] = std::minmax_element(all.begin(), all.end());
    const std::size_t places = count_of_places(all), enough = (places + 1) / 2;
    const double near = 0.5 * (*high - *low) / static_cast<double>(places);
    const int start =
        replay.sample(rows.first).travel[index_of(axis)];  // side of the first reading
    const auto goes_on = [&](double q) {                   // ahead of all that was seen
        return std::all_of(seen.begin(), seen.end(),
                           [&](double s) { return (q - s) * start > near; });
    };
    for (std::size_t i = rows.first; i < rows.end; ++i) {
        const int side = replay.sample(i).travel[index_of(axis)];
        if (i > rows.first) {
            double step = at(i) - at(i - 1);
            if (is_rotary(axis)) step = std::remainder(step, 2.0 * pi);  // 180 and -180 deg are one
            const bool turned = replay.sample(i - 1).travel[index_of(axis)] != side;
            const bool again = side == start && (turned || step * side < 0.0);
            if (again && count_of_places(seen) >= enough && !goes_on(at(i))) {
                ++number;
                seen.clear();
            }
        }
        seen.push_back(at(i));
        cycle[i] = number;
    }
}

}  // namespace

std::optional<Axis> measured_axis(const emulator::Replay& replay,
                                  const records::ReadingTable& table) {
    std::optional<Axis> moving;
    for (const Axis axis : table.axes) {
        const double first = replay.sample(0).position[axis];
        bool moves = false;
        for (std::size_t i = 0; i < replay.size(); ++i) {
            if (!reads_targets(replay.contact(i).device)) return {};
            moves = moves || replay.sample(i).position[axis] != first;
        }
        if (moves && moving) return {};
        if (moves) moving = axis;
    }
    return moving;
}

std::vector<Eigen::Index> cycles_of(const emulator::Replay& replay,
                                    const records::ReadingTable& table) {
    const std::optional<Axis> measured = measured_axis(replay, table);
    if (!measured) return {};
    std::vector<Eigen::Index> cycle(replay.size(), 0);
    const auto test = [&](std::size_t i) -> const std::string& {
        return table.rows[replay.table_row(i)].test;
    };
    for (std::size_t first = 0, end = 0; first < replay.size(); first = end) {
        while (end < replay.size() && test(end) == test(first)) ++end;
        number_cycles(replay, *measured, {first, end}, first == 0 ? 0 : cycle[first - 1] + 1,
                      cycle);
    }
    return cycle;
}

}  // namespace trunnion::diagnosis
