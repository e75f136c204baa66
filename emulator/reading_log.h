// Readings of a run as they come, with the moves between them that tell directions of approach.
#pragma once

#include <deque>
#include <string>

#include "records/readings.h"

namespace trunnion {

class ReadingLog {
  public:
    ReadingLog(std::vector<Axis> axes, std::string test);

    void set_test(std::string test);
    /// A move that nothing reads. Kept only as far as it changes an axis's last direction of
    /// travel.
    void passed(const AxisPositions& to, double time_s, PositioningMode mode);
    /// A reading; numbers it, names its test, writes the kept moves before it as device-less rows.
    void add(Reading row);

    const std::string& test() const { return test_; }
    /// The table, with a column for each quantity that a row sets beside its usual value.
    ReadingTable take();

  private:
    struct Stop {
        AxisPositions at;
        double time_s = 0.0;
        PositioningMode mode = PositioningMode::none;
    };
    void append(Reading row);

    ReadingTable table_;
    std::string test_;
    std::deque<Stop> stops_;  ///< [0] is where the last reading or the test began
};

}  // namespace trunnion
