// Lines and arcs in a plane: tangents, offset curves and where they meet.
#pragma once

#include <optional>

namespace trunnion::inline geometry {

struct PlanePoint {
    double x = 0.0, y = 0.0;
};

/// A line or an arc in the plane in force, mm.
struct PlaneElement {
    PlanePoint start, end;
    bool arc = false;
    PlanePoint centre;
    double sweep_rad = 0.0;  ///< signed, of arcs

    bool moves() const;
    double radius() const;
};

PlanePoint operator+(PlanePoint a, PlanePoint b);
PlanePoint operator-(PlanePoint a, PlanePoint b);
PlanePoint operator*(double k, PlanePoint a);
double dot(PlanePoint a, PlanePoint b);
double cross(PlanePoint a, PlanePoint b);
double length_of(PlanePoint a);
inline PlanePoint left_of(PlanePoint t) {
    return {-t.y, t.x};
}

/// Signed angle from start to end about the centre, in (0, 2 pi] counter-clockwise, negative
/// clockwise; equal directions are a full turn.
double sweep_of(PlanePoint centre, PlanePoint start, PlanePoint end, bool clockwise);

/// Unit tangents in the direction of travel.
PlanePoint tangent_at_start(const PlaneElement& e);
PlanePoint tangent_at_end(const PlaneElement& e);
/// Radius of the arc moved by `offset` to its left (positive) or right.
double offset_radius(const PlaneElement& e, double offset);
/// Where both elements, moved to their left by `offset`, meet next to `corner`; nothing when they
/// do not meet.
std::optional<PlanePoint> offset_meeting(const PlaneElement& first, double first_offset,
                                         const PlaneElement& second, double second_offset,
                                         PlanePoint corner);
/// The element between two points of it (or of a curve at a distance): arcs keep their centre, the
/// sweep follows the shift of start and end.
PlaneElement between(const PlaneElement& e, PlanePoint start, PlanePoint end);

}  // namespace trunnion::inline geometry
