// G2 and G3: centre from I J K or from R, helix, full circles, radius check (3410).
#pragma once

#include "controller/mover.h"
#include "geometry/plane_path.h"

namespace trunnion::controller {

struct ArcRule {
    bool clockwise = false;        ///< G2; G3 in G18 of BNC
    bool absolute_centre = false;  ///< I J K are absolute positions instead of distances from the
                                   ///< start (BNC)
    double tolerance_mm = 0.0;     ///< 3410; 0: start and end radius are not compared
};
/// What becomes of an arc whose radii at start and end, mm, differ.
enum class ArcFit : unsigned char {
    good,
    open,    ///< carried out although it is seldom meant: 3410 compares nothing
    refused  ///< PS0020
};
ArcFit fit_of_radii(double start_mm, double end_mm, double tolerance_mm);
/// True when the chord is too long for the radius of an R arc: PS0020. All mm.
bool chord_exceeds(double chord_mm, double radius_mm, double tolerance_mm);
/// Rule of the active G2 or G3, and 3410.
ArcRule arc_rule(const Modal& modal);

/// Centre of the arc of radius |r| from start to end in the plane (first, second as x, y), mm. r <
/// 0: the arc of more than half a turn. Throws PS0020 when the points are too far apart.
PlanePoint centre_from_radius(PlanePoint start, PlanePoint end, double radius, const ArcRule& rule);

/// PS0021 when the only centre word does not belong to the plane; on a Fanuc PS0010 for Q or L,
/// which turn the arc into a spiral (B-63944EN/02 p. 65).
void check_arc_words(const SortedWords& words, const Modal& modal);
/// True when the block has R or a centre word of the plane.
bool has_arc_words(const SortedWords& words, const motion::PlaneAxes& plane);
/// Converts `figure`, a line of the plane, into the arc commanded by R or by the centre words. R
/// has priority over I J K; R with equal end points leaves a line. PS0020 when the points are too
/// far apart or the radii differ too much, PS0022 for R0. Returns how the end fits.
ArcFit bend_to_arc(const SortedWords& words, const motion::PlaneAxes& plane, const ArcRule& rule,
                   PlaneElement& figure);
/// Tells an end that is not on the circle.
void watch_arc(ArcFit fit, const PlaneElement& figure, const Modal& modal, Mover& mover);

/// Tells an arc without R and centre.
void watch_straight_arc(const SortedWords& words, const Modal& modal, Mover& mover);
/// Executes the arc commanded by this block.
void move_arc_block(const SortedWords& words, Modal& modal, const Frames& frames, Mover& mover);

}  // namespace trunnion::controller
