// Path of the axes commanded by a control for a program: belief only, no devices, no errors.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/alarm.h"
#include "interpreter/program_source.h"
#include "offsets/control_position.h"
#include "setup/setup.h"

namespace trunnion::choices {

/// A point of the path, mm and deg; its segment starts at the previous node. A curve has several.
struct PathNode {
    offsets::ControlPosition at;
    std::uint32_t block = 0;   ///< index into ControlPath::blocks
    bool end = true;           ///< of a move; false: a point along a curve
    double feed_mm_min = 0.0;  ///< 0: of a rapid
};

/// A block with motion.
struct PathBlock {
    std::string program;  ///< empty: the main program
    int line = 0;
};

struct ControlPath {
    std::vector<PathNode> nodes;    ///< [0]: start of the run, of no block
    std::vector<PathBlock> blocks;  ///< [0]: before the first block
    std::optional<Alarm> alarm;     ///< the alarm that ended the run
    bool limited = false;           ///< PathOptions::max_blocks ended the run
};

constexpr int arc_parts = 4;  ///< parts of an arc with PathOptions::arc_points

struct PathOptions {
    AxisPositions start;      ///< mm and rad
    double chord_mm = 1e-4;   ///< maximum distance of chords from curves (at most 512 chords a
                              ///< move, more at a corner)
    bool ends_only = false;   ///< one node a move
    bool arc_points = false;  ///< with ends_only: also three nodes along each arc
    bool moves_only = false;  ///< no nodes are kept: only the end of the run is asked
    std::uint64_t max_blocks = 0;
};

/// Thrown when --max-seconds or Ctrl-C (WaitLimits) ends the work, or PathOptions::max_blocks the
/// program on the control as it is set: a part of a path compares with nothing.
struct PathEnded {
    bool by_blocks = false;
};

/// Runs the program on the setup's control. G31 always reaches its programmed end. Alarms are in
/// the result. Throws PathEnded.
ControlPath path_of(const setup::Setup& setup, const interpreter::ProgramText& program,
                    interpreter::ProgramSource& programs, const PathOptions& options);

}  // namespace trunnion::choices
