// Effects of load and clamping on the table.
#include <cmath>

#include "effects/models.h"

namespace trunnion::effects {

Effect gravity_sag(const kinematics::AxisGeometry& tilting) {
    EffectParameter sag{"sag_mm", "mm", 5e-3, -1, {}, true};
    sag.is_positive = true;
    return {identity_of(EffectKind::gravity_sag),
            "The tilted table hangs through under its own weight and the load on it",
            "flexible trunnion drive or bearings, heavy workpiece",
            "counterbalance or clamp the axis; compensate by tilt angle and load",
            "tilt angle + twist_rad (1 + m/100 kg) sin q; "
            "table down by sag_mm ((1 + m/100) cos^2 q - 1)",
            {{"twist_rad", "rad", 25e-6, -1, {}, true}, sag},
            [k = tilting.axis](const AxisSample& sample, const emulator::Contact&,
                               std::span<const double> value, kinematics::Perturbation& out) {
                const double load = 1.0 + sample.load_kg / 100.0;
                const double c = std::cos(sample.position[k]);
                out.axis[k] += value[0] * load * std::sin(sample.position[k]);
                out.motion[index_of(k)].shift_mm.z() -= value[1] * (load * c * c - 1.0);
            }};
}

Effect clamp_shift(const kinematics::Chain& chain) {
    std::vector<Axis> rotary;
    Effect effect{
        identity_of(EffectKind::clamp_shift),
        "The table moves when its clamp closes",
        "the clamp pulls to one side, worn clamp ring",
        "readjust the clamp; measure and cut in the same clamp state",
        "clamped: what rotary axis R carries shifted by shift_R_mm (in the carrier's axes) "
        "and turned by turn_R_rad",
        {},
        {}};
    for (const kinematics::AxisGeometry& axis : chain.work) {
        if (!axis.rotary) continue;
        rotary.push_back(axis.axis);
        for (int d = 0; d < 3; ++d)
            effect.parameters.push_back(
                {axis_parameter("shift_", axis, "_mm"), "mm", 5e-3, d, {}, true});
        effect.parameters.push_back(
            {axis_parameter("turn_", axis, "_rad"), "rad", 20e-6, -1, {}, true});
    }
    effect.add = [rotary](const AxisSample& sample, const emulator::Contact&,
                          std::span<const double> value, kinematics::Perturbation& out) {
        if (!sample.clamped) return;
        for (std::size_t j = 0; j < rotary.size(); ++j) {
            const auto v = value.subspan(4 * j, 4);
            out.motion[index_of(rotary[j])].shift_mm += Vector3(v[0], v[1], v[2]);
            out.axis[rotary[j]] += v[3];
        }
    };
    return effect;
}

}  // namespace trunnion::effects
