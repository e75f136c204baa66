#include "regression/align.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <unordered_map>

namespace trunnion::regression {

namespace {

// Ids ------------------------------------------------------------------------------------------

bool close(const std::array<double, 3>& p, const std::array<double, 3>& q, double tolerance) {
    return std::abs(p[0] - q[0]) <= tolerance && std::abs(p[1] - q[1]) <= tolerance &&
           std::abs(p[2] - q[2]) <= tolerance;
}

/// Gives out ids, found again by the cells of a grid that the centroid may lie in.
class PassIds {
  public:
    explicit PassIds(const Tolerances& tolerances)
        : tolerances_(tolerances), cell_mm_(64.0 * tolerances.position_mm) {}

    std::uint32_t id_of(const Pass& pass) {
        for (int corner = 0; corner < 8; ++corner) {
            const auto range = by_cell_.equal_range(cell(pass, corner));
            int looked = 0;
            for (auto k = range.first; k != range.second && looked < 64; ++k, ++looked)
                if (alike(*known_[k->second], pass, tolerances_)) return k->second;
        }
        const auto id = static_cast<std::uint32_t>(known_.size());
        known_.push_back(&pass);
        by_cell_.emplace(cell(pass, -1), id);
        return id;
    }

  private:
    std::uint64_t cell(const Pass& pass, int corner) const {
        std::uint64_t h = pass.tool + 1;
        if (!pass.cuts()) return ~h;
        const auto mix = [&h](std::int64_t n) {
            h = (h ^ static_cast<std::uint64_t>(n)) * 0xBF58476D1CE4E5B9ULL;
            h ^= h >> 29;
        };
        for (std::size_t d = 0; d < 3; ++d) {
            const double shift = corner < 0 ? 0.0 : ((corner >> d) & 1 ? 0.05 : -0.05);
            mix(static_cast<std::int64_t>(std::floor(pass.centroid_mm[d] / cell_mm_ + shift)));
        }
        return h;
    }

    Tolerances tolerances_;
    double cell_mm_;
    std::vector<const Pass*> known_;
    std::unordered_multimap<std::uint64_t, std::uint32_t> by_cell_;
};

// Sequences ------------------------------------------------------------------------------------

/// Myers' greedy walk with the whole trace kept; empty when more than `most_edits` are needed.
class MyersWalk {
  public:
    MyersWalk(const Keys& a, const Keys& b, IndexPair from, IndexPair to)
        : a_(a),
          b_(b),
          from_(from),
          n_(static_cast<long>(to.a - from.a)),
          m_(static_cast<long>(to.b - from.b)) {}

    bool run(std::size_t most_edits) {
        const long most = std::min<long>(static_cast<long>(most_edits), n_ + m_);
        std::vector<long> best(static_cast<std::size_t>(2 * most + 3), 0);
        const auto at = [&](long k) -> long& {
            return best[static_cast<std::size_t>(k + most + 1)];
        };
        for (long d = 0; d <= most; ++d) {
            for (long k = -d; k <= d; k += 2) {
                long x = k == -d || (k != d && at(k - 1) < at(k + 1)) ? at(k + 1) : at(k - 1) + 1;
                while (x < n_ && x - k < m_ && x - k >= 0 && same(x, x - k)) ++x;
                at(k) = x;
                if (x >= n_ && x - k >= m_) {
                    keep(best, d, most);
                    return true;
                }
            }
            keep(best, d, most);
        }
        return false;
    }

    void collect(std::vector<IndexPair>& pairs) const {
        std::vector<IndexPair> back;
        long x = n_, y = m_;
        for (long d = static_cast<long>(trace_.size()) - 1; d > 0; --d) {
            const std::vector<std::int32_t>& before = trace_[static_cast<std::size_t>(d - 1)];
            const auto at = [&](long k) {
                return std::abs(k) > d - 1 ? -1L
                                           : long{before[static_cast<std::size_t>(k + d - 1)]};
            };
            const long k = x - y;
            const bool down = k == -d || (k != d && at(k - 1) < at(k + 1));
            const long x0 = down ? at(k + 1) : at(k - 1);
            const long y0 = x0 - (down ? k + 1 : k - 1);
            const long x_start = down ? x0 : x0 + 1;
            for (; x > x_start; --x, --y) back.push_back(pair(x - 1, y - 1));
            x = x0;
            y = y0;
        }
        for (; x > 0 && y > 0; --x, --y) back.push_back(pair(x - 1, y - 1));
        pairs.insert(pairs.end(), back.rbegin(), back.rend());
    }

  private:
    bool same(long x, long y) const {
        return a_[from_.a + static_cast<std::size_t>(x)] ==
               b_[from_.b + static_cast<std::size_t>(y)];
    }
    IndexPair pair(long x, long y) const {
        return {from_.a + static_cast<std::size_t>(x), from_.b + static_cast<std::size_t>(y)};
    }
    void keep(const std::vector<long>& best, long d, long most) {
        trace_.emplace_back(best.begin() + (most + 1 - d), best.begin() + (most + 2 + d));
    }

    const Keys &a_, &b_;
    IndexPair from_;
    long n_, m_;
    std::vector<std::vector<std::int32_t>> trace_;  ///< [d]: furthest x of the diagonals -d..d
};

/// The n-th occurrence of an id on one side goes with the n-th on the other.
std::vector<IndexPair> nth_with_nth(const Keys& a, IndexPair from, const Keys& b, IndexPair to) {
    std::unordered_map<std::uint64_t, std::deque<std::size_t>> places;
    for (std::size_t j = from.b; j < to.b; ++j) places[b[j]].push_back(j);
    std::vector<IndexPair> pairs;
    for (std::size_t i = from.a; i < to.a; ++i) {
        const auto found = places.find(a[i]);
        if (found == places.end() || found->second.empty()) continue;
        pairs.push_back({i, found->second.front()});
        found->second.pop_front();
    }
    return pairs;
}

/// The longest part of `pairs` (rising in a) that rises in b too.
std::vector<IndexPair> longest_rising(const std::vector<IndexPair>& pairs) {
    std::vector<std::size_t> tails, before(pairs.size(), pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto place = std::lower_bound(
            tails.begin(), tails.end(), pairs[k].b,
            [&](std::size_t tail, std::size_t value) { return pairs[tail].b < value; });
        if (place != tails.begin()) before[k] = *(place - 1);
        if (place == tails.end())
            tails.push_back(k);
        else
            *place = k;
    }
    std::vector<IndexPair> rising;
    for (std::size_t k = tails.empty() ? pairs.size() : tails.back(); k < pairs.size();
         k = before[k])
        rising.push_back(pairs[k]);
    std::reverse(rising.begin(), rising.end());
    return rising;
}

}  // namespace

bool alike(const Pass& p, const Pass& q, const Tolerances& t) {
    // Without a cut it is the way to the end or to another tool: alike wherever it begins.
    if (!p.cuts() || !q.cuts()) return p.tool == q.tool && p.cuts() == q.cuts();
    const double place = 2.0 * t.position_mm;
    return p.tool == q.tool && close(p.centroid_mm, q.centroid_mm, place) &&
           close(p.start_mm, q.start_mm, place) && close(p.end_mm, q.end_mm, place) &&
           std::abs(p.cut_mm - q.cut_mm) <= 1e-3 * p.cut_mm + 4.0 * t.position_mm;
}

void identify_passes(const std::vector<Pass>& a, const std::vector<Pass>& b,
                     const Tolerances& tolerances, Keys& ids_a, Keys& ids_b) {
    PassIds ids(tolerances);
    ids_a.clear();
    ids_b.clear();
    for (const Pass& pass : a) ids_a.push_back(ids.id_of(pass));
    for (const Pass& pass : b) ids_b.push_back(ids.id_of(pass));
}

std::vector<IndexPair> match_sequences(const Keys& a, const Keys& b, std::size_t most_edits) {
    IndexPair from, to{a.size(), b.size()};
    std::vector<IndexPair> pairs;
    while (from.a < to.a && from.b < to.b && a[from.a] == b[from.b])
        pairs.push_back({from.a++, from.b++});
    std::vector<IndexPair> tail;
    while (from.a < to.a && from.b < to.b && a[to.a - 1] == b[to.b - 1])
        tail.push_back({--to.a, --to.b});
    if (from.a < to.a && from.b < to.b) {
        MyersWalk walk(a, b, from, to);
        if (walk.run(most_edits)) {
            walk.collect(pairs);
        } else {
            const auto rising = longest_rising(nth_with_nth(a, from, b, to));
            pairs.insert(pairs.end(), rising.begin(), rising.end());
        }
    }
    pairs.insert(pairs.end(), tail.rbegin(), tail.rend());
    return pairs;
}

}  // namespace trunnion::regression
