#include "emulator/axis_tracker.h"

#include <cmath>

#include "records/readings.h"

namespace trunnion {

void AxisTracker::advance(const AxisPositions& position) {
    for (std::size_t i = 0; i < axis_count; ++i) {
        const double step = position.value[i] - last_.value[i];
        if (step == 0.0) continue;
        const signed char sign = step > 0.0 ? 1 : -1;
        if (sign != travel_[i]) {
            has_turned_[i] = travel_[i] != 0;
            turned_at_.value[i] = last_.value[i];
            travel_[i] = sign;
        }
        last_.value[i] = position.value[i];
    }
}

void AxisTracker::describe(AxisSample& sample) const {
    sample.travel = travel_;
    for (std::size_t i = 0; i < axis_count; ++i)
        sample.since_reversal[i] = std::abs(last_.value[i] - turned_at_.value[i]) +
                                   (has_turned_[i] ? 0.0 : no_reversal_seen + 1.0);
}

}  // namespace trunnion
