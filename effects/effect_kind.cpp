#include "effects/effect_kind.h"

namespace trunnion::effects {

const char* word_of(EffectKind kind) {
    switch (kind) {
        case EffectKind::zero: return "zero";
        case EffectKind::positioning: return "positioning";
        case EffectKind::cyclic: return "cyclic";
        case EffectKind::radial: return "radial";
        case EffectKind::axial: return "axial";
        case EffectKind::tilt: return "tilt";
        case EffectKind::backlash: return "backlash";
        case EffectKind::scale: return "scale";
        case EffectKind::straightness: return "straightness";
        case EffectKind::angular: return "angular";
        case EffectKind::reversal_spike: return "reversal_spike";
        case EffectKind::lateral_play: return "lateral_play";
        case EffectKind::play_load: return "play_load";
        case EffectKind::squareness: return "squareness";
        case EffectKind::location: return "location";
        case EffectKind::pivot_g54: return "pivot.g54";
        case EffectKind::pivot_p1970x: return "pivot.p1970x";
        case EffectKind::servo_mismatch: return "servo.mismatch";
        case EffectKind::servo_contour: return "servo.contour";
        case EffectKind::thermal_drift: return "thermal.drift";
        case EffectKind::thermal_expansion: return "thermal.expansion";
        case EffectKind::machine_expansion: return "machine.expansion";
        case EffectKind::gravity_sag: return "gravity.sag";
        case EffectKind::gravity_tool: return "gravity.tool";
        case EffectKind::chain_collimation: return "chain.collimation";
        case EffectKind::chain_flexure: return "chain.flexure";
        case EffectKind::clamp_shift: return "clamp.shift";
        case EffectKind::probe_pretravel: return "probe.pretravel";
        case EffectKind::probe_radius: return "probe.radius";
        case EffectKind::probe_runout: return "probe.runout";
        case EffectKind::tool_length: return "tool.length";
        case EffectKind::ballbar_length: return "ballbar.length";
        case EffectKind::artefact_position: return "artefact.position";
        case EffectKind::artefact_form: return "artefact.form";
        case EffectKind::artefact_moved: return "artefact.moved";
        case EffectKind::control_rounding: return "control.rounding";
        case EffectKind::control_chord: return "control.chord";
        case EffectKind::sensor_gain: return "sensor.gain";
    }
    return "";
}

std::string effect_name(const std::string& owner, EffectKind kind) {
    return owner + '.' + word_of(kind);
}

bool is_pivot(EffectKind kind) {
    return kind == EffectKind::pivot_g54 || kind == EffectKind::pivot_p1970x;
}

EffectIdentity identity_of(EffectKind kind) {
    return {word_of(kind), kind, std::nullopt};
}

}  // namespace trunnion::effects
