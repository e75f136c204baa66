// Errors of the drive of a linear axis: ballscrew ripple, backlash, reversal spike, lateral play.
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "effects/models.h"
#include "records/travel.h"

namespace trunnion::effects {

std::vector<double> ripple_periods_mm(double range_mm) {
    constexpr double least_mm = 4.0, most_mm = 50.0, long_mm = 200.0, finest = 1.0 / 200.0;
    constexpr double stands_mm = 1e-3;
    if (range_mm < stands_mm || range_mm >= long_mm) return geometric_grid(least_mm, most_mm, 180);
    const double part = range_mm / long_mm;
    const double low_mm = std::max(least_mm * part * part, finest * range_mm);
    const double high_mm = std::min(most_mm, 0.5 * range_mm);
    // Between two of them lies an eighth of a cycle at the ends: at few places a rough period loses
    // against chance.
    const double step = 0.25 / range_mm;  // cycles per mm
    const auto count = static_cast<int>(std::ceil((1.0 / low_mm - 1.0 / high_mm) / step));
    std::vector<double> grid_mm;
    for (int k = count; k >= 0; --k) grid_mm.push_back(1.0 / (1.0 / high_mm + k * step));
    return grid_mm;
}

Effect linear_cyclic(const kinematics::AxisGeometry& axis) {
    return {identity_of(axis, EffectKind::cyclic),
            "A ripple of the position that repeats with every turn of the ballscrew",
            "ballscrew eccentricity, coupling, encoder interpolation",
            "check coupling and screw bearing; a linear scale removes it",
            "position + cos_mm cos(2 pi q / p) + sin_mm sin(2 pi q / p), p = period_mm",
            {{"cos_mm", "mm", 2e-3, -1, {}, true},
             {"sin_mm", "mm", 2e-3, -1, {}, true},
             {"period_mm", "mm", 10.0, -1, ripple_periods_mm(0.0), true}},
            [k = axis.axis](const AxisSample& sample, const emulator::Contact&,
                            std::span<const double> value, kinematics::Perturbation& out) {
                const double angle = 2.0 * pi * sample.position[k] / value[2];
                out.axis[k] += value[0] * std::cos(angle) + value[1] * std::sin(angle);
            }};
}

Effect linear_backlash(const kinematics::AxisGeometry& axis) {
    return {
        identity_of(axis, EffectKind::backlash),
        "The axis stops half the gap beyond the command in the direction of travel (negative: "
        "short)",
        "negative: play behind the motor (nut, thrust bearing, belt), a drive that lags; positive: "
        "compensation of the backlash set too large",
        "readjust nut and bearing, or correct backlash compensation (on Fanuc parameter 1851, "
        "assumed)",
        "position + gap_mm / 2 * sign of travel (cancels in a found sphere centre)",
        {{"gap_mm", "mm", 5e-3, -1, {}, true}},
        [k = axis.axis](const AxisSample& sample, const emulator::Contact&,
                        std::span<const double> value, kinematics::Perturbation& out) {
            out.axis[k] += 0.5 * value[0] * sample.travel[index_of(k)];
        },
        SeenBy::scale};
}

namespace {

constexpr double law_radius_mm = 100.0;  ///< an angle of the path is expressed as distance on this
                                         ///< circle
constexpr double law_speed_mm_s = 10.0;  ///< a time is expressed as distance at this speed
constexpr double long_ago_mm = 1e6;      ///< axis at rest: anything that decays has vanished

/// True between moves, where a laser is read: there is no path that turns.
bool is_at_rest(const AxisSample& sample) {
    return sample.velocity[Axis::X] == 0.0 && sample.velocity[Axis::Y] == 0.0 &&
           sample.velocity[Axis::Z] == 0.0;
}

/// Angle (rad) by which the path direction has turned since the axis was at rest.
double angle_since_quadrant(Axis axis, const AxisSample& sample) {
    const Vector3 v(sample.velocity[Axis::X], sample.velocity[Axis::Y], sample.velocity[Axis::Z]);
    const double along = std::abs(sample.velocity[axis]);
    if (along == 0.0) return 0.0;
    const double angle = std::asin(std::min(1.0, along / v.norm()));
    const bool slows = sample.acceleration[axis] * sample.travel[index_of(axis)] < 0.0;
    return slows ? pi - angle : angle;
}

/// Time (s) since the axis started to move, from distance and speed at constant acceleration. On a
/// circle it gives 2 tan(phi / 2) instead of phi, i.e. 2 % too much after half a radian.
double time_since_reversal(double way_mm, double speed_mm_s) {
    return 2.0 * way_mm / speed_mm_s;
}

/// Argument of the decay, mm, by law 0 (angle of the path), 1 (distance) or 2 (time).
double way_of(double law, Axis axis, const AxisSample& sample) {
    const double since_mm = sample.since_reversal[index_of(axis)];
    if (law == 1.0) return since_mm;
    if (is_at_rest(sample)) return long_ago_mm;
    if (law == 0.0) return law_radius_mm * angle_since_quadrant(axis, sample);
    const double speed_mm_s = std::abs(sample.velocity[axis]);
    return speed_mm_s > 0.0 ? law_speed_mm_s * time_since_reversal(since_mm, speed_mm_s)
                            : long_ago_mm;
}

}  // namespace

Effect linear_reversal_spike(const kinematics::AxisGeometry& axis) {
    return {
        identity_of(axis, EffectKind::reversal_spike),
        "The axis sticks for a moment when it turns round, then catches up",
        "friction at standstill with a soft or slow velocity loop",
        "raise the loop gain or switch on friction (quadrant) compensation",
        "position - height_mm * sign of travel * exp(-way / decay_mm); way: law 1 the distance "
        "since reversal, law 0 the angle of the path since the quadrant times 100 mm, law 2 the "
        "time since reversal times 10 mm/s; run_up 0: a circle begun at the quadrant was not "
        "reached through it",
        {{"height_mm", "mm", 6e-3, -1, {}, true},
         {"decay_mm",
          "mm",
          1.0,
          -1,
          {0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.2, 2.0, 3.5, 6.0, 10.0, 16.0},
          true},
         {"law", "1", 1.0, -1, {0.0, 1.0, 2.0}, false},
         {"run_up", "1", 1.0, -1, {0.0, 1.0}, false}},
        [k = axis.axis](const AxisSample& sample, const emulator::Contact& contact,
                        std::span<const double> value, kinematics::Perturbation& out) {
            const std::size_t i = index_of(k);
            const bool not_turned = sample.since_reversal[i] >= records::no_reversal_seen ||
                                    (value[3] == 0.0 && sample.run_up_unknown[i]);
            if (is_probe(contact) || not_turned) return;
            const double way_mm = way_of(value[2], k, sample);
            out.axis[k] -= value[0] * sample.travel[i] * std::exp(-way_mm / value[1]);
        },
        SeenBy::any_encoder};
}

Effect linear_lateral_play(const kinematics::AxisGeometry& axis) {
    std::vector<int> directions;
    Effect effect{identity_of(axis, EffectKind::lateral_play),
                  "The slide steps sideways when the axis changes direction",
                  "guideway clearance, worn gibs or carriages",
                  "readjust gibs or preload of the guideway",
                  "E?L = play / 2 * sign of travel, sideways",
                  {},
                  {}};
    for (int d = 0; d < 3; ++d) {
        if (d == main_direction(axis)) continue;
        directions.push_back(d);
        effect.parameters.push_back(
            {std::string("play_") + "xyz"[d] + "_mm", "mm", 4e-3, -1, {}, true});
    }
    effect.add = [k = axis.axis, directions](const AxisSample& sample, const emulator::Contact&,
                                             std::span<const double> value,
                                             kinematics::Perturbation& out) {
        const std::size_t i = index_of(k);
        for (std::size_t j = 0; j < directions.size(); ++j)
            out.motion[i].shift_mm(directions[j]) += 0.5 * value[j] * sample.travel[i];
    };
    return effect;
}

}  // namespace trunnion::effects
