// Axis positions of a control while it ran a program, from its log.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "geometry/axes.h"
#include "geometry/pose.h"

namespace trunnion::records {

/// Arc of a move, as in a trace.
struct LoggedArc {
    Vector3 centre_mm = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();
    double turns = 0.0;  ///< positive counter-clockwise about the normal
};

struct LoggedPosition {
    AxisPositions at;     ///< machine coordinates, mm and rad
    int block = 0;        ///< line of the program, or N number; 0: not given
    std::string program;  ///< name in the log; empty: not given
    std::optional<LoggedArc> arc;
    bool end = false;       ///< end of a move, not a sample along it
    bool cut = false;       ///< rows are missing behind it: the times say so
    double sigma_mm = 0.0;  ///< standard uncertainty, mm or deg; 0: not given
    int line = 0;           ///< in the log's file
    int repeated = 0;       ///< rows behind it that say the same, and are left out
};

/// Meaning of the numbers in `block`.
enum class BlockColumn : unsigned char { none, line, number };

struct PositionLog {
    std::string path;
    std::vector<Axis> axes;  ///< axes in the log
    bool ends = false;       ///< a row is the end of a move; else a sample along it
    BlockColumn blocks = BlockColumn::none;
    double step = 0.0;  ///< least increment of the printed numbers, mm or deg
    std::vector<LoggedPosition> rows;
    std::vector<std::string> unknown;  ///< names of columns that are not read
};

}  // namespace trunnion::records
