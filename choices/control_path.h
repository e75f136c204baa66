// Where a control takes the axes in a program: BELIEF only, no devices, no errors.
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

/// A point of the path, mm and deg; the way to it begins at the node before. A curve has several.
struct PathNode {
    offsets::ControlPosition at;
    std::uint32_t block = 0;  ///< index into ControlPath::blocks
};

/// A block that moved.
struct PathBlock {
    std::string program;  ///< empty: the main program
    int line = 0;
};

struct ControlPath {
    std::vector<PathNode> nodes;    ///< [0]: where the run began, of no block
    std::vector<PathBlock> blocks;  ///< [0]: before the first
    std::optional<Alarm> alarm;     ///< ended the run
};

constexpr int arc_parts = 4;  ///< of an arc with PathOptions::arc_points

struct PathOptions {
    AxisPositions start;      ///< mm and rad
    double chord_mm = 1e-4;   ///< curves become chords this close (at most 512 a move)
    bool ends_only = false;   ///< one node a move
    bool arc_points = false;  ///< with ends_only: three nodes along each arc too
    std::uint64_t max_blocks = 0;
};

/// Runs the program on the setup's control. G31 goes to its end. Alarms are in the result.
ControlPath path_of(const setup::Setup& setup, const interpreter::ProgramText& program,
                    interpreter::ProgramSource& programs, const PathOptions& options);

}  // namespace trunnion::choices
