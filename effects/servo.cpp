// Dynamic errors of the drives: the response of each position loop to its commanded motion, order
// by order. A loop of first order with the time constant T lags by T, T^2 and T^3 (the error
// coefficients of control engineering); one of second order has others. Odd orders are a delay,
// even ones make circles smaller or larger. With the time constant of the drive in the setup the
// derivatives are those of the motion behind low-passes (records/smoothed_motion.h): the orders
// stay what they are, and the response is that of a loop at any speed. Without it they are a
// series, true while the motion changes little within the delay.
#include <cmath>

#include "effects/models.h"

namespace trunnion::effects {
namespace {

/// A position loop of 60 /s (1 m/min at an error of 0.28 mm) lags by 17 ms, one with feed-forward
/// by a tenth of it or less; that axes differ by a quarter of a millisecond is usual (assumed).
constexpr double usual_lag_s = 10e-3, usual_mismatch_s = 0.25e-3;

/// A loop that cuts does not lag by more (assumed); in a log of positions any drive may. At one
/// feed an even order is a scale: without a limit the two cancel each other at any size, and what
/// they leave at the ends of a pass explains rows that the machine read at rest.
constexpr double most_lag_s = 0.1;

/// Of the lag of this order, in s to its power.
EffectParameter lag(const char* unit_suffix, const char* unit, double typical, int order,
                    bool logged) {
    EffectParameter p{unit_suffix, unit, typical};
    return logged ? p : std::move(p).up_to(std::pow(most_lag_s, order));
}

/// One of each axis, alike but for the name.
void add_parameters(Effect& effect, const kinematics::Chain& chain, const char* before,
                    const EffectParameter& like) {
    for (const kinematics::AxisGeometry& axis : chain.axes()) {
        effect.parameters.push_back(like);
        effect.parameters.back().name = axis_parameter(before, axis, like.name.c_str());
        if (axis.rotary) effect.parameters.back().also_set_by.clear();
    }
}

std::vector<Axis> axes_of(const kinematics::Chain& chain) {
    std::vector<Axis> axes;
    for (const kinematics::AxisGeometry& axis : chain.axes()) axes.push_back(axis.axis);
    return axes;
}

}  // namespace

Effect servo_mismatch(const kinematics::Chain& chain, bool logged) {
    const bool single = chain.axes().size() == 1;  // nothing to be unlike
    Effect effect{
        identity_of(EffectKind::servo_mismatch),
        single ? "The axis follows its command with a delay"
               : "Axes follow with a delay; different delays make circles ovals at 45 degrees",
        single ? "gain of the position loop, no feed-forward; negative: commanded and "
                 "actual positions exchanged, or the sign of the error"
               : "different position-loop gains or feed-forward between axes; negative in "
                 "a servo log: commanded and actual positions exchanged, or the sign of "
                 "the error",
        single ? "raise the loop gain, or switch on the feed-forward"
               : "set the loop gains of all interpolating axes alike",
        "position - tau_s * velocity - lag3_s3 * jerk, each axis its own; of the motion behind "
        "time_constant_s of the axis, if the setup tells it",
        {},
        {},
        SeenBy::any_encoder};
    add_parameters(effect, chain, "tau_",
                   lag("_s", "s", logged ? usual_lag_s : usual_mismatch_s, 1, logged));
    add_parameters(effect, chain, "lag3_", lag("_s3", "s^3", 1.0e-6, 3, logged));
    effect.add = [axes = axes_of(chain)](const AxisSample& sample, const emulator::Contact&,
                                         std::span<const double> value,
                                         kinematics::Perturbation& out) {
        for (std::size_t j = 0; j < axes.size(); ++j) {
            const Axis axis = axes[j];
            out.axis[axis] -=
                value[j] * (sample.velocity[axis] + sample.smooth_velocity[axis]) +
                value[axes.size() + j] * (sample.jerk[axis] + sample.smooth_jerk[axis]);
        }
    };
    return effect;
}

Effect servo_contour(const kinematics::Chain& chain, bool logged) {
    Effect effect{
        identity_of(EffectKind::servo_contour),
        "Fast circles come out too small or too large, growing with the square of the feed",
        "limited bandwidth of the position loop, acceleration filters",
        "raise loop gain or feed-forward, or lower the feed on tight curves",
        "position + lag2_s2 * acceleration, each axis its own; lag2_s2 without an axis is that of "
        "all linear axes; of the motion behind time_constant_s of the axis, if the setup tells it",
        {},
        {},
        SeenBy::any_encoder};
    EffectParameter second = lag("_s2", "s^2", 1.0e-4, 2, logged);
    second.also_set_by = "lag2_s2";
    add_parameters(effect, chain, "lag2_", second);
    effect.add = [axes = axes_of(chain)](const AxisSample& sample, const emulator::Contact&,
                                         std::span<const double> value,
                                         kinematics::Perturbation& out) {
        for (std::size_t j = 0; j < axes.size(); ++j)
            out.axis[axes[j]] +=
                value[j] * (sample.acceleration[axes[j]] + sample.smooth_acceleration[axes[j]]);
    };
    return effect;
}

}  // namespace trunnion::effects
