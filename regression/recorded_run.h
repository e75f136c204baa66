// Runs a program on the emulated control alone and keeps what the layers compare.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "controller/controller.h"
#include "setup/setup.h"
#include "regression/path_recorder.h"
#include "regression/program_lines.h"

namespace trunnion {

struct RecordedRun {
    RunResult result;
    PathRecord path;    ///< in the space asked for
    KeyedLines blocks;  ///< one key for each move, dwell and M code: layer `blocks`
    std::string printed;
    std::map<int, double> variables;  ///< common variables in use
    Stores stores;                    ///< as the program left them
};

struct RecordOptions {
    PathSpace space = PathSpace::tip;
    Tolerances tolerances;
    std::vector<std::string> program_folders;  ///< searched before the program's own folder
    std::uint64_t max_blocks = 0;
};

/// Devices are not there: G31 runs to its end. NC alarms are in the result. With `seen_through` the
/// path is where the tip goes when that setup's pivot parameters and tool lengths are the true
/// ones.
RecordedRun record_run(const Setup& setup, const ProgramText& program, const RecordOptions& options,
                       const Setup* seen_through = nullptr);

}  // namespace trunnion
