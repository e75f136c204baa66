// Where a control's axes were while it ran a program, as its log tells.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry/axes.h"
#include "geometry/pose.h"

namespace trunnion::records {

/// Of a move that is an arc, as in a trace.
struct LoggedArc {
    Vector3 centre_mm = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();
    double turns = 0.0;  ///< positive counter-clockwise about the normal
};

struct LoggedPosition {
    AxisPositions at;     ///< machine coordinates, mm and rad
    int block = 0;        ///< line of the program, or N number; 0: not told
    std::string program;  ///< as the log names it; empty: not told
    std::optional<LoggedArc> arc;
    bool end = false;       ///< the end of a move, not a sample along the way
    double sigma_mm = 0.0;  ///< standard uncertainty, mm or deg; 0: not told
    int line = 0;           ///< of the log's file
};

/// What the numbers in `block` are.
enum class BlockColumn : unsigned char { none, line, number };

struct PositionLog {
    std::string path;
    std::vector<Axis> axes;  ///< that the log tells
    bool ends = false;       ///< a row is the end of a move; else a sample along the way
    BlockColumn blocks = BlockColumn::none;
    double step = 0.0;  ///< least increment of the printed numbers, mm or deg
    std::vector<LoggedPosition> rows;
};

}  // namespace trunnion::records
