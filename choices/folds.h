// Rows of a log that are left out together.
#pragma once

#include <set>
#include <vector>

namespace trunnion::choices {

constexpr int fold_count = 5;

/// True for a row whose distance changes significantly, in squares of its sigma.
bool is_changed(double before, double after);

/// Blocks with rows affected by a change; all three have one value a row.
std::set<int> changed_blocks(const std::vector<double>& before, const std::vector<double>& after,
                             const std::vector<int>& blocks);

/// Fold of each row: whole blocks in turn, with affected blocks distributed evenly. If only one
/// block is affected, its affected rows in turn, because nothing else can be left out.
std::vector<int> folds_for(const std::vector<double>& before, const std::vector<double>& after,
                           const std::vector<int>& blocks);

}  // namespace trunnion::choices
