#include "diagnosis/prepare/both_sides.h"

#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "diagnosis/prepare/cycles.h"
#include "estimation/scatter.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t least_changes = 5;
/// Relative variance of the mean square of so many changes, times their number: neighbours share a
/// difference (von Neumann 1941; 2 of independent ones).
constexpr double doubt_of_changes = 3.0;

/// The first reading of a target from each side.
struct Sides {
    std::optional<double> forward, back;
};

/// The targets by cycle and place.
std::map<std::pair<Eigen::Index, long>, Sides> targets_of_cycles(const RepeatedRows& rows,
                                                                 const Eigen::VectorXd& white,
                                                                 Axis axis) {
    std::map<std::pair<Eigen::Index, long>, Sides> targets;
    for (std::size_t i = 0; i < rows.replay.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const int travel = rows.replay.sample(i).travel[index_of(axis)];
        if (!rows.used[i] || travel == 0) continue;
        const long place = std::lround(rows.replay.sample(i).position[axis] * 1e5);
        Sides& sides = targets[{rows.cycle[i], place}];
        std::optional<double>& side = travel > 0 ? sides.forward : sides.back;
        if (!side) side = white(row);
    }
    return targets;
}

}  // namespace

NeighbourNoise noise_of_sides(const RepeatedRows& rows, const Eigen::VectorXd& white,
                              double least) {
    const std::optional<Axis> axis = measured_axis(rows.replay, rows.table);
    if (!axis || rows.cycle.empty()) return {};
    std::vector<double> changes;
    std::optional<std::pair<Eigen::Index, double>> before;
    for (const auto& [target, sides] : targets_of_cycles(rows, white, *axis)) {
        if (!sides.forward || !sides.back) continue;
        const double difference = *sides.forward - *sides.back;
        if (before && before->first == target.first)
            changes.push_back(0.5 * (difference - before->second));
        before = {target.first, difference};
    }
    if (changes.size() < least_changes) return {};
    const double noise = std::max(least, estimation::scatter_of(changes, least).deviation);
    return {noise * noise, std::sqrt(doubt_of_changes / static_cast<double>(changes.size()))};
}

}  // namespace trunnion::diagnosis
