// Error motions of a rotary axis (radial, axial, tilt) as harmonics of its angle.
#include "effects/models.h"

namespace trunnion::effects {
namespace {

constexpr int orders = 3;
constexpr std::size_t each = 2 * orders;

/// Harmonics in each of `directions` (0..5 = X Y Z A B C, along and about the carrier's axes).
Effect motion_effect(const kinematics::AxisGeometry& axis, Effect effect,
                     std::vector<int> directions, double typical, int usual_orders = 2) {
    for (const int d : directions)
        append_harmonics(effect.parameters, {motion_name(d, axis) + "_", d < 3 ? "mm" : "rad",
                                             orders, typical, usual_orders});
    effect.add = [k = axis.axis, directions](const AxisSample& sample, const emulator::Contact&,
                                             std::span<const double> value,
                                             kinematics::Perturbation& out) {
        SmallMotion& motion = out.motion[index_of(k)];
        for (std::size_t j = 0; j < directions.size(); ++j) {
            const double error = harmonic_sum(sample.position[k], value.subspan(each * j, each));
            const int d = directions[j];
            (d < 3 ? motion.shift_mm(d) : motion.tilt_rad(d - 3)) += error;
        }
    };
    return effect;
}

std::vector<int> across(const kinematics::AxisGeometry& axis, int first) {
    std::vector<int> directions;
    for (int d = 0; d < 3; ++d)
        if (d != main_direction(axis)) directions.push_back(first + d);
    return directions;
}

}  // namespace

Effect rotary_radial(const kinematics::AxisGeometry& axis) {
    return motion_effect(axis,
                         {identity_of(axis, EffectKind::radial),
                          "The axis line wanders sideways as the table turns",
                          "worn or out-of-round bearing, mounting distortion",
                          "check the bearing; map and compensate if it repeats",
                          "E?R = sum cosN cos(N q) + sinN sin(N q), N = 1..3, across the axis",
                          {},
                          {}},
                         across(axis, 0), 3e-3, 3);
}

Effect rotary_axial(const kinematics::AxisGeometry& axis) {
    return motion_effect(axis,
                         {identity_of(axis, EffectKind::axial),
                          "The table rises and falls along its axis as it turns",
                          "axial bearing, table not flat on its flange",
                          "check the axial bearing and its seat",
                          "E?R = sum cosN cos(N q) + sinN sin(N q), N = 1..3, along the axis",
                          {},
                          {}},
                         {main_direction(axis)}, 3e-3);
}

Effect rotary_tilt(const kinematics::AxisGeometry& axis) {
    return motion_effect(axis,
                         {identity_of(axis, EffectKind::tilt),
                          "The table wobbles: the axis line tilts as it turns",
                          "bearing tilt, flange out of square, table bending",
                          "check bearing preload; map and compensate if it repeats",
                          "E?R = sum cosN cos(N q) + sinN sin(N q), N = 1..3, about the cross axes",
                          {},
                          {}},
                         across(axis, 3), 20e-6);
}

}  // namespace trunnion::effects
