#include "choices/folds.h"

#include <cstddef>
#include <unordered_map>

namespace trunnion::choices {

bool is_changed(double before, double after) {
    return before - after > 1.0 || after - before > 1.0;
}

std::set<int> changed_blocks(const std::vector<double>& before, const std::vector<double>& after,
                             const std::vector<int>& blocks) {
    std::set<int> out;
    for (std::size_t row = 0; row < before.size(); ++row)
        if (is_changed(before[row], after[row])) out.insert(blocks[row]);
    return out;
}

std::vector<int> folds_for(const std::vector<double>& before, const std::vector<double>& after,
                           const std::vector<int>& blocks) {
    const std::set<int> changed = changed_blocks(before, after, blocks);
    std::unordered_map<int, int> order;  // of each affected block
    for (const int block : changed) order.emplace(block, static_cast<int>(order.size()));
    std::vector<int> out(blocks.size());
    int in_turn = 0;
    for (std::size_t row = 0; row < blocks.size(); ++row) {
        const auto at = order.find(blocks[row]);
        if (order.size() > 1 && at != order.end())
            out[row] = at->second % fold_count;
        else if (is_changed(before[row], after[row]))
            out[row] = in_turn++ % fold_count;
    }
    return out;
}

}  // namespace trunnion::choices
