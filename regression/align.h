// Alignment of two long sequences into parts that are unchanged, reordered, on one side only, or to
// be compared. Works in windows, so that memory does not grow with it (align_windows.cpp).
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <unordered_map>
#include <vector>

#include "regression/path_record.h"

namespace trunnion::regression {

/// A range of passes (or lines): first..last, last excluded.
struct PassRange {
    std::uint64_t first = 0, last = 0;
    std::uint64_t size() const { return last - first; }
};

/// Numbers that are equal for items that are alike.
using Keys = std::vector<std::uint64_t>;

enum class Pairing : std::uint8_t {
    same,       ///< one pass on each side, alike in length, position and tool; details still to be
                ///< compared
    reordered,  ///< the same number on both sides, alike one by one, but in another order
    changed,    ///< the items between two matches on both sides
    only_a,
    only_b,
};

struct PassPair {
    Pairing pairing = Pairing::same;
    PassRange a, b;
};

struct AlignLimits {
    std::uint64_t window = 1U << 14U;  ///< items examined on each side after a mismatch
    std::uint64_t most_window = std::uint64_t{1}
                                << 62U;  ///< maximum window when smaller ones contain no match
    std::size_t most_edits = 1000;       ///< for Myers' algorithm; beyond it, the longest run of
                                         ///< matches
    bool reordering = true;              ///< search all unmatched items for reordered ones
};

using PassRanges = std::vector<PassRange>;

/// The two sequences: `alike(i, j)` is used while they match, `keys` of item ranges of both sides
/// after a mismatch.
struct AlignSource {
    std::uint64_t size_a = 0, size_b = 0;
    std::function<bool(std::uint64_t, std::uint64_t)> alike;
    std::function<void(const PassRanges&, const PassRanges&, Keys&, Keys&)> keys;
};

/// Calls `found` for each pairing in the order of A; items only in B come at their position in B.
/// If nothing matches in the largest window, the rest of both sides is one `changed`. Reordered
/// items are found at any distance; memory grows with the number of unmatched items.
void align(const AlignSource& source, const AlignLimits& limits,
           const std::function<void(const PassPair&)>& found);

/// True for passes with the same tool whose cuts agree within some tolerances in centroid, start,
/// end and length. The path to the cut may differ.
bool alike(const Pass& p, const Pass& q, const Tolerances& tolerances);

/// Numbers for passes, equal for passes that are alike.
class PassIds {
  public:
    explicit PassIds(const Tolerances& tolerances);
    std::uint32_t id_of(const Pass& pass);

  private:
    /// The properties of a pass that decide about likeness.
    struct Look {
        std::array<double, 3> start_mm, end_mm, centroid_mm;
        double cut_mm;
        std::uint16_t tool;
        bool cuts;
    };
    std::uint64_t cell(const Pass& pass, int corner) const;
    bool alike_look(const Look& p, const Pass& q) const;

    Tolerances tolerances_;
    double cell_mm_;
    std::deque<Look> known_;  ///< a deque does not copy its items when it grows
    std::unordered_multimap<std::uint64_t, std::uint32_t> by_cell_;
};

struct IndexPair {
    std::size_t a = 0, b = 0;
};
/// Pairs the n-th occurrence of a key on one side with the n-th on the other; rising in a.
std::vector<IndexPair> nth_with_nth(const Keys& a, IndexPair from, const Keys& b, IndexPair to);
/// The matched index pairs of two sequences, rising on both sides (Myers 1986; beyond `most_edits`
/// the longest rising run of unique matches). Time O(n + edits^2).
std::vector<IndexPair> match_sequences(const Keys& a, const Keys& b, std::size_t most_edits = 1000);

}  // namespace trunnion::regression
