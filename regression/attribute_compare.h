// Feed, spindle, coolant and tool along two stretches with the same path.
#pragma once

#include <cstdint>
#include <vector>

#include "regression/path_region.h"

namespace trunnion::regression {

/// Takes parts of a segment of A and of one of B whose paths agree, in order, and adds a region
/// where they differ in feed, spindle, coolant or tool.
///
/// A commanded feed (G94) is compared segment by segment. A feed that follows from length and time
/// (G93, or with moving rotary axes) is as uncertain as the length: a chord of 0.05 mm rounded to
/// 0.001 mm is 1 % longer or shorter. It is compared as length over time in windows of at least 4
/// tolerances / feed ratio (4 mm by default), and the remaining uncertainty of the length is
/// allowed for.
class AttributeComparer {
  public:
    AttributeComparer(SegmentWindow& a, SegmentWindow& b, const Tolerances& tolerances)
        : a_(a), b_(b), tolerances_(tolerances) {}

    void begin(std::vector<PathRegion>& regions);
    /// The parts have the lengths `length_a_mm` and `length_b_mm`.
    void pair(std::uint64_t i, std::uint64_t j, double length_a_mm, double length_b_mm);
    /// One of the segments is of a kind (rapid, feed) that the other path has not there, and moves
    /// alone, within the tolerance.
    void alone(std::uint64_t i, std::uint64_t j, double length_mm);
    /// Ends a stretch. Removes differences shorter than four position tolerances, because the
    /// corners of both paths may be at different places.
    void end();

  private:
    struct Window {
        Stretch a, b;
        double length_a_mm = 0.0, length_b_mm = 0.0, time_a = 0.0, time_b = 0.0;
        bool open = false;
    };
    void feeds(std::uint64_t i, std::uint64_t j, double length_a_mm, double length_b_mm);
    void close_window();
    struct Values {
        double a, b;
    };
    void add(RegionKind kind, Stretch a, Stretch b, Values values, double length_mm);
    bool continues(const PathRegion& region, RegionKind kind, Values values) const;

    SegmentWindow &a_, &b_;
    Tolerances tolerances_;
    std::vector<PathRegion>* regions_ = nullptr;
    std::size_t first_region_ = 0;
    Window window_;
    double gone_mm_ = 0.0;  ///< path length along A, up to the end of the present pair
};

}  // namespace trunnion::regression
