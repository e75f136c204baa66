#include "choices/pairing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trunnion::choices {

namespace {

using offsets::ControlPosition;
using Indices = std::vector<std::size_t>;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr std::size_t most_cells = 4'000'000;  ///< of one block's table; beyond it, only a band is
                                               ///< computed
constexpr std::size_t least_half_band = 40;
constexpr std::size_t spacing_rows = 2;  ///< rows on each side for the distance of samples

/// Positions of the log's axes only.
class Space {
  public:
    explicit Space(const std::vector<Axis>& axes) {
        for (const Axis axis : axes) index_.push_back(index_of(axis));
    }
    double square(const ControlPosition& a, const ControlPosition& b) const {
        double sum = 0.0;
        for (const std::size_t i : index_)
            sum += (a.value[i] - b.value[i]) * (a.value[i] - b.value[i]);
        return sum;
    }
    /// Fraction of the point on the line a-b nearest to p.
    double nearest(const ControlPosition& a, const ControlPosition& b,
                   const ControlPosition& p) const {
        double along = 0.0, length = 0.0;
        for (const std::size_t i : index_) {
            const double way = b.value[i] - a.value[i];
            along += (p.value[i] - a.value[i]) * way;
            length += way * way;
        }
        return length > 0.0 ? std::clamp(along / length, 0.0, 1.0) : 1.0;
    }
    ControlPosition between(const ControlPosition& a, const ControlPosition& b, double s) const {
        ControlPosition out;
        for (const std::size_t i : index_)
            out.value[i] = a.value[i] + s * (b.value[i] - a.value[i]);
        return out;
    }
    ControlPosition apart(const ControlPosition& log, const ControlPosition& control) const {
        ControlPosition out;
        for (const std::size_t i : index_) out.value[i] = log.value[i] - control.value[i];
        return out;
    }

  private:
    Indices index_;
};

/// The evaluated part of a table of m by n cells, and the step into each cell.
class Band {
  public:
    /// `log_way`, `path_way`: position of each row and node along its path, as fractions of the
    /// total.
    Band(const std::vector<double>& log_way, const std::vector<double>& path_way) {
        const std::size_t m = log_way.size(), n = path_way.size();
        const std::size_t half =
            m * n <= most_cells ? n : std::max(least_half_band, most_cells / m);
        low_.assign(m + 1, 0);
        high_.assign(m + 1, std::min(n, half));
        std::size_t centre = 0;
        for (std::size_t i = 1; i <= m; ++i) {
            while (centre < n && path_way[centre] < log_way[i - 1]) ++centre;
            low_[i] = std::min(centre > half ? centre - half : 0, high_[i - 1]);
            high_[i] = i == m ? n : std::max(high_[i - 1], std::min(n, centre + half));
        }
        offset_.assign(m + 1, 0);
        for (std::size_t i = 1; i <= m; ++i)
            offset_[i] = offset_[i - 1] + high_[i - 1] - low_[i - 1] + 1;
        step_.assign(offset_[m] + high_[m] - low_[m] + 1, 0);
    }
    std::size_t low(std::size_t i) const { return low_[i]; }
    std::size_t high(std::size_t i) const { return high_[i]; }
    std::uint8_t& step(std::size_t i, std::size_t j) { return step_[offset_[i] + (j - low_[i])]; }

  private:
    Indices low_, high_, offset_;
    std::vector<std::uint8_t> step_;
};

enum Step : std::uint8_t { none, both, row, node };

class Pairer {
  public:
    Pairer(const LogView& log, const ControlPath& path) : log_(log), path_(path), space_(log.axes) {
        row_node_.assign(log.rows.size(), missing);
        node_row_.assign(path.nodes.size(), missing);
    }

    std::vector<Pair> pair() {
        group();
        for (std::size_t g = 0; g < rows_.size(); ++g) {
            if (rows_[g].empty() || nodes_[g].empty()) continue;
            log_.ends ? warp_ends(rows_[g], nodes_[g]) : warp_samples(rows_[g], nodes_[g]);
        }
        add_lonely_rows();
        add_lonely_nodes();
        return std::move(pairs_);
    }

  private:
    static constexpr std::size_t missing = std::numeric_limits<std::size_t>::max();

    void group() {
        const std::size_t groups = log_.keys == 0 ? 1 : static_cast<std::size_t>(log_.keys);
        rows_.resize(groups);
        nodes_.resize(groups);
        std::vector<int> key_of_block;
        for (const PathBlock& block : path_.blocks)
            key_of_block.push_back(log_.keys == 0 ? 0 : log_.key_of(block));
        for (std::size_t i = 0; i < log_.rows.size(); ++i)
            if (const int key = log_.keys == 0 ? 0 : log_.rows[i].key; key >= 0)
                rows_[static_cast<std::size_t>(key)].push_back(i);
        for (std::size_t k = 1; k < path_.nodes.size(); ++k)
            if (const int key = key_of_block[path_.nodes[k].block]; key >= 0)
                nodes_[static_cast<std::size_t>(key)].push_back(k);
    }

    const ControlPosition& row_at(std::size_t i) const { return log_.rows[i].at; }
    const ControlPosition& node_at(std::size_t k) const { return path_.nodes[k].at; }

    /// Path length from the first of `list` to each, as a fraction of the total.
    template <class At>
    static std::vector<double> ways(const Indices& list, const Space& space, At at) {
        std::vector<double> way(list.size(), 0.0);
        for (std::size_t k = 1; k < list.size(); ++k)
            way[k] = way[k - 1] + std::sqrt(space.square(at(list[k]), at(list[k - 1])));
        for (double& w : way) w /= std::max(way.back(), 1e-12);
        return way;
    }
    Band band_of(const Indices& rows, const Indices& nodes) const {
        return {ways(
                    rows, space_, [this](std::size_t i) -> auto& { return row_at(i); }),
                ways(
                    nodes, space_, [this](std::size_t k) -> auto& { return node_at(k); })};
    }
    /// The last row of the log may be anywhere, because the following ones are unknown.
    bool ends_open(const Indices& rows) const { return rows.back() + 1 == log_.rows.size(); }

    void add(std::size_t row, std::size_t node, double fraction, const ControlPosition& apart,
             bool slides) {
        pairs_.push_back({row, static_cast<std::uint32_t>(node), fraction, apart, slides});
        if (row_node_[row] == missing || row_node_[row] < node) row_node_[row] = node;
        if (node_row_[node] == missing || node_row_[node] < row) node_row_[node] = row;
    }
    void add_end(std::size_t row, std::size_t node) {
        add(row, node, 1.0, space_.apart(row_at(row), node_at(node)), false);
    }

    void warp_ends(const Indices& rows, const Indices& nodes) {
        Band band = band_of(rows, nodes);
        std::vector<double> before(nodes.size() + 1, infinite), now;
        before[0] = 0.0;
        for (std::size_t i = 1; i <= rows.size(); ++i) {
            now.assign(nodes.size() + 1, infinite);
            for (std::size_t j = std::max<std::size_t>(1, band.low(i)); j <= band.high(i); ++j) {
                const double least = std::min({before[j - 1], before[j], now[j - 1]});
                now[j] = least + space_.square(row_at(rows[i - 1]), node_at(nodes[j - 1]));
                band.step(i, j) = before[j - 1] == least ? both : before[j] == least ? row : node;
            }
            std::swap(before, now);
        }
        std::size_t i = rows.size(), j = last_cell(before, ends_open(rows));
        while (i > 0 && j > 0) {
            add_end(rows[i - 1], nodes[j - 1]);
            const std::uint8_t step = band.step(i, j);
            if (step != node) --i;
            if (step != row) --j;
        }
    }

    static std::size_t last_cell(const std::vector<double>& costs, bool open) {
        if (!open) return costs.size() - 1;
        const auto least = std::min_element(costs.begin() + 1, costs.end());
        return static_cast<std::size_t>(least - costs.begin());
    }

    /// Distance of the samples around row i.
    double spacing(std::size_t i) const {
        double most = log_.spacing * log_.spacing;
        const std::size_t last = std::min(log_.rows.size() - 1, i + spacing_rows);
        for (std::size_t k = i > spacing_rows ? i - spacing_rows : 0; k < last; ++k)
            most = std::max(most, space_.square(row_at(k), row_at(k + 1)));
        return std::sqrt(most);
    }
    /// Distance between a node and the chord from row i on, minus the distance of samples.
    ControlPosition missed(std::size_t i, std::size_t k) const {
        const ControlPosition& from = row_at(i);
        const ControlPosition& to = row_at(std::min(i + 1, log_.rows.size() - 1));
        const double s = space_.nearest(from, to, node_at(k));
        ControlPosition apart = space_.apart(space_.between(from, to, s), node_at(k));
        const double size = std::sqrt(space_.square(apart, {}));
        if (log_.marked && path_.nodes[k].end) return apart;
        const double kept = size > 0.0 ? std::max(0.0, 1.0 - spacing(i) / size) : 0.0;
        for (double& value : apart.value) value *= kept;
        return apart;
    }
    /// The row whose chord is active when i rows are placed.
    static std::size_t placed(const Indices& rows, std::size_t i) {
        return i > 0 ? rows[i - 1] : rows[0] - std::min<std::size_t>(rows[0], 1);
    }
    double missed_square(const Indices& rows, std::size_t i, std::size_t k) const {
        return space_.square(missed(placed(rows, i), k), {});
    }
    double on_segment(std::size_t i, std::size_t k) const {
        return log_.rows[i].end ? 1.0 : space_.nearest(node_at(k - 1), node_at(k), row_at(i));
    }
    double segment_square(std::size_t i, std::size_t k) const {
        return space_.square(space_.between(node_at(k - 1), node_at(k), on_segment(i, k)),
                             row_at(i));
    }

    /// Cell (i, j): i rows are placed, the last ones on the segment to node j + 1 or before.
    void warp_samples(const Indices& rows, const Indices& nodes) {
        Band band = band_of(rows, nodes);
        const std::size_t n = nodes.size();
        std::vector<double> before(n, infinite), now;
        for (std::size_t i = 0; i <= rows.size(); ++i) {
            now.assign(n, infinite);
            if (i == 0) now[0] = 0.0;
            for (std::size_t j = band.low(i); j < std::min(n, band.high(i) + 1); ++j) {
                if (i > 0 && before[j] < infinite) {
                    now[j] = before[j] + segment_square(rows[i - 1], nodes[j]);
                    band.step(i, j) = row;
                }
                if (j == 0 || now[j - 1] == infinite) continue;
                const double passed = now[j - 1] + missed_square(rows, i, nodes[j - 1]);
                if (passed >= now[j]) continue;
                now[j] = passed;
                band.step(i, j) = node;
            }
            std::swap(before, now);
        }
        follow_samples(rows, nodes, band, before);
    }
    void follow_samples(const Indices& rows, const Indices& nodes, Band& band,
                        std::vector<double>& costs) {
        const bool open = ends_open(rows);
        std::size_t i = rows.size(), j = costs.size() - 1;
        if (open)
            j = static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) -
                                         costs.begin());
        if (!open) add_missed(rows.back(), nodes.back());
        while (i > 0) {
            if (band.step(i, j) == node) {
                --j;
                add_missed(rows[i - 1], nodes[j]);
            } else {
                add_sample(rows[i - 1], nodes[j]);
                --i;
            }
        }
        while (j > 0) add_missed(placed(rows, 0), nodes[--j]);
    }
    void add_sample(std::size_t i, std::size_t k) {
        const double s = on_segment(i, k);
        add(i, k, s, space_.apart(row_at(i), space_.between(node_at(k - 1), node_at(k), s)),
            s > 0.0 && s < 1.0);
    }
    void add_missed(std::size_t i, std::size_t k) {
        const ControlPosition apart = missed(i, k);
        if (space_.square(apart, {}) > 0.0) add(i, k, 1.0, apart, false);
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
        std::vector<bool> has_rows(path_.blocks.size(), log_.keys == 0);
        for (std::size_t b = 1; b < path_.blocks.size() && log_.keys > 0; ++b) {
            const int key = log_.key_of(path_.blocks[b]);
            has_rows[b] = key >= 0 && !rows_[static_cast<std::size_t>(key)].empty();
        }
        std::size_t row = 0;
        for (std::size_t k = 1; k < last; ++k) {
            if (node_row_[k] != missing) {
                row = node_row_[k];
            } else if (!has_rows[path_.nodes[k].block]) {
                log_.ends ? add_end(row, k) : add_missed(row, k);
            }
        }
    }

    const LogView& log_;
    const ControlPath& path_;
    Space space_;
    std::vector<Indices> rows_, nodes_;  ///< by key
    Indices row_node_, node_row_;
    std::vector<Pair> pairs_;
};

}  // namespace

std::vector<Pair> pair_up(const LogView& log, const ControlPath& path) {
    return Pairer(log, path).pair();
}

std::vector<double> row_losses(const LogView& log, const std::vector<Pair>& pairs) {
    std::vector<double> loss(log.rows.size(), 0.0);
    for (const Pair& pair : pairs) {
        const double weight = log.rows[pair.row].weight;
        for (const Axis axis : log.axes)
            loss[pair.row] += weight * weight * pair.apart[axis] * pair.apart[axis];
    }
    return loss;
}

}  // namespace trunnion::choices
