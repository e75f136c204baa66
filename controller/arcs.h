// G2 and G3: centre from I J K or from R, helix, full circles, radius check (3410).
#pragma once

#include "controller/control_state.h"
#include "controller/moves.h"
#include "geometry/plane_path.h"

namespace trunnion {

/// PS0021 when the only centre word belongs to another plane.
void check_plane_of_centre(const ControlState& c);
/// True when the block has R or a centre word of the plane.
bool has_arc_words(const ControlState& c);
/// Carries out the arc that the words of this block command.
void move_arc_block(ControlState& c, bool clockwise);

/// Centre of the arc from start to end with radius r in the plane (first, second as x, y): r < 0
/// takes the way round of more than half a turn. Throws PS0020 when the points are too far apart.
PlanePoint centre_from_radius(PlanePoint start, PlanePoint end, double radius, bool clockwise,
                              double tolerance_mm);
/// Signed angle from start to end about the centre, in (0, 2 pi] counter-clockwise, negative
/// clockwise; equal directions are a full turn.
double sweep_of(PlanePoint centre, PlanePoint start, PlanePoint end, bool clockwise);

/// PS0020 when start and end radius differ by more than the tolerance (0: not compared).
void check_radii(PlanePoint centre, PlanePoint start, PlanePoint end, double tolerance_mm);
/// The arc of this block's words in its plane. `is_arc` false: nothing to turn (R with equal ends).
struct ArcInPlane {
    PlanePoint centre;
    double sweep_rad = 0.0;
    bool is_arc = false;
};
ArcInPlane arc_in_plane(ControlState& c, const ControlPosition& target, bool clockwise);

}  // namespace trunnion
