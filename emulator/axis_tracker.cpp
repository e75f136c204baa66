#include "emulator/axis_tracker.h"

#include <algorithm>
#include <cmath>

#include "geometry/units.h"
#include "motion/tool_centre_point.h"
#include "records/readings.h"

namespace trunnion {

void AxisTracker::advance(const AxisPositions& position) {
    for (std::size_t i = 0; i < axis_count; ++i) {
        const double step = position.value[i] - last_.value[i];
        if (std::abs(step) < standing) continue;
        const signed char sign = step > 0.0 ? 1 : -1;
        if (sign != travel_[i]) {
            has_turned_[i] = travel_[i] != 0;
            turned_at_.value[i] = last_.value[i];
            travel_[i] = sign;
        }
        last_.value[i] = position.value[i];
    }
}

void AxisTracker::follow(const AxisMove& move) {
    constexpr double step_rad = pi / 8.0, last_step = 1e-3;
    const int steps =
        move.arc
            ? std::max(2, static_cast<int>(std::ceil(std::abs(move.arc->sweep_rad) / step_rad)))
        : move.curve ? 4 * curve_parts(move.from, move.to)
                     : 1;
    const bool hardly_turns = steps == 1 || (move.curve && steps == 4);  // the hot path of G43.4
    if (!hardly_turns) {
        for (int i = 1; i < steps; ++i) advance(move.at(static_cast<double>(i) / steps));
        advance(move.at(1.0 - last_step));
    }
    advance(move.to);
}

void AxisTracker::describe(AxisSample& sample) const {
    sample.travel = travel_;
    for (std::size_t i = 0; i < axis_count; ++i)
        sample.since_reversal[i] = std::abs(last_.value[i] - turned_at_.value[i]) +
                                   (has_turned_[i] ? 0.0 : no_reversal_seen + 1.0);
}

}  // namespace trunnion
