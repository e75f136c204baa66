// Where a printed touch begins: by the control's coordinates, and by its axes.
#pragma once

#include <string>

#include "geometry/axes.h"
#include "geometry/pose.h"

namespace trunnion::imports {

struct TouchStart {
    std::string test;
    PositioningMode mode = PositioningMode::none;
    AxisPositions stands;             ///< by the line AT before it
    Vector3 at_mm = Vector3::Zero();  ///< X Y Z of the line TOUCH (#5041..)
};

/// From touch to touch in one test, mode and pose, X Y Z advance as the linear axes do, whatever
/// work offset is in force. False if they do not: a line AT was lost. True for different poses.
bool advances(const TouchStart& before, const TouchStart& now, double tolerance_mm);

}  // namespace trunnion::imports
