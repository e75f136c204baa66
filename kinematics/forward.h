// One axis after the other: the forward kinematics of a chain, prepared once and evaluated often.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "kinematics/machine.h"

namespace trunnion::kinematics {

/// One axis with its location errors worked out; borrows the curves of its error motions.
struct Link {
    Axis axis = Axis::X;
    bool rotary = false;
    Vector3 direction = Vector3::UnitX();  ///< in the frame of the carrier, all axes at zero
    Vector3 point_mm = Vector3::Zero();    ///< q
    Vector3 carried_mm = Vector3::Zero();  ///< q + delta (rotary), delta (linear)
    Matrix3 tilt = Matrix3::Identity();    ///< exp([eps]x) of the location tilts
    bool tilted = false;
    std::uint8_t motions = 0;  ///< bit k: motion curve k is not zero
    const std::array<ErrorCurve, 6>* curves = nullptr;
};

Link make_link(const AxisGeometry& geometry, const AxisErrors& errors);

/// Location and error motion of the spindle: shift (mm) and tilt (rad) in S.
SmallMotion spindle_location(const AxisErrors& spindle);
SmallMotion spindle_motion(const AxisErrors& spindle, SpindleAngle spindle_rad);

/// Carries `pose`, the end of the chain so far, over one more axis at `q` (mm or rad), from the bed
/// outwards; `extra` (nullptr: none) is added to the axis's error motion.
void carry(const Link& link, double q, const SmallMotion* extra, Pose& pose);

/// A machine prepared for many evaluations: no allocation, zero errors skipped. Keeps a copy of the
/// error curves; later changes of the machine are not seen.
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
