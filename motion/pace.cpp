#include "motion/pace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motion/path_rates.h"

namespace trunnion::motion {

namespace {

AxisPositions scaled(const AxisPositions& rate, double factor) {
    AxisPositions out;
    for (std::size_t i = 0; i < axis_count; ++i) out.value[i] = factor * rate.value[i];
    return out;
}

}  // namespace

/// Path speed, mm/s, at which no axis exceeds its allowed speed change at the corner.
double Pace::corner_speed(const AxisPositions& begin, const AxisLimits& limits) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < axis_count; ++i)
        worst = std::max(worst, std::abs(begin.value[i] - end_rate_.value[i]) * limits.per_jump[i]);
    return 1.0 / worst;  // infinite on a straight continuation
}

double Pace::take(AxisMove& move, const AxisLimits& limits, double way) {
    if (!limits.accelerates && !move.arc && !move.curve) return move.duration_s;
    const PathRates rates = path_rates(move, limits);
    const double cruise_s = std::max(move.duration_s, rates.least_s);
    move.duration_s = cruise_s;
    if (rates.least_acceleration <= 0.0) {
        chain_.stop();
        return cruise_s;
    }
    const bool alone = move.kind == MotionKind::rapid || move.until_skip || way <= 0.0;
    if (alone) chain_.stop();
    if (way <= 0.0) way = 1.0;
    SpeedLink link;
    link.way = way;
    const double even_s = std::max(cruise_s, rates.least_bend_s);
    link.speed = even_s > 0.0 ? way / even_s : std::numeric_limits<double>::infinity();
    link.acceleration = way / rates.least_acceleration;
    link.entry = corner_speed(scaled(rates.start, 1.0 / way), limits);
    move.duration_s = chain_.add(link);
    end_rate_ = scaled(rates.end, 1.0 / way);
    if (alone || !move.gap_free) chain_.stop();
    return cruise_s;
}

}  // namespace trunnion::motion
