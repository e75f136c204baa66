// Numbers and places of a gap, from runs of one log.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "base/random.h"
#include "choices/block_texts.h"
#include "choices/control_gap.h"
#include "estimation/distributions.h"

namespace trunnion::choices {

/// Creates the results from runs of one log.
class Teller {
  public:
    /// `directions`: in which each row can differ.
    Teller(const LogOfProgram& log, const BlockTexts& texts, const std::vector<int>& blocks,
           std::vector<double> directions)
        : log_(log), texts_(texts), blocks_(blocks), directions_(std::move(directions)) {}

    double mean_um(const std::vector<double>& losses) const {
        double sum = 0.0;
        for (std::size_t row = 0; row < losses.size(); ++row) sum += square_um(losses[row], row);
        return std::sqrt(sum / static_cast<double>(losses.size()));
    }
    double noise_um() const {
        const double all = std::accumulate(directions_.begin(), directions_.end(), 0.0);
        return um(log_.sigma) * std::sqrt(all / static_cast<double>(directions_.size()));
    }
    double noise_loss() const {
        return static_cast<double>(log_.view.axes.size() * log_.view.rows.size());
    }
    /// The pair with the largest distance among the rows accepted by `counts`.
    template <class Counts>
    GapPlace worst(const ComparedRun& run, Counts counts) const {
        const Pair* most = nullptr;
        for (const Pair& pair : run.pairs)
            if (counts(pair.row) && (most == nullptr || size(pair) > size(*most))) most = &pair;
        return most == nullptr ? GapPlace{} : place(run, *most);
    }
    template <class Counts>
    GapPlace first(const ComparedRun& run, Counts counts) const {
        const Pair* first = nullptr;
        for (const Pair& pair : run.pairs) {
            if (!counts(pair.row)) continue;
            const bool earlier = first == nullptr || pair.row < first->row ||
                                 (pair.row == first->row && size(pair) > size(*first));
            if (earlier) first = &pair;
        }
        return first == nullptr ? GapPlace{} : place(run, *first);
    }
    /// `excess`: loss beyond noise, to which the shares refer.
    std::vector<GapBlock> where(const ComparedRun& run, double excess) const {
        std::map<int, std::pair<double, double>> loss;  // and the number of terms
        for (std::size_t row = 0; row < run.losses.size(); ++row) {
            loss[blocks_[row]].first += run.losses[row];
            loss[blocks_[row]].second += static_cast<double>(log_.view.axes.size());
        }
        std::vector<std::pair<double, int>> order;
        for (const auto& [block, l] : loss) order.emplace_back(-l.first, block);
        std::sort(order.begin(), order.end());
        std::vector<GapBlock> out;
        for (const auto& [negative, block_number] : order) {
            const int block = block_number;
            const double terms = loss[block].second;
            const double p = estimation::chi_squared_tail(-negative, terms);
            if (out.size() == most_where || p > 1e-4) break;
            out.push_back({worst(run, [&](std::size_t row) { return blocks_[row] == block; }),
                           std::max(0.0, -negative - terms) / std::max(1.0, excess), p});
        }
        return out;
    }
    /// Removed part of the excess over the noise, as amplitude, with its spread over blocks.
    GapShrink shrink(const std::vector<double>& before, const std::vector<double>& after) const {
        GapShrink out{mean_um(before), mean_um(after), 0.0, 0.0, 0.0};
        // The noise is not known to a few percent: beside a large gap it is taken generously.
        const double axes = static_cast<double>(log_.view.axes.size());
        const bool is_small = sum_of(before) < small_gap * noise_loss();
        std::map<int, std::array<double, 3>> sums;
        for (std::size_t row = 0; row < before.size(); ++row) {
            auto& s = sums[blocks_[row]];
            s[0] += before[row];
            s[1] += after[row];
            s[2] += is_small ? directions_[row] : axes;
        }
        std::vector<std::array<double, 3>> list;
        for (const auto& [block, s] : sums) list.push_back(s);
        out.shrink = shrink_of(list, [](std::size_t k) { return k; });
        SeededNoise random(1);
        std::vector<double> drawn;
        for (int d = 0; d < draws; ++d)
            drawn.push_back(shrink_of(list, [&](std::size_t) {
                return std::min(
                    list.size() - 1,
                    static_cast<std::size_t>(random.uniform() * static_cast<double>(list.size())));
            }));
        std::sort(drawn.begin(), drawn.end());
        out.low = drawn[draws / 40];
        out.high = drawn[draws - 1 - draws / 40];
        return out;
    }
    GapPlace place(const ComparedRun& run, const Pair& pair) const {
        const PathBlock& block = run.path.blocks[run.path.nodes[pair.node].block];
        return {block.program, block.line, block.line > 0 ? texts_.block(block) : std::string(),
                size(pair), log_.view.rows[pair.row].line};
    }

  private:
    static constexpr std::size_t most_where = 5;
    static constexpr int draws = 400;
    static constexpr double small_gap = 1.5;  ///< mean loss

    static double um(double mm) { return 1000.0 * mm; }
    template <class Pick>
    static double shrink_of(const std::vector<std::array<double, 3>>& list, Pick pick) {
        double before = 0.0, after = 0.0;
        for (std::size_t k = 0; k < list.size(); ++k) {
            const auto& s = list[pick(k)];
            before += s[0] - s[2];
            after += s[1] - s[2];
        }
        if (before <= 0.0) return 0.0;
        return std::clamp(1.0 - std::sqrt(std::max(0.0, after) / before), 0.0, 1.0);
    }
    double square_um(double loss, std::size_t row) const {
        const double weight = log_.view.rows[row].weight;
        return 1e6 * loss / (weight * weight);
    }
    double size(const Pair& pair) const {
        double sum = 0.0;
        for (const Axis axis : log_.view.axes) sum += pair.apart[axis] * pair.apart[axis];
        return std::sqrt(sum);
    }

    const LogOfProgram& log_;
    const BlockTexts& texts_;
    const std::vector<int>& blocks_;
    std::vector<double> directions_;
};

}  // namespace trunnion::choices
