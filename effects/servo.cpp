// Dynamic errors of the drives: lag mismatch between axes, and circle contraction.
#include "effects/models.h"

namespace trunnion::effects {

Effect servo_mismatch(const kinematics::Chain& chain) {
    Effect effect{identity_of(EffectKind::servo_mismatch),
                  "Axes follow with different delay: circles become ovals at 45 degrees",
                  "different position-loop gains or feed-forward between axes",
                  "set the loop gains of all interpolating axes alike",
                  "position - tau_s * velocity, each axis its own tau_s",
                  {},
                  {},
                  SeenBy::any_encoder};
    std::vector<Axis> axes;
    for (const kinematics::AxisGeometry& axis : chain.axes()) {
        axes.push_back(axis.axis);
        effect.parameters.push_back(
            {axis_parameter("tau_", axis, "_s"), "s", 0.25e-3, -1, {}, true});
    }
    effect.add = [axes](const AxisSample& sample, const emulator::Contact&,
                        std::span<const double> value, kinematics::Perturbation& out) {
        for (std::size_t j = 0; j < axes.size(); ++j)
            out.axis[axes[j]] -= value[j] * sample.velocity[axes[j]];
    };
    return effect;
}

Effect servo_contour(const kinematics::Chain& chain) {
    std::vector<Axis> axes;
    for (const kinematics::AxisGeometry& axis : chain.axes())
        if (!axis.rotary) axes.push_back(axis.axis);
    return {identity_of(EffectKind::servo_contour),
            "Fast circles come out too small or too large, growing with the square of the feed",
            "limited bandwidth of the position loop, acceleration filters",
            "raise loop gain or feed-forward, or lower the feed on tight curves",
            "position + lag2_s2 * acceleration of the linear axes",
            {{"lag2_s2", "s^2", 1.0e-4, -1, {}, true}},
            [axes](const AxisSample& sample, const emulator::Contact&,
                   std::span<const double> value, kinematics::Perturbation& out) {
                for (const Axis axis : axes) out.axis[axis] += value[0] * sample.acceleration[axis];
            },
            SeenBy::any_encoder};
}

}  // namespace trunnion::effects
