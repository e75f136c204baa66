#include "diagnosis/prepare/cycles.h"

#include <cmath>
#include <optional>
#include <string>

#include "base/units.h"
#include "diagnosis/prepare/noise.h"

namespace trunnion::diagnosis {
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
    const Axis axis = *measured;
    std::vector<Eigen::Index> cycle(replay.size(), 0);
    const auto test = [&](std::size_t i) -> const std::string& {
        return table.rows[replay.table_row(i)].test;
    };
    int start = 0;  // side of the first reading
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const int side = replay.sample(i).travel[index_of(axis)];
        const bool first = i == 0 || test(i) != test(i - 1);
        if (first) start = side;
        if (i == 0) continue;
        double step = replay.sample(i).position[axis] - replay.sample(i - 1).position[axis];
        if (is_rotary(axis)) step = std::remainder(step, 2.0 * pi);  // 180 and -180 deg are one
        const bool turned = replay.sample(i - 1).travel[index_of(axis)] != side;
        const bool again = side == start && (turned || step * side < 0.0);
        cycle[i] = cycle[i - 1] + (first || again ? 1 : 0);
    }
    return cycle;
}

}  // namespace trunnion::diagnosis
