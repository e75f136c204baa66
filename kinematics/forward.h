// Forward kinematics of a chain, axis by axis: prepared once, evaluated often.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kinematics/machine.h"

namespace trunnion::kinematics {

/// One axis with its location errors applied. Does not own the curves of its error motions:
/// `curves` points into the AxisErrors given to make_link().
struct Link {
    Axis axis = Axis::X;
    bool rotary = false;
    Vector3 direction = Vector3::UnitX();  ///< unit vector in the carrier's frame, all axes at zero
    Vector3 point_mm = Vector3::Zero();    ///< q: point on the axis line
    Vector3 carried_mm = Vector3::Zero();  ///< q + delta (rotary), delta (linear)
    Matrix3 tilt = Matrix3::Identity();    ///< exp([eps]x) of the location tilt
    bool tilted = false;
    std::uint8_t motions = 0;  ///< bit k: motion curve k is not zero
    const std::array<ErrorCurve, 6>* curves = nullptr;
};

Link make_link(const AxisGeometry& geometry, const AxisErrors& errors);

/// Location and error motion of the spindle as shift (mm) and tilt (rad) in S. Without an angle
/// (spindle turning) only the constants of the error motion count.
SmallMotion spindle_location(const AxisErrors& spindle);
SmallMotion spindle_motion(const AxisErrors& spindle, SpindleAngle spindle_rad);

/// Position of an axis, mm or rad: where a program sends it, and where it goes.
struct LinkPosition {
    double commanded = 0.0, actual = 0.0;
};

/// Appends one axis to `pose`, the end of the chain so far, counted from the bed outwards. `extra`
/// (nullptr: none) is added to the error motion of the axis.
void carry(const Link& link, const LinkPosition& at, const SmallMotion* extra, Pose& pose);

/// A machine prepared for many evaluations: no allocation, zero errors are skipped. Gives the same
/// poses as Machine. Keeps a copy of the error curves, so later changes of the machine have no
/// effect.
class ForwardModel {
  public:
    explicit ForwardModel(const Machine& machine);
    ForwardModel(const ForwardModel&) = delete;
    ForwardModel& operator=(const ForwardModel&) = delete;

    MachinePose poses(const AxisPositions& commanded, SpindleAngle spindle_rad = 0.0) const;
    MachinePose poses(const AxisPositions& commanded, const Perturbation& extra,
                      SpindleAngle spindle_rad = 0.0) const;
    Vector3 tip_W(const AxisPositions& commanded, const Vector3& tip_S_mm,
                  SpindleAngle spindle_rad = 0.0) const;

  private:
    GeometricErrors errors_;
    std::vector<Link> work_, tool_;
    bool has_spindle_ = false;
};

}  // namespace trunnion::kinematics
