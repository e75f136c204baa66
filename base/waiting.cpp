#include "base/waiting.h"

#include <fmt/format.h>
#include <poll.h>

#include <cerrno>
#include <mutex>
#include <utility>

namespace trunnion::inline base {
namespace {

using Clock = std::chrono::steady_clock;

/// What the living WaitLimits holds.
struct Limits {
    double time_s = 0.0;
    Clock::time_point start;
    std::function<bool()> interrupted;
};

std::mutex& guard() {
    static std::mutex one;
    return one;
}

Limits& living() {
    static Limits one;
    return one;
}

double passed_s(Clock::time_point since) {
    return std::chrono::duration<double>(Clock::now() - since).count();
}

/// Why a wait that began at `start` is over; empty: it is not.
std::string reason_to_end(Clock::time_point start, bool limited) {
    const std::lock_guard lock(guard());
    const Limits& limits = living();
    if (limits.interrupted && limits.interrupted()) return "interrupted";
    const bool over = limits.time_s > 0.0 ? passed_s(limits.start) >= limits.time_s
                                          : limited && passed_s(start) >= Wait::own_limit_s;
    return over ? fmt::format("after {:.3g} s", passed_s(start)) : "";
}

}  // namespace

WaitLimits::WaitLimits(double time_s, std::function<bool()> interrupted) {
    const std::lock_guard lock(guard());
    living() = {time_s, Clock::now(), std::move(interrupted)};
}

WaitLimits::~WaitLimits() {
    const std::lock_guard lock(guard());
    living() = {};
}

bool work_must_end() {
    return !reason_to_end(Clock::now(), false).empty();
}

bool Wait::step(int descriptor, short events, bool limited) {
    constexpr int step_ms = 50;
    pollfd one{descriptor, events, 0};
    ::poll(&one, descriptor < 0 ? 0 : 1, step_ms);  // a failure shows in what is done next
    if (one.revents != 0) return true;
    reason_ = reason_to_end(start_, limited);
    return reason_.empty();
}

short events_now(int descriptor, short events) {
    pollfd one{descriptor, events, 0};
    const int count = ::poll(&one, 1, 0);
    if (count < 0 && errno != EINTR) return events;  // what is done next tells
    return count > 0 ? one.revents : short{0};
}

}  // namespace trunnion::inline base
