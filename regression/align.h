// What belongs together in two long sequences: unchanged, reordered, only on one side, or to be
// compared. Works through both in windows, so that memory does not grow with their length.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_set>
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
    reordered,  ///< alike, but at another place in the order
    changed,    ///< what stands between two pairs on both sides
    only_a,
    only_b,
};

struct PassPair {
    Pairing pairing = Pairing::same;
    PassRange a, b;
};

struct AlignLimits {
    std::uint64_t window = 1U << 14U;       ///< items looked at on each side where the two part
    std::uint64_t most_window = 1U << 16U;  ///< and where nothing in that window matches
    std::size_t most_edits = 1000;          ///< Myers' walk; beyond, a longest run of matches
    bool reordering = true;                 ///< look for items at another place in the order
};

/// The two sequences: `alike(i, j)` where they run together, `keys` of two ranges where they part.
struct AlignSource {
    std::uint64_t size_a = 0, size_b = 0;
    std::function<bool(std::uint64_t, std::uint64_t)> alike;
    std::function<void(PassRange, PassRange, Keys&, Keys&)> keys;
};

/// Calls `found` for each pairing, in the order of A, what is only in B where it stands in B.
/// Where nothing matches in the largest window the rest of both sides is one `changed`.
void align(const AlignSource& source, const AlignLimits& limits,
           const std::function<void(const PassPair&)>& found);

/// Same tool, and the cut's centroid, start, end and length equal within some tolerances (the cut's
/// only: the way to it may differ).
bool alike(const Pass& p, const Pass& q, const Tolerances& tolerances);

/// One number for each pass, equal for passes that are alike.
void identify_passes(const std::vector<Pass>& a, const std::vector<Pass>& b,
                     const Tolerances& tolerances, Keys& ids_a, Keys& ids_b);

/// The matched index pairs of two sequences, rising on both sides (Myers 1986; a longest rising
/// run of unique matches beyond `most_edits`). Time O(n + edits^2).
struct IndexPair {
    std::size_t a = 0, b = 0;
};
std::vector<IndexPair> match_sequences(const Keys& a, const Keys& b, std::size_t most_edits = 1000);

}  // namespace trunnion::regression
