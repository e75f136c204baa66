// Feed, spindle, coolant and tool along two stretches that take the same path.
#pragma once

#include <cstdint>
#include <vector>

#include "regression/path_region.h"

namespace trunnion::regression {

/// Takes parts of a segment of A and of one of B that agree as paths, in order, and adds a region
/// where they differ in feed, spindle, coolant or tool.
///
/// A feed that is commanded (G94) counts segment by segment. One that follows from length and time
/// (G93, or rotary axes turn) is as uncertain as the length: a chord of 0.05 mm rounded to 0.001 mm
/// is 1 % longer or shorter. It is judged as length over time of windows, at least 4 tolerances /
/// feed ratio long (4 mm by default), and what remains of the tolerance is allowed for.
class AttributeComparer {
  public:
    AttributeComparer(SegmentWindow& a, SegmentWindow& b, const Tolerances& tolerances)
        : a_(a), b_(b), tolerances_(tolerances) {}

    void begin(std::vector<PathRegion>& regions);
    /// The parts are `length_a_mm`, `length_b_mm` long.
    void pair(std::uint64_t i, std::uint64_t j, double length_a_mm, double length_b_mm);
    /// Ends a stretch: takes out what differs nowhere along more than four position tolerances,
    /// because corners of both paths need not lie at the same place.
    void end();

  private:
    struct Window {
        Stretch a, b;
        double length_a_mm = 0.0, length_b_mm = 0.0, time_a = 0.0, time_b = 0.0;
        bool open = false;
    };
    void feeds(std::uint64_t i, std::uint64_t j, double length_a_mm, double length_b_mm);
    void close_window();
    void add(RegionKind kind, Stretch a, Stretch b, double value_a, double value_b,
             double length_mm);
    bool continues(const PathRegion& region, RegionKind kind, double value_a, double value_b) const;

    SegmentWindow &a_, &b_;
    Tolerances tolerances_;
    std::vector<PathRegion>* regions_ = nullptr;
    std::size_t first_region_ = 0;
    Window window_;
    double gone_mm_ = 0.0;  ///< along A, to the end of the pair at hand
};

}  // namespace trunnion::regression
