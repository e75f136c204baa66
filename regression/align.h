// Which passes of two paths belong together: unchanged, reordered, only on one side, or to be
// compared.
#pragma once

#include <cstdint>
#include <vector>

#include "regression/path_record.h"

namespace trunnion {

/// A stretch of passes: first..last, last not included.
struct PassRange {
    std::size_t first = 0, last = 0;
    std::size_t size() const { return last - first; }
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

/// One number for each pass, equal for passes that are alike: same tool, and the cut's centroid,
/// start, end and length equal within some tolerances (the cut's only: the way to it may differ).
void identify_passes(const std::vector<Pass>& a, const std::vector<Pass>& b,
                     const Tolerances& tolerances, Keys& ids_a, Keys& ids_b);

/// Aligns two sequences of ids (Myers 1986; a longest rising run of unique matches beyond
/// `most_edits`), in the order of A, what is only in B where it stands in B. Time O(n + edits^2).
std::vector<PassPair> align_passes(const Keys& ids_a, const Keys& ids_b,
                                   std::size_t most_edits = 2000);

/// The matched index pairs of two sequences, rising on both sides.
struct IndexPair {
    std::size_t a = 0, b = 0;
};
std::vector<IndexPair> match_sequences(const Keys& a, const Keys& b, std::size_t most_edits = 2000);

}  // namespace trunnion
