#include "choices/row_keys.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <optional>

#include "choices/band.h"
#include "choices/space.h"

namespace trunnion::choices {

namespace {

constexpr std::size_t most_distances = 2'000'000;  ///< of one run of rows without a number
constexpr double noise_squares = 36.0;             ///< of a way back, in squares of sigma

/// Successive nodes of one block.
struct Visit {
    int key;
    std::size_t first, last;
};
using Visits = std::vector<Visit>;

/// Fills in the rows without a number, in the order of the path.
class KeyFiller {
  public:
    KeyFiller(const LogView& log, const ControlPath& path, RowKeys& keys)
        : log_(log), path_(path), keys_(keys), space_(log.axes) {
        for (std::size_t k = 1; k < path.nodes.size(); ++k) {
            const int key = keys.of_block[path.nodes[k].block];
            if (visits_.empty() || visits_.back().key != key) {
                places_[key].push_back(visits_.size());
                visits_.push_back({key, k, k});
            }
            visits_.back().last = k;
        }
    }
    void fill() {
        std::vector<int>& keys = keys_.of_row;
        for (std::size_t i = 0; i < keys.size();) {
            if (keys[i] >= 0) {
                advance(keys[i++]);
                continue;
            }
            std::size_t end = i;
            while (end < keys.size() && keys[end] < 0) ++end;
            fill(i, end);
            i = end;
        }
    }

  private:
    void advance(int key) {
        if (at_ && visits_[*at_].key == key) return;
        if (const auto next = next_visit(key)) at_ = next;
    }
    /// The next visit of a block, from the present one on.
    std::optional<std::size_t> next_visit(int key) const {
        const auto places = places_.find(key);
        if (places == places_.end()) return std::nullopt;
        const auto next =
            std::lower_bound(places->second.begin(), places->second.end(), at_.value_or(0));
        return next == places->second.end() ? std::nullopt : std::optional(*next);
    }
    void fill(std::size_t from, std::size_t to) {
        end_if_asked(0);
        std::vector<int>& keys = keys_.of_row;
        const int before = from > 0 ? keys[from - 1] : -1, after = to < keys.size() ? keys[to] : -1;
        if (before >= 0 && before == after) {
            std::fill(keys.begin() + static_cast<std::ptrdiff_t>(from),
                      keys.begin() + static_cast<std::ptrdiff_t>(to), before);
            return;
        }
        const Visits list = between(after, to - from, to < keys.size());
        if (!list.empty()) divide(from, to, list);
    }
    /// Visits from the present one to the next of `after`, or to the end of the path.
    Visits between(int after, std::size_t rows, bool ends) const {
        const std::size_t first = at_.value_or(0);
        std::size_t last = visits_.size() - 1;
        if (ends) {
            const auto next = next_visit(after);
            if (!next) return at_ ? Visits{visits_[first]} : Visits{};
            last = *next;
        }
        Visits out(visits_.begin() + static_cast<std::ptrdiff_t>(first),
                   visits_.begin() + static_cast<std::ptrdiff_t>(last) + 1);
        const std::size_t nodes = out.back().last - out.front().first + 1;
        if (nodes * rows <= most_distances) return out;
        // Too far apart to look at everything: one of the two ends.
        if (!at_) return {out.back()};
        return ends ? Visits{out.front(), out.back()} : Visits{out.front()};
    }
    /// Of the distance, and of the way back: where the axes turn, both blocks are as near.
    double square(std::size_t i, const Visit& visit) const {
        double least = std::numeric_limits<double>::infinity();
        const offsets::ControlPosition& row = log_.rows[i].at;
        for (std::size_t k = visit.first; k <= visit.last; ++k) {
            const auto &a = path_.nodes[k - 1].at, &b = path_.nodes[k].at;
            const double s = log_.ends ? 1.0 : space_.nearest(a, b, row);
            double sum = space_.square(space_.between(a, b, s), row);
            if (!log_.ends && i > 0) sum += square_back(i, a, b);
            least = std::min(least, sum);
        }
        return least;
    }
    /// Of the way from the row before against the direction of a segment; none within noise.
    double square_back(std::size_t i, const offsets::ControlPosition& a,
                       const offsets::ControlPosition& b) const {
        const auto move = space_.apart(log_.rows[i].at, log_.rows[i - 1].at),
                   way = space_.apart(b, a);
        double along = 0.0;
        for (const Axis axis : log_.axes) along += move[axis] * way[axis];
        const double length = space_.square(way, {}), weight = log_.rows[i].weight;
        if (along >= 0.0 || length <= 0.0) return 0.0;
        const double back = along * along / length;
        return back * weight * weight > noise_squares ? back : 0.0;
    }
    /// Least sum of squares, in order; a visit may have no row.
    void divide(std::size_t from, std::size_t to, const Visits& list) {
        const std::size_t n = list.size();
        std::vector<double> cost(n, 0.0);
        std::vector<std::vector<std::size_t>> came;
        for (std::size_t i = from; i < to; ++i) {
            std::vector<std::size_t> best(n);
            double least = std::numeric_limits<double>::infinity();
            std::size_t at = 0;
            for (std::size_t v = 0; v < n; ++v) {
                if (cost[v] < least) {
                    least = cost[v];
                    at = v;
                }
                best[v] = at;
                cost[v] = least + square(i, list[v]);
            }
            came.push_back(std::move(best));
        }
        auto v =
            static_cast<std::size_t>(std::min_element(cost.begin(), cost.end()) - cost.begin());
        for (std::size_t i = to; i > from; --i) {
            keys_.of_row[i - 1] = list[v].key;
            v = came[i - 1 - from][v];
        }
    }

    const LogView& log_;
    const ControlPath& path_;
    RowKeys& keys_;
    Space space_;
    Visits visits_;
    std::map<int, Indices> places_;  ///< visits of each block
    std::optional<std::size_t> at_;  ///< visit of the row before
};

/// Successive elements with one key.
Visits runs_of(const std::vector<int>& keys, std::size_t from) {
    Visits out;
    for (std::size_t k = from; k < keys.size(); ++k) {
        if (out.empty() || out.back().key != keys[k]) out.push_back({keys[k], k, k});
        out.back().last = k;
    }
    return out;
}

/// The runs of a log's rows in the order of the path's visits.
class Order {
  public:
    Order(const LogView& log, const ControlPath& path, const RowKeys& keys)
        : rows_(log.rows.size()),
          nodes_(path.nodes.size()),
          runs_(runs_of(keys.of_row, 0)),
          visits_(runs_of(keys.of_node, 1)) {
        std::erase_if(runs_, [](const Visit& run) { return run.key < 0; });
        for (std::size_t v = 0; v < visits_.size(); ++v) places_[visits_[v].key].push_back(v);
    }
    /// Of some block that runs several times, the rows show another number of times.
    bool is_doubtful() const {
        std::map<int, std::size_t> shown;
        for (const Visit& run : runs_) ++shown[run.key];
        return std::any_of(shown.begin(), shown.end(), [&](const auto& one) {
            const auto at = places_.find(one.first);
            return at != places_.end() && at->second.size() > 1 && at->second.size() != one.second;
        });
    }
    std::optional<RowKeys> earliest() const {
        Indices of_run;
        for (const Visit& run : runs_) {
            const auto at = places_.find(run.key);
            if (at == places_.end()) return std::nullopt;
            const auto next = std::lower_bound(at->second.begin(), at->second.end(),
                                               of_run.empty() ? 0 : of_run.back() + 1);
            if (next == at->second.end()) return std::nullopt;
            of_run.push_back(*next);
        }
        RowKeys out = keys();
        for (std::size_t r = 0; r < runs_.size(); ++r)
            give(r, of_run[r], r + 1 < runs_.size() ? of_run[r + 1] : visits_.size(), out);
        return out;
    }
    std::optional<RowKeys> latest() const {
        Indices of_run(runs_.size());
        std::size_t end = visits_.size();
        for (std::size_t r = runs_.size(); r-- > 0;) {
            const auto at = places_.find(runs_[r].key);
            if (at == places_.end()) return std::nullopt;
            const auto next = std::lower_bound(at->second.begin(), at->second.end(), end);
            if (next == at->second.begin()) return std::nullopt;
            of_run[r] = end = *std::prev(next);
        }
        RowKeys out = keys();
        for (std::size_t r = 0; r < runs_.size(); ++r)
            give(r, r > 0 ? of_run[r - 1] + 1 : 0, of_run[r] + 1, out);
        return out;
    }

  private:
    RowKeys keys() const {
        return {std::vector<int>(rows_, -1),
                {},
                std::vector<int>(nodes_, -1),
                static_cast<int>(runs_.size())};
    }
    /// A run and the visits of its block between two visits.
    void give(std::size_t r, std::size_t from, std::size_t to, RowKeys& out) const {
        const auto key = static_cast<int>(r);
        for (std::size_t i = runs_[r].first; i <= runs_[r].last; ++i) out.of_row[i] = key;
        for (std::size_t v = from; v < to; ++v)
            if (visits_[v].key == runs_[r].key)
                for (std::size_t k = visits_[v].first; k <= visits_[v].last; ++k)
                    out.of_node[k] = key;
    }

    std::size_t rows_, nodes_;
    Visits runs_, visits_;
    std::map<int, Indices> places_;  ///< visits of each block
};

void set_nodes(const ControlPath& path, RowKeys& keys) {
    for (const PathNode& node : path.nodes) keys.of_node.push_back(keys.of_block[node.block]);
}

}  // namespace

RowKeys keys_of(const LogView& log, const ControlPath& path) {
    RowKeys out;
    if (log.keys == 0)
        return {std::vector<int>(log.rows.size(), 0), std::vector<int>(path.blocks.size(), 0),
                std::vector<int>(path.nodes.size(), 0), 1};
    out.count = log.keys;
    for (const PathBlock& block : path.blocks) out.of_block.push_back(log.key_of(block));
    for (const LogView::Row& row : log.rows) out.of_row.push_back(row.key);
    const bool all =
        std::none_of(out.of_row.begin(), out.of_row.end(), [](int key) { return key < 0; });
    if (!all && path.nodes.size() >= 2) {
        // Blocks that the log does not name may be those of its rows without a number.
        for (std::size_t b = 1; b < path.blocks.size(); ++b)
            if (out.of_block[b] < 0) out.of_block[b] = out.count++;
        KeyFiller(log, path, out).fill();
    }
    set_nodes(path, out);
    return out;
}

std::vector<RowKeys> keys_by_order(const LogView& log, const ControlPath& path,
                                   const RowKeys& keys) {
    if (log.keys == 0 || log.begins_within) return {};
    const Order order(log, path, keys);
    if (!order.is_doubtful()) return {};
    std::vector<RowKeys> out;
    for (auto& found : {order.earliest(), order.latest()})
        if (found && (out.empty() || found->of_node != out.front().of_node)) out.push_back(*found);
    return out;
}

}  // namespace trunnion::choices
