// Points along the arcs of a trace: from the end of the move before, about the logged centre.
#pragma once

#include <vector>

#include "records/position_log.h"

namespace trunnion::choices {

class LoggedArcs {
  public:
    /// The radii at both ends of the arcs tell how far noise may part the ends of a full circle.
    explicit LoggedArcs(const records::PositionLog& log);

    /// The ends of its first three quarters. `before`: the row before it; nullptr: the log begins
    /// with this arc, at the machine zero if the radii agree. Else its start is not known: empty.
    std::vector<AxisPositions> quarters(const records::LoggedPosition* before,
                                        const records::LoggedPosition& row) const;

  private:
    double closed_mm_ = 0.0;  ///< ends no farther apart are those of a full circle
};

}  // namespace trunnion::choices
