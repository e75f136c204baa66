// The alignment of two long sequences, window by window.
#include <algorithm>
#include <deque>
#include <unordered_map>

#include "regression/align.h"

namespace trunnion::regression {

namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// What became of one item of a window.
struct Fate {
    bool matched = false;        ///< in order
    bool gone = false;           ///< the other side, or an earlier window, has reported it
    std::size_t partner = none;  ///< reordered: to be reported here
    bool open() const { return !gone && partner == none; }
};

class WindowPairs {
  public:
    WindowPairs(const Keys& a, const Keys& b, std::vector<IndexPair> pairs)
        : a_(a), b_(b), pairs_(std::move(pairs)), fate_a_(a.size()), fate_b_(b.size()) {
        for (const IndexPair& p : pairs_) fate_a_[p.a].matched = fate_b_[p.b].matched = true;
    }
    void gone_a(std::size_t k) { fate_a_[k].gone = true; }
    void gone_b(std::size_t k) { fate_b_[k].gone = true; }

    /// What is left over on both sides and alike was moved to another place in the order. Reported
    /// are items before `end`; partners may lie behind it.
    void find_reordered(IndexPair end) {
        std::unordered_map<std::uint64_t, std::deque<std::size_t>> left_b;
        for (std::size_t j = 0; j < b_.size(); ++j)
            if (!fate_b_[j].matched && !fate_b_[j].gone) left_b[b_[j]].push_back(j);
        for (std::size_t i = 0; i < a_.size(); ++i) {
            if (fate_a_[i].matched || fate_a_[i].gone) continue;
            const auto found = left_b.find(a_[i]);
            if (found == left_b.end() || found->second.empty()) continue;
            const std::size_t j = found->second.front();
            if (i >= end.a && j >= end.b) continue;
            found->second.pop_front();
            if (i < end.a) {
                fate_a_[i].partner = j;
                fate_b_[j].gone = true;
            } else {
                fate_b_[j].partner = i;
                fate_a_[i].gone = true;
            }
        }
    }

    template <typename Emit>
    void report(IndexPair end, const Emit& emit) {
        std::size_t i = 0, j = 0;
        while (!pairs_.empty() && pairs_.back().a >= end.a) pairs_.pop_back();
        pairs_.push_back(end);
        for (const IndexPair& p : pairs_) {
            while (i < p.a || j < p.b) between(i, j, p, emit);
            if (p.a == end.a) break;
            emit(PassPair{Pairing::same, {p.a, p.a + 1}, {p.b, p.b + 1}});
            i = p.a + 1;
            j = p.b + 1;
        }
    }

  private:
    /// Between two pairs: the reordered ones by themselves, the rest of both sides together.
    template <typename Emit>
    void between(std::size_t& i, std::size_t& j, const IndexPair& p, const Emit& emit) {
        if (i < p.a && fate_a_[i].gone) {
            ++i;
        } else if (j < p.b && fate_b_[j].gone) {
            ++j;
        } else if (i < p.a && fate_a_[i].partner != none) {
            const std::size_t to = fate_a_[i].partner;
            emit(PassPair{Pairing::reordered, {i, i + 1}, {to, to + 1}});
            ++i;
        } else if (j < p.b && fate_b_[j].partner != none) {
            const std::size_t from = fate_b_[j].partner;
            emit(PassPair{Pairing::reordered, {from, from + 1}, {j, j + 1}});
            ++j;
        } else {
            PassPair gap{Pairing::changed, {i, i}, {j, j}};
            while (gap.a.last < p.a && fate_a_[gap.a.last].open()) ++gap.a.last;
            while (gap.b.last < p.b && fate_b_[gap.b.last].open()) ++gap.b.last;
            if (gap.a.size() == 0) gap.pairing = Pairing::only_b;
            if (gap.b.size() == 0) gap.pairing = Pairing::only_a;
            emit(gap);
            i = gap.a.last;
            j = gap.b.last;
        }
    }

    const Keys &a_, &b_;
    std::vector<IndexPair> pairs_;
    std::vector<Fate> fate_a_, fate_b_;
};

class WindowedAligner {
  public:
    WindowedAligner(const AlignSource& source, const AlignLimits& limits,
                    const std::function<void(const PassPair&)>& found)
        : source_(source), limits_(limits), found_(found) {}

    void run() {
        for (;;) {
            while (gone_a_.erase(i_) > 0) ++i_;
            while (gone_b_.erase(j_) > 0) ++j_;
            if (i_ == source_.size_a || j_ == source_.size_b) break;
            if (source_.alike(i_, j_)) {
                found_({Pairing::same, {i_, i_ + 1}, {j_, j_ + 1}});
                ++i_, ++j_;
            } else if (!window()) {
                break;
            }
        }
        rest();
    }

  private:
    /// Aligns what lies ahead up to a corner that is sure; false: nothing there matches.
    bool window() {
        for (std::uint64_t size = limits_.window;; size *= 4) {
            size = std::min(size, limits_.most_window);
            const PassRange a{i_, std::min(source_.size_a, i_ + size)};
            const PassRange b{j_, std::min(source_.size_b, j_ + size)};
            const bool whole = a.last == source_.size_a && b.last == source_.size_b;
            source_.keys(a, b, keys_a_, keys_b_);
            hide(gone_a_, a, keys_a_, 1);
            hide(gone_b_, b, keys_b_, 2);
            std::vector<IndexPair> pairs = match_sequences(keys_a_, keys_b_, limits_.most_edits);
            IndexPair end{keys_a_.size(), keys_b_.size()};
            if (!whole) {
                end = sure_corner(pairs, size, size == limits_.most_window);
                if (end.a == 0 && size < limits_.most_window) continue;
                if (end.a == 0) return false;
            }
            report(a, b, std::move(pairs), end);
            return true;
        }
    }

    /// Behind the last match in the first three quarters: what follows may match beyond the window.
    static IndexPair sure_corner(const std::vector<IndexPair>& pairs, std::uint64_t size,
                                 bool any) {
        IndexPair end;
        for (const IndexPair& p : pairs)
            if (4 * p.a < 3 * size && 4 * p.b < 3 * size) end = {p.a + 1, p.b + 1};
        if (end.a == 0 && any && !pairs.empty()) end = {pairs.back().a + 1, pairs.back().b + 1};
        return end;
    }

    /// Keys of their own for items that were reported already.
    static void hide(const std::unordered_set<std::uint64_t>& gone, PassRange range, Keys& keys,
                     std::uint64_t side) {
        for (const std::uint64_t k : gone)
            if (k >= range.first && k < range.last)
                keys[k - range.first] = 0xA5A5000000000000ULL + 4 * k + side;
    }

    void report(PassRange a, PassRange b, std::vector<IndexPair> pairs, IndexPair end) {
        WindowPairs found(keys_a_, keys_b_, std::move(pairs));
        for (const std::uint64_t k : gone_a_)
            if (k < a.last) found.gone_a(k - a.first);
        for (const std::uint64_t k : gone_b_)
            if (k < b.last) found.gone_b(k - b.first);
        if (limits_.reordering) found.find_reordered(end);
        found.report(end, [&](PassPair pair) {
            if (pair.pairing == Pairing::reordered && pair.a.first >= end.a)
                gone_a_.insert(a.first + pair.a.first);
            if (pair.pairing == Pairing::reordered && pair.b.first >= end.b)
                gone_b_.insert(b.first + pair.b.first);
            found_({pair.pairing,
                    {a.first + pair.a.first, a.first + pair.a.last},
                    {b.first + pair.b.first, b.first + pair.b.last}});
        });
        i_ = a.first + end.a;
        j_ = b.first + end.b;
        std::erase_if(gone_a_, [this](std::uint64_t k) { return k < i_; });
        std::erase_if(gone_b_, [this](std::uint64_t k) { return k < j_; });
    }

    /// To the end of both sides, around what was reported already.
    void rest() {
        while (i_ < source_.size_a || j_ < source_.size_b) {
            PassPair pair{Pairing::changed, {i_, i_}, {j_, j_}};
            while (pair.a.last < source_.size_a && !gone_a_.contains(pair.a.last)) ++pair.a.last;
            while (pair.b.last < source_.size_b && !gone_b_.contains(pair.b.last)) ++pair.b.last;
            if (pair.a.size() == 0) pair.pairing = Pairing::only_b;
            if (pair.b.size() == 0) pair.pairing = Pairing::only_a;
            if (pair.a.size() + pair.b.size() > 0) found_(pair);
            i_ = std::min(source_.size_a, pair.a.last + (pair.a.last < source_.size_a ? 1 : 0));
            j_ = std::min(source_.size_b, pair.b.last + (pair.b.last < source_.size_b ? 1 : 0));
        }
    }

    const AlignSource& source_;
    AlignLimits limits_;
    const std::function<void(const PassPair&)>& found_;
    std::uint64_t i_ = 0, j_ = 0;
    Keys keys_a_, keys_b_;
    std::unordered_set<std::uint64_t> gone_a_, gone_b_;  ///< ahead of i_, j_
};

}  // namespace

void align(const AlignSource& source, const AlignLimits& limits,
           const std::function<void(const PassPair&)>& found) {
    WindowedAligner(source, limits, found).run();
}

}  // namespace trunnion::regression
