// Angular errors of a rotary axis: zero offset, positioning, gear error, backlash, wind-up.
#include <cmath>

#include "base/units.h"
#include "effects/models.h"
#include "records/travel.h"

namespace trunnion::effects {
namespace {

bool endless(const kinematics::AxisGeometry& axis) {
    return !axis.min || !axis.max || *axis.max - *axis.min >= 2.0 * pi - 1e-6;
}

}  // namespace

Effect rotary_zero(const kinematics::AxisGeometry& axis) {
    return {
        identity_of(axis, EffectKind::zero),
        "The zero of the axis is not where its table is level or its head upright",
        "encoder replaced, reference mark moved",
        "set the zero: of a table with a level or an indicator, of a head with a test bar",
        "angle + offset_rad",
        {{"offset_rad", "rad", 50e-6, -1, {}, true}},
        [k = axis.axis](const AxisSample&, const emulator::Contact&, std::span<const double> value,
                        kinematics::Perturbation& out) { out.axis[k] += value[0]; }};
}

Effect rotary_positioning(const kinematics::AxisGeometry& axis) {
    Effect effect{identity_of(axis, EffectKind::positioning),
                  "The axis turns a little more or less than commanded, the same every turn",
                  "eccentric encoder, wrong gear ratio, no or stale pitch compensation",
                  "load a compensation table from these values or from an autocollimator",
                  "angle + slope q + sum cosN cos(N q) + sinN sin(N q), N = 1..4",
                  {},
                  {}};
    append_harmonics(effect.parameters, {"", "rad", 4, 25e-6, 2});
    const bool sloped = !endless(axis);
    if (sloped) effect.parameters.push_back({"slope_rad_per_rad", "1", 15e-6, -1, {}, true});
    effect.add = [k = axis.axis, sloped](const AxisSample& sample, const emulator::Contact&,
                                         std::span<const double> value,
                                         kinematics::Perturbation& out) {
        const double q = sample.position[k];
        out.axis[k] += harmonic_sum(q, value.first(8));
        if (sloped) out.axis[k] += value[8] * q;
    };
    return effect;
}

Effect rotary_cyclic(const kinematics::AxisGeometry& axis) {
    std::vector<double> turns;
    for (int n = 10; n <= 360; ++n) turns.push_back(n);
    return {identity_of(axis, EffectKind::cyclic),
            "A ripple of the angle that repeats with every tooth or worm turn",
            "worm or gear error, encoder interpolation",
            "adjust or replace the worm; a direct encoder removes it",
            "angle + cos_rad cos(n q) + sin_rad sin(n q), n = periods_per_turn",
            {{"cos_rad", "rad", 15e-6, -1, {}, true},
             {"sin_rad", "rad", 15e-6, -1, {}, true},
             {.name = "periods_per_turn",
              .unit = "1",
              .typical = 90.0,
              .grid = turns,
              .refine = false,
              .counts_periods = true}},
            [k = axis.axis](const AxisSample& sample, const emulator::Contact&,
                            std::span<const double> value, kinematics::Perturbation& out) {
                const double angle = value[2] * sample.position[k];
                out.axis[k] += value[0] * std::cos(angle) + value[1] * std::sin(angle);
            }};
}

Effect rotary_backlash(const kinematics::AxisGeometry& axis) {
    return {
        identity_of(axis, EffectKind::backlash),
        "The axis stops half the gap beyond the command in the direction of travel (negative: "
        "short)",
        "negative: play behind the motor (worm gear, preload, belt), a drive that lags; positive: "
        "compensation of the backlash set too large",
        "negative: readjust the preload, or add the gap to the backlash compensation (on Fanuc "
        "parameter 1851, assumed); positive: take it off there",
        "angle + gap_rad / 2 * sign of travel",
        {{"gap_rad", "rad", 40e-6, -1, {}, true}},
        [k = axis.axis](const AxisSample& sample, const emulator::Contact&,
                        std::span<const double> value, kinematics::Perturbation& out) {
            out.axis[k] += 0.5 * value[0] * sample.travel[index_of(k)];
        },
        SeenBy::scale};
}

/// As that of a linear axis by its way; the exponential is assumed for both.
Effect rotary_reversal_spike(const kinematics::AxisGeometry& axis) {
    return {
        identity_of(axis, EffectKind::reversal_spike),
        "The axis lags when it turns round, and catches up over some degrees (negative: it falls "
        "behind over these)",
        "friction that winds up the gear, a belt or a long shaft behind the encoder",
        "look for friction in bearing, seal and clamp; stiffen the drive, or read the table itself "
        "with a direct encoder",
        "angle - height_rad * sign of travel * exp(-way / decay_rad); way: the angle since "
        "reversal",
        {{"height_rad", "rad", 40e-6, -1, {}, true},
         {"decay_rad",
          "rad",
          0.1,
          -1,
          {0.001, 0.003, 0.01, 0.03, 0.06, 0.12, 0.25, 0.5, 1.0},
          true}},
        [k = axis.axis](const AxisSample& sample, const emulator::Contact&,
                        std::span<const double> value, kinematics::Perturbation& out) {
            const std::size_t i = index_of(k);
            const double way_rad = sample.since_reversal[i];
            if (way_rad >= records::no_reversal_seen) return;
            out.axis[k] -= value[0] * sample.travel[i] * std::exp(-way_rad / value[1]);
        },
        SeenBy::scale};
}

}  // namespace trunnion::effects
