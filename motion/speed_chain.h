// Duration of a chain of moves without stops in between: joined trapezoidal speed profiles.
#pragma once

#include <cstddef>
#include <vector>

namespace trunnion::motion {

/// One move of a chain. The path length may have any unit, the same for the whole chain.
struct SpeedLink {
    double way = 0.0;           ///< path length, above 0
    double speed = 0.0;         ///< maximum speed, way/s
    double acceleration = 0.0;  ///< along the path, way/s^2; infinite without limit
    double entry = 0.0;         ///< maximum speed at its start, way/s; ignored after a stop
};

/// Duration (s) of one link with the given entry and exit speeds (both must be reachable): it
/// accelerates, runs at maximum speed if the path is long enough, and decelerates.
double time_of_link_s(const SpeedLink& link, double entry, double exit);

/// The fastest motion through all links since the last stop: each link within its speed and
/// acceleration, each joint within the entry speed of the following link, at rest at both ends.
/// Updated link by link, like a control with look-ahead that decelerates in time.
class SpeedChain {
  public:
    /// Adds a link. Returns the growth (s) of the chain's duration if it ends here. The
    /// deceleration to rest charged to the previous link is returned as far as it is no longer
    /// needed.
    double add(const SpeedLink& link);
    /// The next link starts from rest.
    void stop();

  private:
    struct Joined {
        SpeedLink link;
        double top;    ///< maximum entry speed allowed by the preceding links
        double entry;  ///< the same, such that the chain can still stop at its end
        double time_s;
    };
    std::size_t slow_down_before(std::size_t last, double& growth_s);
    void forget_settled();

    std::vector<Joined> links_;
    std::size_t settled_ = 0;  ///< the durations of the links before this one are final
    double owed_s_ = 0.0;      ///< time saved at a joint that exceeds the duration of the next link
};

}  // namespace trunnion::motion
