// The number of the alarm that an action ends in.
#pragma once

#include "base/alarm.h"

namespace trunnion {

/// 0: it ended without one.
template <class Action>
int alarm_of(Action action) {
    try {
        action();
    } catch (const Alarm& alarm) {
        return alarm.number;
    }
    return 0;
}

}  // namespace trunnion
