#include "diagnosis/search/left_out.h"

#include <cmath>
#include <map>

#include "base/units.h"
#include "estimation/free_form.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t sectors = 24;  ///< of a whole turn

}  // namespace

std::vector<bool> moved_rows(const Design& design, const std::vector<std::size_t>& groups) {
    constexpr double least = 1e-6;  // of the row that the group moves most
    std::vector<bool> moved(static_cast<std::size_t>(design.data().size()), false);
    for (const std::size_t group : groups) {
        const Eigen::VectorXd size =
            design.projection().beside(design.columns(group)).rowwise().norm();
        const double most = size.maxCoeff();
        for (std::size_t i = 0; i < moved.size(); ++i)
            if (size(static_cast<Eigen::Index>(i)) > least * most) moved[i] = true;
    }
    return moved;
}

Folds of_moved_rows(const Design& design, const std::vector<std::size_t>& groups, Folds folds) {
    const std::vector<bool> moved = moved_rows(design, groups);
    for (std::size_t i = 0; i < folds.group.size(); ++i)
        if (!moved[i]) folds.group[i] = -1;
    return folds;
}

Folds place_folds(const emulator::Replay& replay, const TableForm& table) {
    std::vector<double> places = table.knots;
    if (places.empty())
        for (std::size_t k = 0; k <= sectors; ++k)
            places.push_back(-pi + 2.0 * pi * static_cast<double>(k) / sectors);
    Folds folds;
    for (std::size_t k = 0; k < places.size(); ++k)
        folds.fold.push_back(static_cast<int>(k % Folds::count));
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const double at = replay.sample(i).position[table.axis.axis];
        const double q = table.knots.empty() ? std::remainder(at, 2.0 * pi) : at;
        const auto [before, weight] = estimation::place_between(places, q);
        const auto place = static_cast<int>(before) + (weight > 0.5 ? 1 : 0);
        const bool end =
            !table.knots.empty() && (place == 0 || place + 1 == static_cast<int>(places.size()));
        // -180 and 180 degrees are one place.
        folds.group.push_back(end                   ? -1
                              : table.knots.empty() ? place % static_cast<int>(sectors)
                                                    : place);
    }
    return folds;
}

Folds path_folds(const std::vector<NoiseBlock>& blocks, const emulator::Replay& replay,
                 const std::vector<Axis>& axes) {
    Folds folds;
    folds.group.assign(replay.size(), 0);
    std::map<std::vector<long>, int> paths;  // by the end positions of all axes, in mm or
                                             // centiradians
    for (const NoiseBlock& block : blocks) {
        const auto own = static_cast<int>(folds.fold.size());
        int fold = own % Folds::count;
        // The points of a plate come row by row: every fifth may be one line of it.
        if (block.device == records::Device::point)
            fold = (own + 2 * (own / Folds::count)) % Folds::count;
        if (block.device == records::Device::ballbar) {
            std::vector<long> ends;
            for (const Axis axis : axes) {
                double low = 1e300, high = -1e300;
                for (const Eigen::Index i : block.rows) {
                    const double q = replay.sample(static_cast<std::size_t>(i)).position[axis];
                    low = std::min(low, q);
                    high = std::max(high, q);
                }
                const double unit = is_rotary(axis) ? 0.01 : 1.0;
                ends.push_back(std::lround(low / unit));
                ends.push_back(std::lround(high / unit));
            }
            fold =
                paths.try_emplace(std::move(ends), static_cast<int>(paths.size())).first->second %
                Folds::count;
        }
        for (const Eigen::Index i : block.rows) folds.group[static_cast<std::size_t>(i)] = own;
        folds.fold.push_back(fold);
    }
    return folds;
}

}  // namespace trunnion::diagnosis
