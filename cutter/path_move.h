// One move in the plane as it is programmed, and as it leaves cutter compensation.
#pragma once

#include "geometry/plane_path.h"
#include "motion/block_marks.h"
#include "motion/plane_axes.h"
#include "offsets/control_position.h"

namespace trunnion::cutter {

/// One programmed move that waits, with all that it needs when it goes out later.
struct PathMove {
    PlaneElement plane;  ///< in the plane of `axes`, mm
    motion::PlaneAxes axes;
    offsets::ControlPosition to;  ///< program coordinates of the end
    bool rapid = false;
    double offset_mm = 0.0;  ///< tool to the left (+) or right (-) of the path at its end
    bool chamfer = false, round = false;
    double corner_mm = 0.0;
    bool corner_arc = false;   ///< G39 behind it: an arc round its end
    PlanePoint corner_arc_to;  ///< G39 I J K: direction behind the arc; 0 0: that of the next move
    motion::BlockMarks marks;
};

/// A move of the compensated point, a dwell or an M code on its way out.
struct PathOutput {
    PathMove move;     ///< the programmed move that it belongs to
    PlaneElement way;  ///< of the compensated point in the plane
    offsets::ControlPosition from, to;
    double dwell_s = -1.0;    ///< not negative: a dwell
    int m_code = -1;          ///< not negative: an M code
    std::uint64_t block = 0;  ///< counts moves in the plane
    bool beside = false;      ///< beside the contour: start-up and cancel are not
};

/// The mover behind cutter compensation.
class PathReceiver {
  public:
    virtual ~PathReceiver() = default;
    /// Carries out one move, dwell or M code now.
    virtual void take(const PathOutput& out) = 0;
};

}  // namespace trunnion::cutter
