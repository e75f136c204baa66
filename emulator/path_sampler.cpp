#include "emulator/path_sampler.h"

#include <algorithm>
#include <cmath>

namespace trunnion::emulator {
namespace {

constexpr double half_step = 1e-3;  ///< step of s for central differences

/// Positioning and G31 start and end at rest; exact stops (G9, G61) end at rest.
bool at_rest(const motion::AxisMove& move, double s) {
    const bool stops = move.kind == motion::MotionKind::rapid || move.until_skip;
    return (stops && s <= 0.0) || ((stops || !move.gap_free) && s >= 1.0);
}

/// Second difference of the commanded path, mm/s^2 and rad/s^2; 0 for moves of zero duration.
AxisPositions acceleration(const motion::AxisMove& move, double s) {
    AxisPositions out;
    const double step_s = half_step * move.duration_s;
    if (!(step_s > 0.0) || (!move.arc && !move.curve)) return out;
    const double middle = std::clamp(s, half_step, 1.0 - half_step);
    const AxisPositions a = move.at(middle - half_step), m = move.at(middle),
                        b = move.at(middle + half_step);
    for (std::size_t i = 0; i < axis_count; ++i)
        out.value[i] = (a.value[i] - 2.0 * m.value[i] + b.value[i]) / (step_s * step_s);
    return out;
}

}  // namespace

AxisSample PathSampler::at(double s) const {
    AxisSample sample;
    sample.position = move.at(s);
    sample.time_s = time_s(s);
    sample.feed_mm_min = move.feed_mm_min;
    sample.mode = mode;
    sample.spindle_rad = shop.spindle_rad;
    sample.spindle_turns = move.spindle_rpm != 0.0;
    sample.temperature_c = shop.temperature_c;
    sample.load_kg = shop.load_kg;
    sample.clamped = shop.clamped;
    history.describe(sample);
    const auto last_travel = sample.travel;
    const double before = std::max(0.0, s - half_step), after = std::min(1.0, s + half_step);
    const AxisPositions a = move.at(before), b = move.at(after);
    const double span_s = at_rest(move, s) ? 0.0 : (after - before) * move.duration_s;
    const bool straight = !move.arc && !move.curve;
    for (std::size_t i = 0; i < axis_count; ++i) {
        const double moved = b.value[i] - a.value[i];
        const double way = straight ? move.to.value[i] - move.from.value[i] : moved;
        if (std::abs(way) < records::path_rounding.mm) continue;
        const signed char sign = way > 0.0 ? 1 : -1;
        if (sign != last_travel[i])
            sample.since_reversal[i] =
                std::abs(sample.position.value[i] - history.position().value[i]);
        sample.travel[i] = sign;
        if (span_s > 0.0) sample.velocity.value[i] = moved / span_s;
    }
    if (span_s > 0.0) sample.acceleration = acceleration(move, s);
    return sample;
}

}  // namespace trunnion::emulator
