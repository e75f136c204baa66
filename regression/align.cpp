#include "regression/align.h"

#include <algorithm>
#include <cmath>

namespace trunnion::regression {

namespace {

bool close(const std::array<double, 3>& p, const std::array<double, 3>& q, double tolerance) {
    return std::abs(p[0] - q[0]) <= tolerance && std::abs(p[1] - q[1]) <= tolerance &&
           std::abs(p[2] - q[2]) <= tolerance;
}

// Sequences ------------------------------------------------------------------------------------

/// Greedy algorithm of Myers with its whole trace kept; empty when more than `most_edits` are
/// needed.
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
                while (x < n_ && x - k < m_ && same(x, x - k)) ++x;
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
                return long{before[static_cast<std::size_t>(k + d - 1)]};
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
    std::vector<std::vector<std::int32_t>> trace_;  ///< [d]: furthest x on the diagonals -d..d
};

/// The longest subsequence of `pairs` (rising in a) that also rises in b.
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

namespace {

/// For two passes, or for the stored data of one.
template <typename P, typename Q>
bool alike_shapes(const P& p, const Q& q, const Tolerances& t) {
    const double place = 2.0 * t.position_mm;
    return p.tool == q.tool && close(p.centroid_mm, q.centroid_mm, place) &&
           close(p.start_mm, q.start_mm, place) && close(p.end_mm, q.end_mm, place) &&
           std::abs(p.cut_mm - q.cut_mm) <= 1e-3 * p.cut_mm + 4.0 * t.position_mm;
}

}  // namespace

bool alike(const Pass& p, const Pass& q, const Tolerances& t) {
    // Without a cut it is the path to the end or to another tool: alike wherever it begins.
    if (!p.cuts() || !q.cuts()) return p.tool == q.tool && p.cuts() == q.cuts();
    return alike_shapes(p, q, t);
}

bool PassIds::alike_look(const Look& p, const Pass& q) const {
    if (!p.cuts || !q.cuts()) return p.tool == q.tool && p.cuts == q.cuts();
    return alike_shapes(p, q, tolerances_);
}

PassIds::PassIds(const Tolerances& tolerances)
    : tolerances_(tolerances), cell_mm_(64.0 * tolerances.position_mm) {}

/// Found by the grid cells that may contain the centroid.
std::uint32_t PassIds::id_of(const Pass& pass) {
    for (int corner = 0; corner < 8; ++corner) {
        const auto range = by_cell_.equal_range(cell(pass, corner));
        int looked = 0;
        for (auto k = range.first; k != range.second && looked < 64; ++k, ++looked)
            if (alike_look(known_[k->second], pass)) return k->second;
    }
    const auto id = static_cast<std::uint32_t>(known_.size());
    known_.push_back(
        {pass.start_mm, pass.end_mm, pass.centroid_mm, pass.cut_mm, pass.tool, pass.cuts()});
    by_cell_.emplace(cell(pass, -1), id);
    return id;
}

/// corner -1: the centroid's own cell; 0 to 7: that of a slightly shifted point.
std::uint64_t PassIds::cell(const Pass& pass, int corner) const {
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

std::vector<IndexPair> nth_with_nth(const Keys& a, IndexPair from, const Keys& b, IndexPair to) {
    using Places = std::vector<std::pair<std::uint64_t, std::size_t>>;
    const auto sorted = [](const Keys& keys, std::size_t first, std::size_t last) {
        Places places;
        places.reserve(last - first);
        for (std::size_t k = first; k < last; ++k) places.emplace_back(keys[k], k);
        std::sort(places.begin(), places.end());
        return places;
    };
    const Places in_a = sorted(a, from.a, to.a), in_b = sorted(b, from.b, to.b);
    std::vector<IndexPair> pairs;
    for (std::size_t i = 0, j = 0; i < in_a.size() && j < in_b.size();) {
        if (in_a[i].first == in_b[j].first)
            pairs.push_back({in_a[i++].second, in_b[j++].second});
        else
            ++(in_a[i].first < in_b[j].first ? i : j);
    }
    std::sort(pairs.begin(), pairs.end(),
              [](const IndexPair& p, const IndexPair& q) { return p.a < q.a; });
    return pairs;
}

std::vector<IndexPair> match_sequences(const Keys& a, const Keys& b, std::size_t most_edits) {
    const IndexPair from;
    IndexPair to{a.size(), b.size()};
    std::vector<IndexPair> pairs;
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
