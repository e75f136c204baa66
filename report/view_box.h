// A box in the plane of a view, with clipping of lines.
#pragma once

#include <limits>
#include <vector>

#include "report/svg.h"

namespace trunnion::report {

struct ViewBox {
    double low_x = std::numeric_limits<double>::infinity(), low_y = low_x;
    double high_x = -low_x, high_y = -low_x;

    void widen(const Point2& p);
    bool holds(const Point2& p) const;
    double width() const { return high_x - low_x; }
    double height() const { return high_y - low_y; }
    ViewBox grown(double by) const { return {low_x - by, low_y - by, high_x + by, high_y + by}; }

    /// The parts of a polyline inside the box, each of at least two points.
    std::vector<std::vector<Point2>> clipped(const std::vector<Point2>& line) const;
};

}  // namespace trunnion::report
