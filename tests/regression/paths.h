// Paths made by hand for tests of the comparer.
#pragma once

#include <initializer_list>

#include "regression/path_compare.h"

namespace trunnion::testing {

/// Draws a path as a program would: one segment a call, line numbers rising.
class Pen {
  public:
    Pen& at(double x, double y, double z) {
        regression::Segment s = segment(regression::SegmentKind::origin, x, y, z);
        record.add(s);
        return *this;
    }
    Pen& rapid(double x, double y, double z) {
        return add(segment(regression::SegmentKind::rapid, x, y, z));
    }
    Pen& cut(double x, double y, double z) {
        return add(segment(regression::SegmentKind::feed, x, y, z));
    }
    Pen& arc(double x, double y, double z, Vector3 centre, double sweep_rad) {
        regression::Segment s = segment(regression::SegmentKind::feed, x, y, z);
        s.centre_mm = {centre.x(), centre.y(), centre.z()};
        s.normal = {0.0F, 0.0F, 1.0F};
        s.sweep_rad = sweep_rad;
        return add(s);
    }
    Pen& add(regression::Segment s) {
        record.add(s);
        return *this;
    }
    regression::Segment segment(regression::SegmentKind kind, double x, double y, double z) {
        regression::Segment s;
        s.kind = kind;
        s.end_mm = {x, y, z};
        s.end_orientation = {direction.x(), direction.y(), direction.z()};
        s.feed_mm_min = kind == regression::SegmentKind::feed ? static_cast<float>(feed) : 0.0F;
        s.tool = static_cast<std::uint16_t>(tool);
        s.spindle_rpm = static_cast<float>(spindle);
        s.line = ++line;
        return s;
    }
    regression::PathRecord& done() {
        record.finish();
        return record;
    }

    regression::PathRecord record;
    Vector3 direction = Vector3::UnitZ();
    double feed = 500.0, spindle = 8000.0;
    int tool = 1;
    std::uint32_t line = 0;
};

inline regression::PathComparison compare(Pen& a, Pen& b, regression::WalkOptions options = {}) {
    return regression::compare_paths(a.done(), b.done(), options);
}

}  // namespace trunnion::testing
