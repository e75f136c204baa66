#include "motion/dogleg.h"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {

Dogleg::Dogleg(const AxisPositions& from, const AxisPositions& to, const AxisLimits& limits)
    : from_(from), to_(to) {
    std::array<double, axis_count> seconds{};
    double longest_s = 0.0;
    for (std::size_t i = 0; i < axis_count; ++i) {
        seconds[i] = std::abs(to.value[i] - from.value[i]) * limits.seconds_per_unit[i];
        longest_s = std::max(longest_s, seconds[i]);
    }
    for (std::size_t i = 0; i < axis_count; ++i)
        pace_[i] = seconds[i] > 0.0 ? longest_s / seconds[i] : 1.0;
}

AxisPositions Dogleg::at(double s) const {
    AxisPositions out;
    for (std::size_t i = 0; i < axis_count; ++i) {
        const double part = std::min(1.0, s * pace_[i]);
        out.value[i] =
            part < 1.0 ? from_.value[i] + part * (to_.value[i] - from_.value[i]) : to_.value[i];
    }
    return out;
}

bool Dogleg::is_straight() const {
    for (std::size_t i = 0; i < axis_count; ++i)
        if (from_.value[i] != to_.value[i] && pace_[i] > 1.0 + 1e-9) return false;
    return true;
}

}  // namespace trunnion::motion
