// G2 and G3: centre from I J K or from R, helix, full circles, radius check (3410).
#pragma once

#include "controller/mover.h"
#include "geometry/plane_path.h"

namespace trunnion::controller {

struct ArcRule {
    bool clockwise = false;        ///< G2; G3 in G18 of BNC
    bool absolute_centre = false;  ///< I J K are a place, not a way from the start (BNC)
    double tolerance_mm = 0.0;     ///< 3410; 0: start and end radius are not compared
};
/// G2 or G3 in force, and 3410.
ArcRule arc_rule(const Modal& modal);

/// Centre of the arc from start to end with radius r in the plane (first, second as x, y), mm: r <
/// 0 takes the way round of more than half a turn. Throws PS0020 when the points are too far apart.
PlanePoint centre_from_radius(PlanePoint start, PlanePoint end, double radius, const ArcRule& rule);

/// PS0021 when the only centre word belongs to another plane.
void check_plane_of_centre(const SortedWords& words, const motion::PlaneAxes& plane);
/// True when the block has R or a centre word of the plane.
bool has_arc_words(const SortedWords& words, const motion::PlaneAxes& plane);
/// Makes `figure`, a line of the plane, the arc that R or the centre words command. R goes before
/// I J K; R with equal ends leaves a line. PS0020 when the points are too far apart or the radii
/// differ too much, PS0022 for R0.
void bend_to_arc(const SortedWords& words, const motion::PlaneAxes& plane, const ArcRule& rule,
                 PlaneElement& figure);

/// Carries out the arc that the words of this block command.
void move_arc_block(const SortedWords& words, Modal& modal, const Frames& frames, Mover& mover);

}  // namespace trunnion::controller
