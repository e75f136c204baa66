// Alignment of two long sequences: window by window, then the unmatched items of both sides.
#include <algorithm>

#include "regression/align.h"

namespace trunnion::regression {

namespace {

/// Pairs items in the same order; the items between two pairs are one gap.
class WindowedAligner {
  public:
    WindowedAligner(const AlignSource& source, const AlignLimits& limits,
                    const std::function<void(const PassPair&)>& found)
        : source_(source), limits_(limits), found_(found) {}

    void run() {
        while (i_ < source_.size_a && j_ < source_.size_b)
            if (source_.alike(i_, j_))
                same();
            else if (!window())
                break;
        gap_to(source_.size_a, source_.size_b);
    }

  private:
    void same() {
        found_({Pairing::same, {i_, i_ + 1}, {j_, j_ + 1}});
        ++i_, ++j_;
    }

    /// Aligns the next window up to a reliable corner; false: no match in it.
    bool window() {
        for (std::uint64_t size = limits_.window;; size *= 4) {
            size = std::min(size, limits_.most_window);
            const PassRange a{i_, std::min(source_.size_a, i_ + size)};
            const PassRange b{j_, std::min(source_.size_b, j_ + size)};
            const bool whole = a.last == source_.size_a && b.last == source_.size_b;
            source_.keys({a}, {b}, keys_a_, keys_b_);
            const std::vector<IndexPair> pairs =
                match_sequences(keys_a_, keys_b_, limits_.most_edits);
            IndexPair end{keys_a_.size(), keys_b_.size()};
            if (!whole) {
                end = sure_corner(pairs, size, size == limits_.most_window);
                if (end.a == 0 && size < limits_.most_window) continue;
                if (end.a == 0) return false;
            }
            report(a.first, b.first, pairs, end);
            return true;
        }
    }

    /// The position after the last match in the first three quarters: later items may match beyond
    /// the window.
    static IndexPair sure_corner(const std::vector<IndexPair>& pairs, std::uint64_t size,
                                 bool any) {
        IndexPair end;
        for (const IndexPair& p : pairs)
            if (4 * p.a < 3 * size && 4 * p.b < 3 * size) end = {p.a + 1, p.b + 1};
        if (end.a == 0 && any && !pairs.empty()) end = {pairs.back().a + 1, pairs.back().b + 1};
        return end;
    }

    void report(std::uint64_t from_a, std::uint64_t from_b, const std::vector<IndexPair>& pairs,
                IndexPair end) {
        for (const IndexPair& p : pairs) {
            if (p.a >= end.a) break;
            gap_to(from_a + p.a, from_b + p.b);
            same();
        }
        gap_to(from_a + end.a, from_b + end.b);
    }

    void gap_to(std::uint64_t a, std::uint64_t b) {
        PassPair gap{Pairing::changed, {i_, a}, {j_, b}};
        if (gap.a.size() == 0) gap.pairing = Pairing::only_b;
        if (gap.b.size() == 0) gap.pairing = Pairing::only_a;
        if (gap.a.size() + gap.b.size() > 0) found_(gap);
        i_ = a;
        j_ = b;
    }

    const AlignSource& source_;
    AlignLimits limits_;
    const std::function<void(const PassPair&)>& found_;
    std::uint64_t i_ = 0, j_ = 0;
    Keys keys_a_, keys_b_;
};

/// Items of all gaps that are alike on both sides, i.e. moved to another place.
class MovedItems {
  public:
    MovedItems(const AlignSource& source, const std::vector<PassPair>& pairs) {
        for (const PassPair& pair : pairs) {
            if (pair.pairing == Pairing::same) continue;
            if (pair.a.size() > 0) gaps_a_.push_back(pair.a);
            if (pair.b.size() > 0) gaps_b_.push_back(pair.b);
        }
        if (gaps_a_.empty() || gaps_b_.empty()) return;
        Keys keys_a, keys_b;
        source.keys(gaps_a_, gaps_b_, keys_a, keys_b);
        items_a_ = items(gaps_a_);
        items_b_ = items(gaps_b_);
        for (const IndexPair& p :
             nth_with_nth(keys_a, {}, keys_b, {keys_a.size(), keys_b.size()})) {
            to_b_.push_back({items_a_[p.a], items_b_[p.b]});
            taken_b_.push_back(items_b_[p.b]);
        }
        std::sort(taken_b_.begin(), taken_b_.end());
    }
    bool empty() const { return to_b_.empty(); }

    /// Splits a gap into its moved items (runs are combined) and the rest of both sides.
    template <typename Emit>
    void split(const PassPair& gap, const Emit& emit) const {
        std::uint64_t i = gap.a.first, j = gap.b.first;
        while (i < gap.a.last || j < gap.b.last) {
            const auto* const moved = i < gap.a.last ? place_of(i) : nullptr;
            if (moved != nullptr) {
                const std::uint64_t count = run_of(moved, gap.a.last);
                emit({Pairing::reordered, {i, i + count}, {moved->b, moved->b + count}});
                i += count;
            } else if (j < gap.b.last && taken(j)) {
                ++j;
            } else {
                PassPair left{Pairing::changed, {i, i}, {j, j}};
                while (left.a.last < gap.a.last && place_of(left.a.last) == nullptr) ++left.a.last;
                while (left.b.last < gap.b.last && !taken(left.b.last)) ++left.b.last;
                if (left.a.size() == 0) left.pairing = Pairing::only_b;
                if (left.b.size() == 0) left.pairing = Pairing::only_a;
                emit(left);
                i = left.a.last;
                j = left.b.last;
            }
        }
    }

  private:
    struct Move {
        std::uint64_t a = 0, b = 0;
    };

    static std::vector<std::uint64_t> items(const PassRanges& ranges) {
        std::vector<std::uint64_t> all;
        for (const PassRange& range : ranges)
            for (std::uint64_t k = range.first; k < range.last; ++k) all.push_back(k);
        return all;
    }
    const Move* place_of(std::uint64_t a) const {
        const auto found =
            std::lower_bound(to_b_.begin(), to_b_.end(), a,
                             [](const Move& move, std::uint64_t value) { return move.a < value; });
        return found != to_b_.end() && found->a == a ? &*found : nullptr;
    }
    bool taken(std::uint64_t b) const {
        return std::binary_search(taken_b_.begin(), taken_b_.end(), b);
    }
    std::uint64_t run_of(const Move* first, std::uint64_t end) const {
        const Move* const behind = to_b_.data() + to_b_.size();
        const Move* last = first + 1;
        while (last != behind && last->a < end && last->a == (last - 1)->a + 1 &&
               last->b == (last - 1)->b + 1)
            ++last;
        return static_cast<std::uint64_t>(last - first);
    }

    PassRanges gaps_a_, gaps_b_;
    std::vector<std::uint64_t> items_a_, items_b_, taken_b_;
    std::vector<Move> to_b_;  ///< rising in a
};

}  // namespace

void align(const AlignSource& source, const AlignLimits& limits,
           const std::function<void(const PassPair&)>& found) {
    if (!limits.reordering) return WindowedAligner(source, limits, found).run();
    std::vector<PassPair> pairs;  // with runs of `same` combined
    WindowedAligner(source, limits, [&pairs](const PassPair& pair) {
        if (pair.pairing == Pairing::same && !pairs.empty() &&
            pairs.back().pairing == Pairing::same) {
            ++pairs.back().a.last;
            ++pairs.back().b.last;
        } else {
            pairs.push_back(pair);
        }
    }).run();
    const MovedItems moved(source, pairs);
    for (const PassPair& pair : pairs) {
        for (std::uint64_t k = 0; pair.pairing == Pairing::same && k < pair.a.size(); ++k)
            found({Pairing::same,
                   {pair.a.first + k, pair.a.first + k + 1},
                   {pair.b.first + k, pair.b.first + k + 1}});
        if (pair.pairing != Pairing::same) moved.split(pair, found);
    }
}

}  // namespace trunnion::regression
