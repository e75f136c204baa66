// Waiting for pipes and devices in short steps, so that a limit of time and Ctrl-C end it.
#pragma once

#include <chrono>
#include <functional>
#include <string>

namespace trunnion::inline base {

/// While it lives, waits in this process end with its time and its interruption, and so does work
/// that asks. One at a time.
class WaitLimits {
  public:
    /// `time_s` counts from here; 0: no limit.
    WaitLimits(double time_s, std::function<bool()> interrupted);
    ~WaitLimits();
    WaitLimits(const WaitLimits&) = delete;
    WaitLimits& operator=(const WaitLimits&) = delete;
};

/// True when those limits end work that has no meter of its own.
bool work_must_end();

/// One wait, from its construction.
class Wait {
  public:
    /// Without the time of WaitLimits, a limited wait ends after so many seconds.
    static constexpr double own_limit_s = 5.0;

    /// Waits up to 50 ms, or until the descriptor (-1: none) has one of the `events` of poll. False
    /// when the wait is over; `reason` then says why. `limited`: own_limit_s counts.
    bool step(int descriptor, short events, bool limited);
    /// "after 5 s", or "interrupted".
    const std::string& reason() const { return reason_; }

  private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
    std::string reason_;
};

/// The events of poll that the descriptor has now; all of them where the system cannot say.
short events_now(int descriptor, short events);

}  // namespace trunnion::inline base
