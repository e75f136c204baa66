#include "diagnosis/prepare/target_visits.h"

#include <algorithm>
#include <array>
#include <map>
#include <string>

namespace trunnion::diagnosis {
namespace {

/// A target of a test: where it stands, and in which direction it is read.
struct Target {
    std::string session, test;
    std::vector<double> place;
    auto operator<=>(const Target&) const = default;
};

Target target_of(const emulator::Replay& replay, const records::ReadingTable& table,
                 std::size_t i) {
    const records::Reading& row = table.rows[replay.table_row(i)];
    Target target{row.session, row.test, {}};
    for (const Axis axis : table.axes) target.place.push_back(row.commanded[axis]);
    const Vector3& direction = replay.contact(i).direction_M;
    target.place.insert(target.place.end(), direction.data(), direction.data() + 3);
    return target;
}

using VisitsInFolds = std::array<int, Folds::count>;

/// The fold with the fewest visits, from `start` on.
int emptiest(const VisitsInFolds& visits, int start) {
    int best = start;
    for (int k = 1; k < Folds::count; ++k) {
        const int fold = (start + k) % Folds::count;
        if (visits[static_cast<std::size_t>(fold)] < visits[static_cast<std::size_t>(best)])
            best = fold;
    }
    return best;
}

}  // namespace

void spread_visits(const std::vector<NoiseBlock>& blocks, const emulator::Replay& replay,
                   const records::ReadingTable& table, Folds& folds) {
    if (std::any_of(folds.fold.begin(), folds.fold.end(),
                    [](int fold) { return fold >= Folds::count; }))
        return;
    std::map<Target, VisitsInFolds> known;
    for (const NoiseBlock& block : blocks) {
        if (!reads_targets(block.device)) continue;
        std::vector<VisitsInFolds*> targets;
        VisitsInFolds visits{};
        for (const Eigen::Index row : block.rows) {
            targets.push_back(&known[target_of(replay, table, static_cast<std::size_t>(row))]);
            for (std::size_t f = 0; f < visits.size(); ++f) visits[f] += (*targets.back())[f];
        }
        int& fold = folds.fold[static_cast<std::size_t>(
            folds.group[static_cast<std::size_t>(block.rows.front())])];
        fold = emptiest(visits, fold);
        for (VisitsInFolds* target : targets) ++(*target)[static_cast<std::size_t>(fold)];
    }
}

}  // namespace trunnion::diagnosis
