// Lines and arcs in a plane: tangents, offset curves and their intersections.
#pragma once

#include <cmath>
#include <optional>

namespace trunnion::inline geometry {

struct PlanePoint {
    double x = 0.0, y = 0.0;
};

/// A line or an arc in the active plane, mm.
struct PlaneElement {
    PlanePoint start, end;
    bool arc = false;
    PlanePoint centre;
    double sweep_rad = 0.0;  ///< signed angle of an arc, positive counter-clockwise

    bool moves() const;
    double radius() const;
};

inline PlanePoint operator+(PlanePoint a, PlanePoint b) {
    return {a.x + b.x, a.y + b.y};
}
inline PlanePoint operator-(PlanePoint a, PlanePoint b) {
    return {a.x - b.x, a.y - b.y};
}
inline PlanePoint operator*(double k, PlanePoint a) {
    return {k * a.x, k * a.y};
}
inline double dot(PlanePoint a, PlanePoint b) {
    return a.x * b.x + a.y * b.y;
}
inline double cross(PlanePoint a, PlanePoint b) {
    return a.x * b.y - a.y * b.x;
}
inline double length_of(PlanePoint a) {
    return std::hypot(a.x, a.y);
}
inline PlanePoint left_of(PlanePoint t) {
    return {-t.y, t.x};
}

/// Signed angle from start to end about the centre: in (0, 2 pi] counter-clockwise, negative
/// clockwise. Equal directions give a full turn.
double sweep_of(PlanePoint centre, PlanePoint start, PlanePoint end, bool clockwise);

/// Unit tangents in the direction of travel, at the start and at the end.
PlanePoint tangent_at_start(const PlaneElement& e);
PlanePoint tangent_at_end(const PlaneElement& e);
/// Radius of the arc offset by `offset` to its left (positive) or right (negative), mm.
double offset_radius(const PlaneElement& e, double offset);
/// Intersection, nearest to `corner`, of both elements offset to their left; empty when the offset
/// elements do not meet.
std::optional<PlanePoint> offset_meeting(const PlaneElement& first, double first_offset,
                                         const PlaneElement& second, double second_offset,
                                         PlanePoint corner);
/// Part of the element, or of its offset curve, between two of its points. Arcs keep their centre;
/// the sweep is adapted to the new start and end.
PlaneElement between(const PlaneElement& e, PlanePoint start, PlanePoint end);

}  // namespace trunnion::inline geometry
