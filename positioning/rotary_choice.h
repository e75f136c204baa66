// Which of the rotary solutions the control takes: G53.1, G53.6, G43.5.
#pragma once

#include <optional>
#include <vector>

#include "positioning/rotary_transform.h"

namespace trunnion::positioning {

/// P of G53.1: by the way, or by the sign of the axis that tilts the tool.
enum class Branch : int { nearest = 0, positive = 1, negative = 2 };

/// Travel of the two rotary axes, rad; unlimited where empty.
struct RotaryTravel {
    struct Range {
        std::optional<double> min_rad, max_rad;
    };
    Range first, second;
};

struct RotaryChoice {
    std::optional<RotarySolution> chosen;       ///< nothing: out of reach or of travel
    std::vector<RotarySolution> all;            ///< every branch, nearest turn within the travel
    std::vector<RotarySolution> out_of_travel;  ///< branches that no turn brings into the travel
};

/// Angles that point the tool along n_W from where the rotaries stand: least move of the master
/// (mixed machines: of the table axis), then of the other, then the master nearest 0 (mod 360),
/// then the other. Each angle is the nearest turn that the travel allows, so an axis at its end
/// rewinds.
RotaryChoice choose_rotaries(const RotaryTransform& transform, const Vector3& n_W,
                             const RotarySolution& present, const RotaryTravel& travel,
                             Branch branch = Branch::nearest);

/// The turn of `angle_rad` (mod 2 pi) nearest to `present_rad` within the range; nothing when there
/// is none.
std::optional<double> nearest_turn(double angle_rad, double present_rad,
                                   const RotaryTravel::Range& range);

}  // namespace trunnion::positioning
