// One programmed move in the plane, and its output after cutter compensation.
#pragma once

#include "geometry/plane_path.h"
#include "motion/block_marks.h"
#include "motion/plane_axes.h"
#include "offsets/control_position.h"

namespace trunnion::cutter {

/// One buffered move with all data needed when it is sent later.
struct PathMove {
    PlaneElement plane;  ///< in the plane of `axes`, mm
    motion::PlaneAxes axes;
    offsets::ControlPosition to;  ///< program coordinates of the end
    bool rapid = false;
    double offset_mm = 0.0;  ///< tool offset to the left (+) or right (-) of the path at its end
    bool chamfer = false, round = false;
    double corner_mm = 0.0;
    bool corner_arc = false;   ///< G39 follows: an arc round the end
    PlanePoint corner_arc_to;  ///< G39 I J K: direction after the arc; (0, 0): that of the next
                               ///< move
    motion::BlockMarks marks;
};

/// A move of the compensated point, a dwell or an M code to be sent.
struct PathOutput {
    PathMove move;     ///< the programmed move that it belongs to
    PlaneElement way;  ///< path of the compensated point in the plane
    offsets::ControlPosition from, to;
    double dwell_s = -1.0;    ///< >= 0: a dwell
    int m_code = -1;          ///< >= 0: an M code
    std::uint64_t block = 0;  ///< number of the move in the plane
    bool beside = false;      ///< beside the contour; false for start-up and cancel
};

/// The mover that follows cutter compensation.
class PathReceiver {
  public:
    virtual ~PathReceiver() = default;
    /// Carries out one move, dwell or M code immediately.
    virtual void take(const PathOutput& out) = 0;
};

}  // namespace trunnion::cutter
