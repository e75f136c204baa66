// Result of running a program.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/alarm.h"
#include "geometry/axes.h"

namespace trunnion::controller {

enum class RunStatus : unsigned char { ok, alarm, limit };

/// A block with G43.4 or G43.5 that was reached with the table off zero.
struct TurnedStart {
    std::string program;
    int line = 0;
    std::string text;  ///< the programmed point on the table by either `tcp_frame`
};

struct RunResult {
    RunStatus status = RunStatus::ok;
    std::optional<Alarm> alarm;
    std::uint64_t blocks = 0;
    std::uint64_t moves = 0;
    double time_s = 0.0;
    double path_mm = 0.0;
    AxisPositions machine;           ///< final, mm and rad
    AxisPositions work;              ///< final, in the active work frame, mm and rad
    std::vector<std::string> modal;  ///< "G00", "G17", ... one for each modal group, in group order
    bool reads_skip = false;         ///< the program read the skip position (#5061..)
    std::vector<std::string> notes;  ///< unknown M codes, codes accepted without effect, ...
    std::vector<TurnedStart> turned_starts;  ///< one for each block
};

}  // namespace trunnion::controller
