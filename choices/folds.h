// Which rows of a log are left out together.
#pragma once

#include <set>
#include <vector>

namespace trunnion::choices {

constexpr int fold_count = 5;

/// A row that a change moves nearer or farther by more than chance, in squares of its sigma.
bool is_changed(double before, double after);

/// Blocks whose rows a change touches; all three have one value a row.
std::set<int> changed_blocks(const std::vector<double>& before, const std::vector<double>& after,
                             const std::vector<int>& blocks);

/// Fold of each row: whole blocks in turn, those that the change touches spread evenly. Where it
/// touches one block only, that block's rows in turn: nothing else can be left out.
std::vector<int> folds_for(const std::vector<double>& before, const std::vector<double>& after,
                           const std::vector<int>& blocks);

}  // namespace trunnion::choices
