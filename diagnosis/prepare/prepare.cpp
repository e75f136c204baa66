#include "diagnosis/prepare/prepare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "base/alarm.h"
#include "base/rounded.h"
#include "diagnosis/prepare/cycles.h"
#include "diagnosis/prepare/holdout_zeros.h"
#include "diagnosis/prepare/jumps.h"
#include "diagnosis/prepare/repeats.h"
#include "diagnosis/prepare/target_visits.h"
#include "identification/index_errors.h"
#include "identification/plausible.h"
#include "identification/resolution.h"
#include "identification/start_pose.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t few_poses = 25;

}  // namespace

bool is_one_sweep(const emulator::Replay& replay, const std::vector<Axis>& axes) {
    return std::any_of(axes.begin(), axes.end(), [&](Axis axis) {
        bool up = false, down = false;
        for (std::size_t i = 1; i < replay.size(); ++i) {
            const double step =
                replay.sample(i).position[axis] - replay.sample(i - 1).position[axis];
            up = up || step > 0.0;
            down = down || step < 0.0;
        }
        return up != down;
    });
}

bool is_one_cycle(const emulator::Replay& replay, const std::vector<Axis>& axes) {
    return std::all_of(axes.begin(), axes.end(), [&](Axis axis) {
        int turns = 0;
        double last = 0.0;
        for (std::size_t i = 1; i < replay.size(); ++i) {
            const double step =
                replay.sample(i).position[axis] - replay.sample(i - 1).position[axis];
            if (step * last < 0.0) ++turns;
            if (step != 0.0) last = step;
        }
        return turns <= 1;
    });
}

namespace {

/// True for a laser or autocollimator, whose cycles may be as long as there are folds, and for an
/// instrument that reads the points of a grid.
bool may_come_in_fives(records::Device device) {
    return reads_targets(device) || device == records::Device::point;
}

/// Fold of a block of such a device: else the same targets would be left out in every cycle, or a
/// place of an axis in all layers. The sum of the digits of its number.
int scattered_fold(int block) {
    int sum = 0;
    for (; block > 0; block /= Folds::count) sum += block % Folds::count;
    return sum % Folds::count;
}

}  // namespace

Folds make_folds(const std::vector<NoiseBlock>& blocks, std::size_t rows) {
    Folds folds;
    folds.group.assign(rows, 0);
    const auto logs = std::count_if(blocks.begin(), blocks.end(), [](const NoiseBlock& b) {
        return b.device == records::Device::axis;
    });
    int pass = 0;
    for (const NoiseBlock& block : blocks) {
        // With few servo logs parts of them are left out, with many whole ones.
        const bool bar = block.device == records::Device::ballbar ||
                         (block.device == records::Device::axis && logs < Folds::count);
        const std::size_t pieces = bar ? std::min<std::size_t>(6, 1 + block.rows.size() / 8) : 1;
        const auto first = static_cast<int>(folds.fold.size());
        for (std::size_t k = 0; k < block.rows.size(); ++k)
            folds.group[static_cast<std::size_t>(block.rows[k])] =
                first + static_cast<int>(k * pieces / block.rows.size());
        for (std::size_t k = 0; k < pieces; ++k)
            folds.fold.push_back(bar ? (3 * pass + static_cast<int>(k)) % Folds::count
                                 : may_come_in_fives(block.device) ? scattered_fold(pass)
                                                                   : pass % Folds::count);
        ++pass;
    }
    // Of few poses each is left out alone: with a fifth of them missing, an effect of several
    // parameters would not be determined.
    if (folds.fold.size() == blocks.size() && blocks.size() <= few_poses)
        std::iota(folds.fold.begin(), folds.fold.end(), 0);
    return folds;
}

namespace {

/// Places at which an instrument reads several targets, numbered; by block, -1 elsewhere.
std::vector<int> poses_of_targets(const std::vector<NoiseBlock>& blocks,
                                  const emulator::Replay& replay,
                                  const records::ReadingTable& table) {
    struct Pose {
        int number;
        std::set<int> targets;
    };
    std::map<std::vector<double>, Pose> known;
    std::vector<std::vector<double>> at(blocks.size());
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        if (blocks[b].device != records::Device::point) continue;
        const auto first = static_cast<std::size_t>(blocks[b].rows.front());
        for (const Axis axis : table.axes)
            at[b].push_back(table.rows[replay.table_row(first)].commanded[axis]);
        const auto [pose, added] =
            known.try_emplace(at[b], Pose{static_cast<int>(known.size()), {}});
        pose->second.targets.insert(replay.contact(first).artefact);
    }
    std::vector<int> poses(blocks.size(), -1);
    for (std::size_t b = 0; b < blocks.size(); ++b)
        if (const auto pose = known.find(at[b]);
            pose != known.end() && pose->second.targets.size() > 1)
            poses[b] = pose->second.number;
    return poses;
}

}  // namespace

void join_targets(const std::vector<NoiseBlock>& blocks, const emulator::Replay& replay,
                  const records::ReadingTable& table, Folds& folds) {
    const std::vector<int> poses = poses_of_targets(blocks, replay, table);
    if (std::all_of(poses.begin(), poses.end(), [](int p) { return p < 0; })) return;
    std::map<int, int> group_of_pose, renumbered;
    std::vector<int> fold;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const int pose = poses[b];
        for (const Eigen::Index row : blocks[b].rows) {
            int& group = folds.group[static_cast<std::size_t>(row)];
            const int own = pose < 0 ? group : group_of_pose.try_emplace(pose, group).first->second;
            const auto [at, added] = renumbered.try_emplace(own, static_cast<int>(fold.size()));
            if (added) fold.push_back(folds.fold[static_cast<std::size_t>(own)]);
            group = at->second;
        }
    }
    folds.fold = std::move(fold);
    const bool only_poses = std::none_of(poses.begin(), poses.end(), [](int p) { return p < 0; });
    if (only_poses && folds.fold.size() <= few_poses)
        std::iota(folds.fold.begin(), folds.fold.end(), 0);
}

namespace {

/// The direction of all motions of an axis; 0 where it moves both ways, or not at all.
signed char only_direction(const emulator::Replay& replay, Axis axis) {
    signed char only = 0;
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const signed char travel = replay.sample(i).travel[index_of(axis)];
        if (replay.sample(i).side_unknown[index_of(axis)] || travel == 0) continue;
        if (only != 0 && travel != only) return 0;
        only = travel;
    }
    return only;
}

/// Sides that nothing tells, of axes that move both ways. An axis that never reverses came the same
/// way: else what its first place has of its own would be a play.
std::vector<std::size_t> sides_to_find(emulator::Replay& replay,
                                       const std::vector<identification::FoundSide>& found) {
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < replay.unknown_sides().size(); ++k) {
        if (std::any_of(found.begin(), found.end(), [&](const auto& s) { return s.open == k; }))
            continue;
        if (const signed char only = only_direction(replay, replay.unknown_sides()[k].axis))
            replay.assume_side(k, only);
        else
            open.push_back(k);
    }
    return open;
}

}  // namespace

Prepared::Prepared(const setup::Setup& setup, const records::ReadingTable& readings)
    : table(readings),
      replay(setup, readings),
      catalogue(effects::make_catalogue(setup, effects::extent_of(setup, readings))),
      only_rivals(jumps_like_moves(catalogue)) {
    if (replay.size() < least_readings)
        throw InputError(fmt::format("{} readings allow no diagnosis: it takes {} or more",
                                     replay.size(), least_readings),
                         {table.path, 0, 0});
    base_sides = sides =
        identification::choose_sides(setup, table, replay, catalogue, setup.model.modelled);
    open_sides = sides_to_find(replay, sides);
    base = identification::fit_base(setup, table, replay, catalogue, setup.model.modelled);
    stated_sigma_mm = base.sigma_mm;
    blocks = noise_blocks(replay, table);
    rounding_mm = identification::rounding(table, replay);
    const std::vector<Eigen::Index> cycles = cycles_of(replay, table);
    const std::vector<bool> all(replay.size(), true);
    cycle = cycles_between_jumps({replay, table, blocks, all, cycles, rounding_mm},
                                 base.residual_mm, base.sigma_mm);
    folds = make_folds(blocks, replay.size());
    spread_visits(blocks, replay, table, folds);
    join_targets(blocks, replay, table, folds);
}

Prepared prepare(const setup::Setup& setup, const records::ReadingTable& table) {
    const setup::Setup indexed = identification::with_index_errors(setup, table);
    return Prepared(identification::with_start_poses(indexed, table), table);
}

void free_zeros(const emulator::Replay& replay, const Eigen::VectorXd& sigma_mm,
                Eigen::VectorXd& left_mm) {
    for (const emulator::ZeroGroup& group : replay.zeros()) {
        const Eigen::VectorXd weight = sigma_mm(group.rows).cwiseAbs2().cwiseInverse();
        const double mean = left_mm(group.rows).dot(weight) / weight.sum();
        for (const std::size_t k : group.rows) left_mm(static_cast<Eigen::Index>(k)) -= mean;
    }
}

void refuse_poor_holdout(const Prepared& prepared, const records::ReadingTable& holdout) {
    const emulator::Replay replay(prepared.base.setup, holdout);
    if (replay.size() == 0) throw InputError("no held-out reading", {holdout.path, 0, 0});
    const std::vector<double> read = replay.predict(prepared.base.models);
    Eigen::VectorXd left_mm(static_cast<Eigen::Index>(replay.size()));
    const auto row_of = [&](Eigen::Index i) -> const records::Reading& {
        return holdout.rows[replay.table_row(static_cast<std::size_t>(i))];
    };
    for (Eigen::Index i = 0; i < left_mm.size(); ++i) {
        if (!row_of(i).value_mm)
            throw InputError("a held-out row with a device but without value_mm",
                             records::place_of(holdout, row_of(i)));
        left_mm(i) = *row_of(i).value_mm - read[static_cast<std::size_t>(i)];
    }
    free_medians(rows_of_zeros(replay), left_mm);
    for (Eigen::Index i = 0; i < left_mm.size(); ++i)
        if (std::abs(left_mm(i)) > identification::absurd_residual_mm(prepared.base.setup))
            throw InputError(fmt::format("held out, {} mm away from what the simulation reads: "
                                         "wrong units (um for mm?), wrong frame, another machine",
                                         three_digits(left_mm(i))),
                             records::place_of(holdout, row_of(i)));
}

void refuse_one_session(const Prepared& prepared) {
    if (prepared.replay.sessions().size() < 2)
        throw InputError(
            "what changed between sessions needs two of them or more; the column session says "
            "which rows belong to which",
            {prepared.table.path, 0, 0});
}

bool modelled(const Prepared& prepared, const effects::Effect& effect) {
    const auto& names = prepared.base.setup.model.modelled;
    return std::find(names.begin(), names.end(), effect.name) != names.end();
}

bool is_searched(const Prepared& prepared, const effects::Effect& effect) {
    const bool drift = effect.kind == effects::EffectKind::thermal_drift;
    return !modelled(prepared, effect) && (!drift || records::has_times(prepared.table));
}

}  // namespace trunnion::diagnosis
