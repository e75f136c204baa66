// Choice between the solutions for the rotary axes: G53.1, G53.6, G43.5.
#pragma once

#include <optional>
#include <vector>

#include "positioning/rotary_transform.h"

namespace trunnion::positioning {

/// P of G53.1: by the shortest move, or by the sign of the axis that tilts the tool.
enum class Branch : int { nearest = 0, positive = 1, negative = 2 };

/// Travel of the two rotary axes, rad; an empty limit does not restrict.
struct RotaryTravel {
    struct Range {
        std::optional<double> min_rad, max_rad;
    };
    Range first, second;
};

struct RotaryChoice {
    std::optional<RotarySolution> chosen;       ///< empty: direction out of reach or all solutions
                                                ///< out of travel
    std::vector<RotarySolution> all;            ///< all solutions within travel, each at its
                                                ///< nearest turn
    std::vector<RotarySolution> out_of_travel;  ///< solutions that no number of turns brings into
                                                ///< the travel
};

/// Rotary angles that point the tool along the unit vector n_W. Criteria, in this order: shortest
/// move of the master axis (of the table axis on a mixed machine); shortest move of the other axis;
/// master angle nearest 0 (mod 360); other angle nearest 0. Moves that differ by less than 1e-9 rad
/// count as equal. Each angle is the turn nearest `present` that the travel allows, so an axis near
/// its limit rewinds. `choice.all` is empty when the direction is out of reach.
RotaryChoice choose_rotaries(const RotaryTransform& transform, const Vector3& n_W,
                             const RotarySolution& present, const RotaryTravel& travel,
                             Branch branch = Branch::nearest);

/// `angle_rad` plus the number of full turns that brings it nearest to `present_rad` within the
/// range (limits widened by 1e-9 rad). Empty when no turn lies in the range.
std::optional<double> nearest_turn(double angle_rad, double present_rad,
                                   const RotaryTravel::Range& range);

}  // namespace trunnion::positioning
