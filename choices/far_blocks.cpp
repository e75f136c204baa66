#include "choices/far_blocks.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace trunnion::choices {

namespace {

constexpr double much_farther = 25.0;  ///< of the mean loss of a row: five times the distance
constexpr std::size_t one_in = 3;      ///< of the blocks with a gap: most that are far
constexpr std::size_t least_others = 3;
constexpr double set_aside = 1e-6;  ///< of a weight
constexpr double less_far = 0.9;    ///< of the loss of the others

/// Few blocks much farther away than the middle one of those with a gap.
std::set<int> far_blocks(const std::vector<double>& losses, const std::vector<int>& blocks,
                         double row_limit) {
    struct Sum {
        double loss = 0.0, most = 0.0;
        int rows = 0;
        double mean() const { return loss / rows; }
    };
    std::map<int, Sum> sums;
    for (std::size_t row = 0; row < losses.size(); ++row) {
        Sum& sum = sums[blocks[row]];
        sum.loss += losses[row];
        sum.most = std::max(sum.most, losses[row]);
        ++sum.rows;
    }
    std::erase_if(sums, [&](const auto& one) { return one.second.most <= row_limit; });
    std::vector<double> means;
    for (const auto& [block, sum] : sums) means.push_back(sum.mean());
    if (means.size() < least_others) return {};
    const auto middle = means.begin() + static_cast<std::ptrdiff_t>(means.size() / 2);
    std::nth_element(means.begin(), middle, means.end());
    std::set<int> out;
    for (const auto& [block, sum] : sums)
        if (sum.mean() > much_farther * *middle) out.insert(block);
    const bool few = one_in * out.size() <= sums.size();
    return few && sums.size() - out.size() >= least_others ? out : std::set<int>();
}

}  // namespace

GapSearch beside_far_blocks(const SearchQuestion& question, GapSearch found, double row_limit,
                            const std::function<void(const char*)>& watch) {
    const std::vector<int>& blocks = question.blocks;
    const std::set<int> far = far_blocks(found.run.losses, blocks, row_limit);
    if (far.empty()) return found;
    LogView view = question.comparer.log();
    for (std::size_t row = 0; row < view.rows.size(); ++row)
        if (far.contains(blocks[row])) view.rows[row].weight *= set_aside;
    const Comparer comparer = question.comparer.on(view);
    const ComparedRun before = comparer.run(question.setup);
    GapSearch other = search_causes(
        {comparer, question.setup, before, blocks, question.used, question.alike}, watch);
    other.run = question.comparer.run(other.setup);
    double now = 0.0, then = 0.0;
    for (std::size_t row = 0; row < blocks.size(); ++row) {
        if (far.contains(blocks[row])) {
            other.left_out[row] = other.run.losses[row];
            continue;
        }
        now += found.run.losses[row];
        then += other.run.losses[row];
    }
    return !other.steps.empty() && then < less_far * now ? std::move(other) : std::move(found);
}

}  // namespace trunnion::choices
