// Geometric errors of a linear axis along its travel: positioning, straightness, angles,
// squareness.
#include <fmt/format.h>

#include <cmath>

#include "effects/models.h"
#include "effects/polynomials.h"

namespace trunnion::effects {
namespace {

/// No axis is off by more (assumed): beyond, it is another unit or another part.
constexpr double most_scale_ppm = 1e5, most_squareness_rad = 0.2;

/// Sum over n of value[n] (q / reach)^(first + n).
double polynomial(double q, int first, std::span<const double> value) {
    double sum = 0.0, power = first == 1 ? q / reach_mm : q * q / (reach_mm * reach_mm);
    for (const double v : value) {
        sum += v * power;
        power *= q / reach_mm;
    }
    return sum;
}

}  // namespace

Effect linear_scale(const kinematics::AxisGeometry& axis) {
    return {identity_of(axis, EffectKind::scale),
            "The axis moves too far or not far enough, in proportion to the distance",
            "ballscrew lead or scale error, warm screw, wrong pitch compensation",
            "measure with laser or step gauge and correct the pitch compensation",
            "position + scale_ppm 1e-6 q + bow2_mm (q/200)^2 + bow3_mm (q/200)^3",
            {EffectParameter{"scale_ppm", "ppm", 20.0}.up_to(most_scale_ppm),
             {"bow2_mm", "mm", 1e-3, -1, {}, true, false},
             {"bow3_mm", "mm", 0.7e-3, -1, {}, true, false}},
            [k = axis.axis](const AxisSample& sample, const emulator::Contact&,
                            std::span<const double> value, kinematics::Perturbation& out) {
                const double q = sample.position[k];
                out.axis[k] += 1e-6 * value[0] * q + polynomial(q, 2, value.subspan(1, 2));
            }};
}

Effect linear_straightness(const kinematics::AxisGeometry& axis) {
    Effect effect{identity_of(axis, EffectKind::straightness),
                  "The axis runs on a bowed line: it strays sideways along its travel",
                  "guideway wear, bed settling, machine not levelled",
                  "level the machine, check the guideways",
                  "E?L = p1 (q/200) + p2 (q/200)^2 + p3 (q/200)^3 + p4 (q/200)^4, both sideways",
                  {},
                  {}};
    std::vector<int> directions;
    for (int d = 0; d < 3; ++d) {
        if (d == main_direction(axis)) continue;
        directions.push_back(d);
        for (int n = 1; n <= 4; ++n)
            effect.parameters.push_back({fmt::format("{}_p{}_mm", motion_name(d, axis), n),
                                         "mm",
                                         n <= 2 ? 5e-3 : 3e-3,
                                         -1,
                                         {},
                                         true,
                                         n <= 2,
                                         {},
                                         n == 1});
    }
    effect.add = [k = axis.axis, directions](const AxisSample& sample, const emulator::Contact&,
                                             std::span<const double> value,
                                             kinematics::Perturbation& out) {
        for (std::size_t j = 0; j < directions.size(); ++j)
            out.motion[index_of(k)].shift_mm(directions[j]) +=
                polynomial(sample.position[k], 1, value.subspan(4 * j, 4));
    };
    return effect;
}

Effect linear_angular(const kinematics::AxisGeometry& axis) {
    Effect effect{
        identity_of(axis, EffectKind::angular),
        "The axis pitches, yaws and rolls along its travel: errors grow with tool length and "
        "with the travel of the slides that it carries",
        "guideway bow, bed settling, overhang",
        "level the machine; keep tools short; measure with a level or a laser",
        "E?L = p1 (q/200) + p2 (q/200)^2 about X, Y and Z; turns all that the axis carries",
        {},
        {}};
    for (int d = 0; d < 3; ++d)
        for (int n = 1; n <= 2; ++n)
            effect.parameters.push_back({fmt::format("{}_p{}_rad", motion_name(3 + d, axis), n),
                                         "rad",
                                         25e-6 / n,
                                         -1,
                                         {},
                                         true,
                                         n == 1});
    effect.add = [k = axis.axis](const AxisSample& sample, const emulator::Contact&,
                                 std::span<const double> value, kinematics::Perturbation& out) {
        for (std::size_t d = 0; d < 3; ++d)
            out.motion[index_of(k)].tilt_rad(static_cast<int>(d)) +=
                polynomial(sample.position[k], 1, value.subspan(2 * d, 2));
    };
    return effect;
}

Effect squareness(const std::string& plane, const kinematics::AxisGeometry& moving, int about) {
    // The body of a table axis moves against its count: its line is tilted, whichever way it goes.
    const Vector3 along = moving.direction;
    const Vector3 stray = Vector3::Unit(about).cross(along);
    return {{effect_name(plane, EffectKind::squareness), EffectKind::squareness, std::nullopt},
            "Two linear axes are not at right angles",
            "machine not levelled, column or saddle misaligned, a crash",
            "level and realign, or correct it in the control's squareness compensation",
            fmt::format("{} tilted by angle_rad about {}", moving.name, "XYZ"[about]),
            {EffectParameter{"angle_rad", "rad", 40e-6}.up_to(most_squareness_rad)},
            // A whole turn of the line, as a setup's location error: 10 mrad shorten it by 50 ppm.
            [k = moving.axis, along, stray](const AxisSample& sample, const emulator::Contact&,
                                            std::span<const double> value,
                                            kinematics::Perturbation& out) {
                const double shorter = -2.0 * std::pow(std::sin(value[0] / 2.0), 2);
                out.motion[index_of(k)].shift_mm +=
                    sample.position[k] * (std::sin(value[0]) * stray + shorter * along);
            }};
}

}  // namespace trunnion::effects
