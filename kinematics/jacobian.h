// Analytic derivatives of the tool tip in W: by axis positions and by every error parameter.
#pragma once

#include <array>

#include "kinematics/machine.h"

namespace trunnion::kinematics {

/// Columns X Y Z (mm per mm) and A B C (mm per rad) of the six errors of one axis.
using SixColumns = Eigen::Matrix<double, 3, 6>;

/// d tip_W / d each quantity, exact for finite errors. Axes that the machine does not have: zero.
struct TipJacobian {
    Vector3 tip_W_mm = Vector3::Zero();
    Eigen::Matrix<double, 3, axis_count> axis = Eigen::Matrix<double, 3, axis_count>::Zero();
    std::array<SixColumns, axis_count> location;       ///< by E?0K
    std::array<SixColumns, axis_count> motion;         ///< by the value of E?K at this position
    SixColumns spindle_location = SixColumns::Zero();  ///< by E?0S
    SixColumns spindle_motion = SixColumns::Zero();    ///< by the value of E?S at this angle
    Matrix3 tip = Matrix3::Zero();                     ///< by the tip in S
};

TipJacobian tip_jacobian(const Machine& machine, const AxisPositions& commanded,
                         const Vector3& tip_S_mm, SpindleAngle spindle_rad = 0.0);

}  // namespace trunnion::kinematics
