// Where the stylus ball or a tool meets the bodies of a setup on a move.
#pragma once

#include <optional>
#include <vector>

#include "emulator/observer.h"
#include "motion/motion.h"
#include "probe/solids.h"

namespace trunnion::emulator {

/// What the spindle carries to a touch: a stylus ball, or a tool, seen from S.
struct Feeler {
    Vector3 middle_S_mm = Vector3::Zero();  ///< of the ball, or of a tool's tip
    double radius_mm = 0.0;
    double length_mm = 0.0;  ///< of a tool above its tip; 0: a ball
    bool is_tool() const { return length_mm > 0.0; }
};
Feeler stylus_of(const setup::ProbeSettings& probe);
/// A tool turns when its move has a spindle speed.
Feeler feeler_of(const setup::PhysicalTool& tool, const motion::AxisMove& move, double spindle_rad);

/// The solids of a body in its own frame, for a ball.
std::vector<probe::Solid> solids_of(const setup::Body& body);

/// A contact with a body.
struct BodyTouch {
    double s = 1.0;          ///< fraction of the move at which the skip signal latches
    double contact_s = 1.0;  ///< where the two meet
    const setup::Body* body = nullptr;
};

/// The first body that the feeler meets on the move that starts at `start`, the sample of its
/// beginning with the sides of the move. Errors, effects on bodies of the machine and the pretravel
/// of probe or setter are in; noise is not.
std::optional<BodyTouch> touch_bodies(const motion::AxisMove& move, const AxisSample& start,
                                      const Feeler& feeler, const Observer& observer);

}  // namespace trunnion::emulator
