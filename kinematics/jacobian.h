// Analytic derivatives of the tool tip in W with respect to axis positions and error parameters.
#pragma once

#include <array>

#include "kinematics/machine.h"

namespace trunnion::kinematics {

/// Columns X Y Z (mm per mm) and A B C (mm per rad) of the six errors of one axis.
using SixColumns = Eigen::Matrix<double, 3, 6>;

/// Derivatives of tip_W with respect to each quantity, at the given errors (not linearised about
/// zero errors). Columns are mm per mm for X Y Z and linear axes, mm per rad for A B C and rotary
/// axes. Columns of axes that the machine does not have are zero. Exact up to the series of the
/// rotation-vector Jacobian: relative error below |tilt|^4 / 120, far below rounding for tilts
/// under 1e-3 rad.
struct TipJacobian {
    Vector3 tip_W_mm = Vector3::Zero();
    Eigen::Matrix<double, 3, axis_count> axis = Eigen::Matrix<double, 3, axis_count>::Zero();
    std::array<SixColumns, axis_count> location;       ///< with respect to E?0K
    std::array<SixColumns, axis_count> motion;         ///< with respect to the value of E?K at this
                                                       ///< position
    SixColumns spindle_location = SixColumns::Zero();  ///< with respect to E?0S
    SixColumns spindle_motion = SixColumns::Zero();    ///< with respect to the value of E?S at this
                                                       ///< angle
    Matrix3 tip = Matrix3::Zero();                     ///< with respect to the tip in S
};

TipJacobian tip_jacobian(const Machine& machine, const AxisPositions& commanded,
                         const Vector3& tip_S_mm, SpindleAngle spindle_rad = 0.0);

}  // namespace trunnion::kinematics
