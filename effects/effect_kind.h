// What an effect is and which axis it belongs to, as values; its name is only their spelling.
#pragma once

#include <optional>
#include <string>

#include "geometry/axes.h"

namespace trunnion::effects {

enum class EffectKind : unsigned char {
    // of one axis
    zero,
    positioning,
    cyclic,
    radial,
    axial,
    tilt,
    backlash,
    scale,
    straightness,
    angular,
    reversal_spike,
    lateral_play,
    play_load,
    // of two linear axes
    squareness,
    // of the whole machine, its devices and its control
    location,
    pivot_g54,
    pivot_p1970x,
    servo_mismatch,
    servo_contour,
    thermal_drift,
    thermal_expansion,
    machine_expansion,
    gravity_sag,
    gravity_tool,
    chain_collimation,
    chain_flexure,
    clamp_shift,
    probe_pretravel,
    probe_radius,
    probe_runout,
    tool_length,
    ballbar_length,
    artefact_position,
    artefact_form,
    artefact_moved,
    control_rounding,
    control_chord,
    sensor_gain
};

/// "backlash" for kinds of an axis or a plane, the whole name "servo.mismatch" for the others.
const char* word_of(EffectKind kind);
/// "C.backlash", "XY.squareness": `owner` is the name of the axis or the plane.
std::string effect_name(const std::string& owner, EffectKind kind);

/// True for a pivot store with other values than the machine.
bool is_pivot(EffectKind kind);

struct EffectIdentity {
    std::string name;  ///< as in files: "C.backlash", "servo.mismatch"
    EffectKind kind = EffectKind::location;
    std::optional<Axis> axis;  ///< of an effect of one axis
};
/// An effect of the whole machine.
EffectIdentity identity_of(EffectKind kind);

}  // namespace trunnion::effects
