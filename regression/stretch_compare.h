// Compares two stretches of path side by side; after a difference, finds where they agree again.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "regression/align.h"
#include "regression/attribute_compare.h"

namespace trunnion::regression {

/// Totals of a comparison, with or without differences.
struct WalkTotals {
    std::uint64_t compared = 0;                     ///< segments
    double position_mm = 0.0, direction_rad = 0.0;  ///< largest of all
    std::uint64_t worst_a = 0, worst_b = 0;         ///< segments of the largest deviation
    void worst(double position_mm, double direction_rad, std::uint64_t a, std::uint64_t b);
};

struct WalkOptions {
    Tolerances tolerances;
    std::size_t max_regions = 100000;  ///< of one stretch; further ones are merged into the last
    /// The place where two cuts agree again is searched within this number of segments of each.
    /// Otherwise the stretches are one difference, and the search continues after them.
    std::size_t resync_segments = 1U << 18U;
    AlignLimits align;
    /// Rapids need not agree along their path, only the following cuts: on another machine the path
    /// differs.
    bool other_machine = false;
};

/// Compares the stretches and appends the regions that differ, in order. Linear time.
class StretchComparer {
  public:
    StretchComparer(const SegmentFile& a, const SegmentFile& b, WalkOptions options)
        : a_(a), b_(b), options_(options), attributes_(a_, b_, options.tolerances) {}

    void compare(Stretch a, Stretch b, std::vector<PathRegion>& regions, WalkTotals& totals);

  private:
    struct Corner {
        std::uint64_t i = 0, j = 0;
    };
    bool quick_match(Corner at, Stretch a, Stretch b);
    bool same_arc(Corner at);
    void attributes(Corner at);
    void attributes_between(Corner from, Corner to);
    void other_kind_alone(Corner from, Corner to);
    Corner first_failing(const FrechetResult& failed, Corner from, Stretch a, Stretch b);
    Corner meet_again(Corner at, Stretch a, Stretch b);
    bool meet_near(Corner& at, Stretch a, Stretch b);
    bool meet_shifted(Corner& at, Stretch a, Stretch b);
    bool meet_far(Corner& at, Stretch a, Stretch b, std::size_t window);
    using CornerTable = std::vector<std::pair<std::uint64_t, std::uint64_t>>;  ///< by hash
    CornerTable corners_of_b(std::uint64_t first, std::uint64_t last);
    bool common(std::uint64_t i, std::uint64_t j);
    bool confirmed(std::uint64_t i, std::uint64_t j, Stretch a, Stretch b);
    void add_region(Corner from, Corner to);
    bool retry_exact(Corner& at, Stretch a, Stretch b);
    void commit(Corner at);

    SegmentWindow a_, b_;
    WalkOptions options_;
    AttributeComparer attributes_;
    Stretch stretch_a_, stretch_b_;
    std::vector<PathRegion>* regions_ = nullptr;
    WalkTotals* totals_ = nullptr;
    std::size_t first_region_ = 0;
    std::vector<Corner> commits_;
};

}  // namespace trunnion::regression
