// Cuts and rapids shorter than the position tolerance are rounding, not machining.
#pragma once

#include <vector>

#include "regression/path_record.h"

namespace trunnion::regression {

/// A filter in front of a PathRecord. A run of cuts between rapids, or of rapids between cuts, not
/// longer than `noise_mm` is merged into the following part; at the end of the program into the
/// previous part.
class ShortRuns {
  public:
    ShortRuns(PathRecord& record, double noise_mm) : record_(record), noise_mm_(noise_mm) {}
    void add(const Segment& segment);
    void finish();

  private:
    void write(const Segment& segment);
    void write_held_as(const Segment& like);
    void write_held();

    PathRecord& record_;
    double noise_mm_;
    std::vector<Segment> held_;
    double held_mm_ = 0.0;
    PathPoint end_;  ///< end of all input segments
    Segment last_;   ///< last segment written
};

}  // namespace trunnion::regression
