#include "controller/feed_time.h"

#include <algorithm>
#include <cmath>

namespace trunnion {

double rapid_time(const AxisLimits& limits, const AxisPositions& from, const AxisPositions& to) {
    double longest = 0.0;
    for (std::size_t i = 0; i < axis_count; ++i)
        longest =
            std::max(longest, std::abs(to.value[i] - from.value[i]) * limits.seconds_per_unit[i]);
    return longest;
}

double cutting_time(const ControlState& c, double length_mm, const AxisPositions& from,
                    const AxisPositions& to) {
    double wanted = length_mm * c.feed.seconds_per_mm;
    if (c.feed.seconds_per_mm <= 0.0) {
        if (!c.feed.inverse_time) raise_alarm(11, c.words.column_of('F'));
        if (!c.feed.in_block) raise_alarm(1202);
        if (c.feed.programmed <= 0.0) raise_alarm(11, c.words.column_of('F'));
        wanted = 60.0 / c.feed.programmed;
    }
    return std::max(wanted, rapid_time(c.limits, from, to));
}

double feed_square(const ControlState& c, const ControlPosition& to, std::size_t first) {
    double sum = 0.0;
    for (std::size_t i = first; i < axis_count; ++i) {
        const double d = to.value[i] - c.machine.value[i];
        sum += is_rotary(all_axes[i]) ? d * d * c.unit_mm * c.unit_mm : d * d;
    }
    return sum;
}

double feed_length(const ControlState& c, const ControlPosition& to) {
    return std::sqrt(feed_square(c, to, 0));
}

}  // namespace trunnion
