#include "controller/feed_time.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.h"
#include "controller/alarms.h"

namespace trunnion::controller {

motion::AxisLimits axis_limits(const std::vector<ControlAxis>& axes) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    constexpr double default_rapid_mm_s = 400.0, default_rapid_rad_s = pi / 2.0;
    motion::AxisLimits out;
    out.min.fill(-infinity);
    out.max.fill(infinity);
    out.seconds_per_unit.fill(0.0);
    out.per_acceleration.fill(0.0);
    out.per_jump.fill(0.0);
    for (const ControlAxis& axis : axes) {
        const std::size_t i = index_of(axis.axis);
        out.min[i] = axis.min.value_or(-infinity);
        out.max[i] = axis.max.value_or(infinity);
        const double speed =
            axis.rapid_speed.value_or(axis.rotary ? default_rapid_rad_s : default_rapid_mm_s);
        out.seconds_per_unit[i] = speed > 0.0 ? 1.0 / speed : 0.0;
        if (axis.max_acceleration.value_or(0.0) <= 0.0) continue;
        out.per_acceleration[i] = 1.0 / *axis.max_acceleration;
        out.accelerates = true;
    }
    return out;
}

void set_corner_jumps(const ControlSettings& settings, motion::AxisLimits& limits) {
    for (const ControlAxis& axis : settings.axes) {
        const std::size_t i = index_of(axis.axis);
        const double jump = settings.corner_jump[i] / 60.0;
        limits.per_jump[i] = 1.0 / (axis.rotary ? rad_from_deg(jump) : jump);
    }
}

double rapid_time(const motion::AxisLimits& limits, const AxisPositions& from,
                  const AxisPositions& to) {
    double longest = 0.0;
    for (std::size_t i = 0; i < axis_count; ++i)
        longest =
            std::max(longest, std::abs(to.value[i] - from.value[i]) * limits.seconds_per_unit[i]);
    return longest;
}

double commanded_time(const motion::FeedState& feed, double length_mm, int f_column) {
    if (feed.seconds_per_mm > 0.0) return length_mm * feed.seconds_per_mm;
    if (!feed.inverse_time) raise_alarm(11, f_column);
    if (!feed.in_block) raise_alarm(1202);
    if (feed.programmed <= 0.0) raise_alarm(11, f_column);
    return 60.0 / feed.programmed;
}

double feed_square(const offsets::ControlPosition& from, const offsets::ControlPosition& to,
                   double unit_mm, std::size_t first) {
    double sum = 0.0;
    for (std::size_t i = first; i < axis_count; ++i) {
        const double d = to.value[i] - from.value[i];
        sum += is_rotary(all_axes[i]) ? d * d * unit_mm * unit_mm : d * d;
    }
    return sum;
}

}  // namespace trunnion::controller
