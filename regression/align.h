// What belongs together in two long sequences: unchanged, reordered, only on one side, or to be
// compared. Works through both in windows, so that memory does not grow with their length.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <unordered_map>
#include <vector>

#include "regression/path_record.h"

namespace trunnion::regression {

/// A stretch of passes (or lines): first..last, last not included.
struct PassRange {
    std::uint64_t first = 0, last = 0;
    std::uint64_t size() const { return last - first; }
};

/// Numbers that are equal where things are alike.
using Keys = std::vector<std::uint64_t>;

enum class Pairing : std::uint8_t {
    same,       ///< one pass each, alike by length, place and tool: still to be compared in detail
    reordered,  ///< as many on both sides, alike one by one, but at another place in the order
    changed,    ///< what stands between two pairs on both sides
    only_a,
    only_b,
};

struct PassPair {
    Pairing pairing = Pairing::same;
    PassRange a, b;
};

struct AlignLimits {
    std::uint64_t window = 1U << 14U;  ///< items looked at on each side where the two part
    std::uint64_t most_window = std::uint64_t{1}
                                << 62U;  ///< and where nothing in smaller windows matches
    std::size_t most_edits = 1000;       ///< Myers' walk; beyond, a longest run of matches
    bool reordering = true;  ///< look, in all that is left over, for items at another place
};

using PassRanges = std::vector<PassRange>;

/// The two sequences: `alike(i, j)` where they run together, `keys` of all items of some ranges of
/// both sides where they part.
struct AlignSource {
    std::uint64_t size_a = 0, size_b = 0;
    std::function<bool(std::uint64_t, std::uint64_t)> alike;
    std::function<void(const PassRanges&, const PassRanges&, Keys&, Keys&)> keys;
};

/// Calls `found` for each pairing, in the order of A, what is only in B where it stands in B.
/// Where nothing matches in the largest window the rest of both sides is one `changed`. Reordered
/// items are found at any distance; memory grows with the number of items that are left over.
void align(const AlignSource& source, const AlignLimits& limits,
           const std::function<void(const PassPair&)>& found);

/// Same tool, and the cut's centroid, start, end and length equal within some tolerances (the cut's
/// only: the way to it may differ).
bool alike(const Pass& p, const Pass& q, const Tolerances& tolerances);

/// Numbers for passes, equal for passes that are alike.
class PassIds {
  public:
    explicit PassIds(const Tolerances& tolerances);
    std::uint32_t id_of(const Pass& pass);

  private:
    /// What of a pass makes it alike to others.
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
    std::deque<Look> known_;  ///< does not grow by copies as a vector does
    std::unordered_multimap<std::uint64_t, std::uint32_t> by_cell_;
};

struct IndexPair {
    std::size_t a = 0, b = 0;
};
/// The n-th occurrence of a key on one side goes with the n-th on the other; rising in a.
std::vector<IndexPair> nth_with_nth(const Keys& a, IndexPair from, const Keys& b, IndexPair to);
/// The matched index pairs of two sequences, rising on both sides (Myers 1986; a longest rising
/// run of unique matches beyond `most_edits`). Time O(n + edits^2).
std::vector<IndexPair> match_sequences(const Keys& a, const Keys& b, std::size_t most_edits = 1000);

}  // namespace trunnion::regression
