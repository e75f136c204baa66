// How long a chain of moves takes that need not stop between them: trapezoids of speed, joined.
#pragma once

#include <cstddef>
#include <vector>

namespace trunnion::motion {

/// One move of a chain. The way may be in any unit, as long as the chain keeps to it.
struct SpeedLink {
    double way = 0.0;           ///< above 0
    double speed = 0.0;         ///< highest, way/s
    double acceleration = 0.0;  ///< along the way, way/s^2; infinity: none is needed
    double entry = 0.0;  ///< highest speed where it begins, way/s; without effect after a stop
};

/// Time (s) of one link that is entered and left with these speeds (both within reach): it speeds
/// up, runs at its highest speed if the way is long enough, and slows down.
double time_of_link_s(const SpeedLink& link, double entry, double exit);

/// The fastest run through all links since the last stop, each within its speed and acceleration,
/// each joint within the entry speed of the link behind it, at rest at both ends. It is kept up
/// to date link by link: a control that reads ahead slows down in time.
class SpeedChain {
  public:
    /// Adds a link and returns by how much (s) the time of the chain grows when it ends here: the
    /// way to the stop that the last link was charged with is taken back as far as none is needed.
    double add(const SpeedLink& link);
    /// The next link begins at rest.
    void stop();

  private:
    struct Joined {
        SpeedLink link;
        double top;    ///< fastest entry, counting what lies before
        double entry;  ///< the same, able to stop at the chain's end
        double time_s;
    };
    std::size_t slow_down_before(std::size_t last, double& growth_s);
    void forget_settled();

    std::vector<Joined> links_;
    std::size_t settled_ = 0;  ///< links before this one keep their times whatever follows
    double owed_s_ = 0.0;      ///< a joint saved more than the link behind it took
};

}  // namespace trunnion::motion
