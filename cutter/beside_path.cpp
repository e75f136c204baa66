#include "cutter/beside_path.h"

#include <cmath>

#include "cutter/cutter_alarms.h"

namespace trunnion::cutter {

namespace {

/// A reversed direction of travel beside the contour means that the cutter does not fit.
void check_direction(const PathMove& m, const PlaneElement& way) {
    constexpr double slack_mm = 1e-6;
    if (!m.plane.arc) {
        if (dot(way.end - way.start, tangent_at_start(m.plane)) < -slack_mm) raise_cutter_alarm(41);
        return;
    }
    check_radius(m);
    if (way.sweep_rad * m.plane.sweep_rad < 0.0) raise_cutter_alarm(41);
}

}  // namespace

void check_radius(const PathMove& m) {
    if (!m.plane.arc) return;
    const double radius = offset_radius(m.plane, m.offset_mm);
    if (std::abs(radius) <= 1e-6) raise_cutter_alarm(38);
    if (radius < 0.0) raise_cutter_alarm(41);
}

PlanePoint square_to_end(const PathMove& m) {
    return m.plane.end + m.offset_mm * left_of(tangent_at_end(m.plane));
}
PlanePoint square_to_start(const PathMove& m) {
    return m.plane.start + m.offset_mm * left_of(tangent_at_start(m.plane));
}

void BesidePath::send(const PathMove& m, const PlaneElement& way, bool beside) {
    PathOutput out;
    out.move = m;
    out.way = way;
    out.from = tool;
    out.beside = beside;
    out.block = held.block;
    out.to = m.to;
    out.to[m.axes.first] = way.end.x;
    out.to[m.axes.second] = way.end.y;
    tool = out.to;
    held.add(out);
}

void BesidePath::line_to(const PathMove& m, PlanePoint end) {
    PlaneElement way;
    way.start = tool_in_plane(m);
    way.end = end;
    send(m, way, m.offset_mm != 0.0 && last_offset_mm != 0.0);
}

void BesidePath::run_beside(const PathMove& m, PlanePoint end) {
    const double before = last_offset_mm;
    const bool free = before == 0.0 && m.offset_mm == 0.0;  // a corner without compensation
    const bool starts = !free && before == 0.0, ends = !free && m.offset_mm == 0.0;
    if (m.plane.arc && (starts || ends)) raise_cutter_alarm(34);
    PlaneElement way;
    if (m.plane.arc) {
        way = between(m.plane, tool_in_plane(m), end);
    } else {
        way.start = tool_in_plane(m);
        way.end = end;
    }
    if (!starts && !ends) check_direction(m, way);
    send(m, way, !free && !starts && !ends);
}

}  // namespace trunnion::cutter
