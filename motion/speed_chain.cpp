#include "motion/speed_chain.h"

#include <algorithm>
#include <cmath>

namespace trunnion::motion {

namespace {

/// Speed reachable at one end of a link from `speed` at the other end with full acceleration.
double reach(double speed, const SpeedLink& link) {
    return std::sqrt(speed * speed + 2.0 * link.acceleration * link.way);
}

/// Maximum number of joints in the look-ahead; deceleration for a stop does not start earlier.
constexpr std::size_t most_joints = 512;

}  // namespace

double time_of_link_s(const SpeedLink& link, double entry, double exit) {
    const double v = link.speed, a = link.acceleration;
    const double peak = std::sqrt(a * link.way + 0.5 * (entry * entry + exit * exit));
    if (peak <= v) return (2.0 * peak - entry - exit) / a;
    const double ramps = (2.0 * v * v - entry * entry - exit * exit) / (2.0 * a);
    return (2.0 * v - entry - exit) / a + (link.way - ramps) / v;
}

double SpeedChain::add(const SpeedLink& link) {
    Joined next{link, 0.0, 0.0, 0.0};
    if (!links_.empty()) {
        const Joined& before = links_.back();
        next.top =
            std::min({link.entry, link.speed, before.link.speed, reach(before.top, before.link)});
    }
    next.entry = std::min(next.top, reach(0.0, link));
    next.time_s = time_of_link_s(link, next.entry, 0.0);
    links_.push_back(next);
    double growth_s = next.time_s;
    settled_ = slow_down_before(links_.size() - 1, growth_s);
    forget_settled();
    growth_s += owed_s_;
    owed_s_ = std::min(growth_s, 0.0);
    return std::max(growth_s, 0.0);
}

/// Updates the entry speeds backwards from the last link until they no longer change. Returns the
/// last link that later links cannot change.
std::size_t SpeedChain::slow_down_before(std::size_t last, double& growth_s) {
    std::size_t settled = links_[last].entry == links_[last].top ? last : settled_;
    double exit = links_[last].entry;
    for (std::size_t k = last; k-- > settled_;) {
        Joined& joined = links_[k];
        const double braking = reach(exit, joined.link);
        const double entry = std::min(joined.top, braking);
        const double time_s = braking < joined.top  // decelerates over the whole link
                                  ? (entry - exit) / joined.link.acceleration
                                  : time_of_link_s(joined.link, entry, exit);
        growth_s += time_s - joined.time_s;
        joined.time_s = time_s;
        const bool as_before = entry == joined.entry;
        joined.entry = exit = entry;
        if (entry == joined.top) settled = std::max(settled, k);
        if (as_before) break;
    }
    return settled;
}

void SpeedChain::forget_settled() {
    if (links_.size() - settled_ > most_joints) settled_ = links_.size() - most_joints;
    if (settled_ < most_joints) return;
    links_.erase(links_.begin(), links_.begin() + static_cast<std::ptrdiff_t>(settled_));
    settled_ = 0;
}

void SpeedChain::stop() {
    links_.clear();
    settled_ = 0;
    owed_s_ = 0.0;
}

}  // namespace trunnion::motion
