// Stops between two readings: the moves that determine from which side each axis arrived.
#pragma once

#include <string>
#include <vector>

#include "records/readings.h"

namespace trunnion::records {

/// True for equal positions within the digits of a table of readings.
bool same_place(const AxisPositions& a, const AxisPositions& b);

/// Keeps the moves since the last reading that change the last direction of travel of an axis. Thus
/// a run and the text printed by its program give the same rows.
class Stops {
  public:
    /// A move without a reading ended here. `last`: position of the last row, nullptr before the
    /// first.
    void pass(const Reading& at, const AxisPositions* last);
    bool empty() const { return stops_.empty(); }
    /// The moves before a reading at `end`, as rows without device; a stop at `end` itself is
    /// omitted.
    std::vector<Reading> before(const AxisPositions& end) const;
    void clear() { stops_.clear(); }

  private:
    void prune();

    std::vector<Reading> stops_;
};

}  // namespace trunnion::records
