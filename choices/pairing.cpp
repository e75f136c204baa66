#include "choices/pairing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "choices/band.h"
#include "choices/passed_nodes.h"
#include "choices/row_keys.h"
#include "choices/row_losses.h"
#include "choices/space.h"
#include "choices/way_match.h"

namespace trunnion::choices {

namespace {

using offsets::ControlPosition;

constexpr std::size_t most_cells = 4'000'000;  ///< of one block's table; beyond it, only a band is
                                               ///< computed
constexpr std::size_t wider = 4, widest = 16;  ///< of the margins of a band that was narrow
constexpr double noise_sigmas = 6.0;           ///< of a row: less adds no way, and is no way back
constexpr int most_limits = 15;
constexpr double farther = 64.0;   ///< the next limit of a cost
constexpr double as_cheap = 1e-6;  ///< of the square of a sigma

class Pairer {
  public:
    Pairer(const LogView& log, const ControlPath& path, const RowKeys& keys)
        : log_(log), path_(path), space_(log.axes), keys_(keys), passed_(log, path) {
        row_node_.assign(log.rows.size(), missing);
        node_row_.assign(path.nodes.size(), missing);
    }

    std::vector<Pair> pair() {
        group();
        if (!log_.ends) measure();
        const std::optional<std::size_t> begun = begin();
        for (std::size_t g = 0; g < rows_.size(); ++g)
            if (g != begun) warp(g);
        add_lonely_rows();
        add_lonely_nodes();
        return std::move(pairs_);
    }

  private:
    static constexpr std::size_t missing = std::numeric_limits<std::size_t>::max();

    void group() {
        rows_.resize(static_cast<std::size_t>(keys_.count));
        nodes_.resize(rows_.size());
        for (std::size_t i = 0; i < log_.rows.size(); ++i)
            if (const int key = keys_.of_row[i]; key >= 0)
                rows_[static_cast<std::size_t>(key)].push_back(i);
        for (std::size_t k = 1; k < path_.nodes.size(); ++k)
            if (const int key = keys_.of_node[k]; key >= 0)
                nodes_[static_cast<std::size_t>(key)].push_back(k);
    }
    void warp(std::size_t g) {
        if (rows_[g].empty() || nodes_[g].empty()) return;
        log_.ends ? warp_ends(rows_[g], nodes_[g]) : warp_samples(rows_[g], nodes_[g]);
    }
    /// The first row of a block with motion tells where a log begins that does so within the
    /// program; no row belongs to a node before. Its group.
    std::optional<std::size_t> begin() {
        if (!log_.begins_within) return std::nullopt;
        for (std::size_t i = 0; i < log_.rows.size(); ++i) {
            if (keys_.of_row[i] < 0) continue;
            const auto g = static_cast<std::size_t>(keys_.of_row[i]);
            if (nodes_[g].empty()) continue;
            opening_row_ = i;
            warp(g);
            begin_node_ = pairs_.empty() ? 0 : pairs_.front().node;
            for (const Pair& pair : pairs_)
                begin_node_ = std::min<std::size_t>(begin_node_, pair.node);
            for (Indices& nodes : nodes_)
                std::erase_if(nodes, [this](std::size_t k) { return k < begin_node_; });
            return g;
        }
        return std::nullopt;
    }

    const ControlPosition& row_at(std::size_t i) const { return log_.rows[i].at; }
    const ControlPosition& node_at(std::size_t k) const { return path_.nodes[k].at; }

    template <class At>
    Way way(const Indices& list, double ball, At at) const {
        std::vector<double> points;
        for (const std::size_t k : list) space_.append(at(k), points);
        return {std::move(points), space_.axes(), ball};
    }
    Band band_of(const Indices& rows, const Indices& nodes, std::size_t wide) const {
        if (rows.size() * nodes.size() <= most_cells) return {rows.size(), nodes.size()};
        const double ball = noise_sigmas / log_.rows[rows.front()].weight;
        const auto row = [this](std::size_t i) -> auto& {
            return row_at(i);
        };
        const auto node = [this](std::size_t k) -> auto& {
            return node_at(k);
        };
        return {matched_ways(way(rows, ball, row), way(nodes, 0.0, node),
                             {opens(rows), ends_open(rows)}, wide),
                nodes.size()};
    }
    /// The log begins within the program.
    bool opens(const Indices& rows) const { return rows.front() == opening_row_; }
    /// The last row of the log may be anywhere, because the following ones are unknown.
    bool ends_open(const Indices& rows) const {
        return !log_.whole && rows.back() + 1 == log_.rows.size();
    }

    void add(std::size_t row, std::size_t node, double fraction, const ControlPosition& apart,
             bool slides) {
        pairs_.push_back({row, static_cast<std::uint32_t>(node), fraction, apart, slides});
        if (row_node_[row] == missing || row_node_[row] < node) row_node_[row] = node;
        if (node_row_[node] == missing || node_row_[node] < row) node_row_[node] = row;
    }
    void add_end(std::size_t row, std::size_t node) {
        add(row, node, 1.0, space_.apart(row_at(row), node_at(node)), false);
    }

    /// The band in which the cheapest way keeps off the edges, and the last row's costs.
    template <class Fill>
    std::pair<Band, std::vector<double>> filled(const Indices& rows, const Indices& nodes,
                                                Fill fill, std::size_t first) const {
        for (std::size_t wide = 1;; wide *= wider) {
            Band band = band_of(rows, nodes, wide);
            std::vector<double> last = fill(band);
            const bool narrow =
                wide < widest &&
                band.is_narrow(rows.size(), last_cell(last, first, ends_open(rows)));
            if (!narrow) return {std::move(band), std::move(last)};
        }
    }

    void warp_ends(const Indices& rows, const Indices& nodes) {
        auto [band, last] = filled(
            rows, nodes, [&](Band& b) { return fill_ends(rows, nodes, b); }, 1);
        std::size_t i = rows.size(), j = last_cell(last, 1, ends_open(rows));
        while (i > 0 && j > 0) {
            const std::uint8_t step = band.step(i, j);
            add_end(rows[i - 1], step == start ? nodes[j] - 1 : nodes[j - 1]);
            if (step != node) --i;
            if (step == both || step == node) --j;
        }
        for (; i > 0 && rests(rows[i - 1]); --i) add_end(rows[i - 1], nodes[0] - 1);
    }
    /// A row that does not move tells no end of a move: it may stand where the next one begins.
    bool rests(std::size_t i) const {
        const double weight = log_.rows[i].weight;
        return i > 0 && space_.square(row_at(i), row_at(i - 1)) * weight * weight <= 1.0;
    }
    double start_square(std::size_t i, const Indices& nodes, std::size_t j) const {
        return space_.square(row_at(i), node_at(nodes[j] - 1));
    }
    std::vector<double> fill_ends(const Indices& rows, const Indices& nodes, Band& band) const {
        Costs costs(nodes.size() + 1);
        auto& [before, now] = costs;
        before[0] = 0.0;
        if (opens(rows)) std::fill_n(before.begin(), band.high(0) + 1, 0.0);
        for (std::size_t i = 1; i <= rows.size(); ++i) {
            end_if_asked(i);
            const std::size_t r = rows[i - 1];
            const bool resting = rests(r);
            if (resting && band.low(i) == 0) now[0] = before[0] + start_square(r, nodes, 0);
            for (std::size_t j = std::max<std::size_t>(1, band.low(i)); j <= band.high(i); ++j) {
                const double own = space_.square(row_at(r), node_at(nodes[j - 1]));
                const double least = std::min({before[j - 1], before[j], now[j - 1]});
                now[j] = least + own;
                band.step(i, j) = before[j - 1] == least ? both : before[j] == least ? row : node;
                if (!resting || j == nodes.size()) continue;
                const double stays = before[j] + start_square(r, nodes, j);
                if (stays >= now[j]) continue;
                now[j] = stays;
                band.step(i, j) = start;
            }
            costs.next(band, i);
        }
        return std::move(before);
    }

    void measure() {
        passed_.measure();
        length_.assign(path_.nodes.size(), 0.0);
        for (std::size_t k = 1; k < length_.size(); ++k)
            length_[k] = std::sqrt(space_.square(node_at(k - 1), node_at(k)));
    }
    /// The nearest place to a row that is no way back from where the rows before have come.
    Spot spot(std::size_t i, std::size_t k, const Progress& before) const {
        if (log_.rows[i].end && !rests(i)) return {length_[k], false};
        const double along = length_[k] * space_.nearest(node_at(k - 1), node_at(k), row_at(i));
        const double least = before.along_mm - noise_sigmas / log_.rows[i].weight;
        if (along < least) return {least, true};
        return {along, along > 0.0 && along < length_[k]};
    }
    double fraction(const Spot& spot, std::size_t k) const {
        return length_[k] > 0.0 && spot.along_mm < length_[k] ? spot.along_mm / length_[k] : 1.0;
    }
    ControlPosition apart_at(const Spot& spot, std::size_t i, std::size_t k) const {
        return space_.apart(row_at(i),
                            space_.between(node_at(k - 1), node_at(k), fraction(spot, k)));
    }
    Progress with_row(const Progress& before, const Spot& spot, std::size_t i) const {
        return passed_.strides().with_row(before, spot.along_mm, i, i > 0 && !log_.rows[i - 1].cut);
    }

    /// The last one of some rows on the segment to a node, or a node that is passed after it.
    struct Placed {
        std::size_t rows, node;
        bool passed;
    };
    void warp_samples(const Indices& rows, const Indices& nodes) {
        auto [band, last] = filled(
            rows, nodes, [&](Band& b) { return fill_samples(rows, nodes, b); }, 0);
        const bool open = ends_open(rows);
        std::size_t i = rows.size(), j = last_cell(last, 0, open);
        std::vector<Placed> order;  // from the last one back
        if (!open) order.push_back({i, nodes.back(), true});
        while (i > 0) {
            const bool passed = band.step(i, j) == node;
            if (passed) --j;
            order.push_back({i, nodes[j], passed});
            if (!passed) --i;
        }
        while (j > 0 && !opens(rows)) order.push_back({0, nodes[--j], true});
        add_in_order(rows, order);
    }
    /// `order` goes back; what rows have passed goes on.
    void add_in_order(const Indices& rows, const std::vector<Placed>& order) {
        const std::size_t first = pairs_.size();
        Progress motion;
        for (auto at = order.rbegin(); at != order.rend(); ++at) {
            const std::size_t k = at->node;
            if (at->passed) {
                const std::size_t from = passed_.row_at(rows, at->rows, k, motion);
                const PassedNodes::Cost cost = passed_.cost(from, k, motion);
                if (cost.before > 0.0) add_missed_before(first, motion);
                add_missed(from, k, motion);
                motion = passed_.after(motion, k, cost);
            } else {
                const std::size_t i = rows[at->rows - 1];
                const Spot here = spot(i, k, motion);
                add(i, k, fraction(here, k), apart_at(here, i, k), here.slides);
                motion = with_row(motion, here, i);
            }
        }
        // The last pair of a row is that of its own place.
        std::reverse(pairs_.begin() + static_cast<std::ptrdiff_t>(first), pairs_.end());
    }
    /// A way that costs little needs only the cells that cost no more.
    std::vector<double> fill_samples(const Indices& rows, const Indices& nodes, Band& band) const {
        const double weight = log_.rows[rows.front()].weight;
        double limit = static_cast<double>(rows.size() * log_.axes.size()) / (weight * weight);
        for (int turn = 1;; ++turn) {
            if (auto last = filled_within(limit, rows, nodes, band)) return std::move(*last);
            limit = turn < most_limits ? farther * limit : infinite;
        }
    }
    /// Cell (i, j): i rows are placed, the last ones on the segment to node j + 1 or before.
    /// Nothing if no way through the table costs at most `limit`.
    std::optional<std::vector<double>> filled_within(double limit, const Indices& rows,
                                                     const Indices& nodes, Band& band) const {
        const std::size_t n = nodes.size();
        Costs costs(n);
        auto& [before, now] = costs;
        std::vector<Progress> come(n), comes(n);  // of the rows in `before` and `now`
        for (std::size_t i = 0; i <= rows.size(); ++i) {
            end_if_asked(i);
            if (i == 0) now[0] = 0.0;
            if (i == 0 && opens(rows)) std::fill_n(now.begin(), std::min(n, band.high(0) + 1), 0.0);
            const double weight = log_.rows[rows[i - std::min<std::size_t>(i, 1)]].weight,
                         tie = as_cheap / (weight * weight);
            bool any = false;
            for (std::size_t j = band.low(i); j < std::min(n, band.high(i) + 1); ++j) {
                comes[j] = {};
                if (i > 0 && before[j] < infinite) {
                    const Spot here = spot(rows[i - 1], nodes[j], come[j]);
                    now[j] = before[j] + space_.square(apart_at(here, rows[i - 1], nodes[j]), {});
                    comes[j] = with_row(come[j], here, rows[i - 1]);
                    band.step(i, j) = row;
                }
                // Nothing that is passed makes a way cheaper; of two ways as cheap, the one that
                // has not come far on its segment.
                if (j > 0 && now[j - 1] < infinite && now[j - 1] <= now[j] + tie) {
                    const std::size_t k = nodes[j - 1],
                                      from = passed_.row_at(rows, i, k, comes[j - 1]);
                    const PassedNodes::Cost cost = passed_.cost(from, k, comes[j - 1]);
                    if (now[j - 1] + cost.sum() <= now[j] + tie) {
                        now[j] = now[j - 1] + cost.sum();
                        comes[j] = passed_.after(comes[j - 1], k, cost);
                        band.step(i, j) = node;
                    }
                }
                if (now[j] > limit) now[j] = infinite;
                any = any || now[j] < infinite;
            }
            if (!any && limit < infinite) return std::nullopt;
            std::swap(come, comes);
            costs.next(band, i);
        }
        const bool found = before[last_cell(before, 0, ends_open(rows))] < infinite;
        return found || limit == infinite ? std::optional(std::move(before)) : std::nullopt;
    }
    void add_missed(std::size_t i, std::size_t k, const Progress& motion) {
        const ControlPosition apart = passed_.missed(i, k, motion);
        if (space_.square(apart, {}) > 0.0) add(i, k, 1.0, apart, false);
    }

    /// In place of what the node cost when it was passed. `first`: of this block's pairs.
    void add_missed_before(std::size_t first, const Progress& motion) {
        const auto passed = std::find_if(
            pairs_.begin() + static_cast<std::ptrdiff_t>(first), pairs_.end(), [&](const Pair& p) {
                return p.node == motion.begin && p.fraction == 1.0 && p.row != motion.first;
            });
        if (motion.told > 0.0 && passed != pairs_.end()) pairs_.erase(passed);
        add(motion.first, motion.begin, 1.0, passed_.missed_before(motion), false);
    }

    /// Rows of blocks without motion here: the control is at the position of the previous row.
    void add_lonely_rows() {
        std::size_t node = 0;
        for (std::size_t i = 0; i < log_.rows.size(); ++i) {
            if (row_node_[i] != missing)
                node = row_node_[i];
            else
                add_end(i, node);
        }
    }
    /// Moves of blocks that the log does not contain: the log is at the position of the previous
    /// node.
    void add_lonely_nodes() {
        std::size_t last = 0;
        for (const Pair& pair : pairs_) last = std::max<std::size_t>(last, pair.node);
        const auto has_rows = [this](std::size_t k) {
            const int key = keys_.of_node[k];
            return key >= 0 && !rows_[static_cast<std::size_t>(key)].empty();
        };
        std::size_t row = 0;
        for (std::size_t k = std::max<std::size_t>(1, begin_node_); k < last; ++k) {
            if (node_row_[k] != missing) {
                row = node_row_[k];
            } else if (!has_rows(k)) {
                log_.ends ? add_end(row, k) : add_missed(row, k, {});
            }
        }
    }

    const LogView& log_;
    const ControlPath& path_;
    Space space_;
    const RowKeys& keys_;
    std::vector<Indices> rows_, nodes_;  ///< by key
    std::size_t opening_row_ = missing;  ///< the first row of a log that begins within the program
    std::size_t begin_node_ = 0;         ///< nodes before are not judged
    Indices row_node_, node_row_;
    PassedNodes passed_;
    std::vector<double> length_;  ///< of the segment to each node, mm or deg
    std::vector<Pair> pairs_;
};

}  // namespace

std::vector<Pair> pair_up(const LogView& log, const ControlPath& path) {
    const RowKeys keys = keys_of(log, path);
    std::vector<Pair> out = Pairer(log, path, keys).pair();
    const std::vector<RowKeys> others = keys_by_order(log, path, keys);
    if (others.empty()) return out;
    const auto loss = [&log](const std::vector<Pair>& pairs) {
        double sum = 0.0;
        for (const double one : row_losses(log, pairs)) sum += one;
        return sum;
    };
    double least = loss(out);
    for (const RowKeys& other : others) {
        std::vector<Pair> pairs = Pairer(log, path, other).pair();
        if (const double own = loss(pairs); own < least) {
            least = own;
            out = std::move(pairs);
        }
    }
    return out;
}

}  // namespace trunnion::choices
