// Table of dynamic time warping: the evaluated part, and its running costs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "choices/way_match.h"

namespace trunnion::choices {

using Indices = std::vector<std::size_t>;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t edge_nodes = 4;  ///< of a band: too near to its edge

/// `start`: a row at the start of the next node's move.
enum Step : std::uint8_t { none, both, row, node, start };

/// The evaluated part of a table of m by n cells, and the step into each cell.
class Band {
  public:
    Band(std::size_t m, std::size_t n) : low_(m + 1, 0), high_(m + 1, n) { lay(); }
    /// `nodes`: those that each row may belong to, of n.
    Band(const Spans& nodes, std::size_t n) : low_{0}, high_{nodes.high.front() + 1} {
        for (std::size_t i = 0; i < nodes.low.size(); ++i) {
            low_.push_back(nodes.low[i]);
            high_.push_back(nodes.high[i] + 1);
        }
        high_.back() = n;
        lay();
    }
    std::size_t low(std::size_t i) const { return low_[i]; }
    std::size_t high(std::size_t i) const { return high_[i]; }
    std::uint8_t& step(std::size_t i, std::size_t j) { return step_[offset_[i] + (j - low_[i])]; }
    /// The way back from a cell comes near an edge that is not one of the table: a cheaper one may
    /// lie beyond.
    bool is_narrow(std::size_t i, std::size_t j) {
        while (i > 0 && j > 0) {
            const bool low = low_[i] > 0 && j < low_[i] + edge_nodes;
            if (low || (j + edge_nodes > high_[i] && high_[i] < high_.back())) return true;
            const std::uint8_t by = step(i, j);
            if (by != node) --i;
            if (by == both || by == node) --j;
        }
        return false;
    }

  private:
    void lay() {
        offset_.assign(low_.size(), 0);
        for (std::size_t i = 1; i < low_.size(); ++i)
            offset_[i] = offset_[i - 1] + high_[i - 1] - low_[i - 1] + 1;
        step_.assign(offset_.back() + high_.back() - low_.back() + 1, 0);
    }

    Indices low_, high_, offset_;
    std::vector<std::uint8_t> step_;
};

/// Costs of the present row of a table and of the one before; infinite outside their band.
class Costs {
  public:
    explicit Costs(std::size_t n) : before(n, infinite), now(n, infinite) {}
    std::vector<double> before, now;

    /// Row i is complete.
    void next(const Band& band, std::size_t i) {
        std::swap(before, now);
        if (i == 0) return;
        const std::size_t end = std::min(now.size(), band.high(i - 1) + 1);
        std::fill(now.begin() + static_cast<std::ptrdiff_t>(std::min(end, band.low(i - 1))),
                  now.begin() + static_cast<std::ptrdiff_t>(end), infinite);
    }
};

/// Where the way through a table ends: in its last cell, or in the cheapest one from `first` on.
inline std::size_t last_cell(const std::vector<double>& costs, std::size_t first, bool open) {
    if (!open) return costs.size() - 1;
    const auto least =
        std::min_element(costs.begin() + static_cast<std::ptrdiff_t>(first), costs.end());
    return static_cast<std::size_t>(least - costs.begin());
}

}  // namespace trunnion::choices
