// Where the axes stood between two readings: the moves that tell from which side each axis came.
#pragma once

#include <string>
#include <vector>

#include "records/readings.h"

namespace trunnion::records {

/// The same place within the digits of a table of readings.
bool same_place(const AxisPositions& a, const AxisPositions& b);

/// Keeps of the moves since the last reading what changes an axis's last direction of travel. A run
/// and the text that its program prints come to the same rows by it.
class Stops {
  public:
    /// A move without a reading ended here. `last`: the last row's place, nullptr before the first.
    void pass(const Reading& at, const AxisPositions* last);
    bool empty() const { return stops_.empty(); }
    /// The moves before a reading at `end`, as device-less rows; a stop at `end` itself is none.
    std::vector<Reading> before(const AxisPositions& end) const;
    void clear() { stops_.clear(); }

  private:
    void prune();

    std::vector<Reading> stops_;
};

}  // namespace trunnion::records
