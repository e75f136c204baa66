// Runs a program on the emulated control alone and keeps what the layers compare.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "controller/controller.h"
#include "positioning/rotary_transform.h"
#include "regression/machine_functions.h"
#include "regression/opened_programs.h"
#include "regression/path_recorder.h"
#include "regression/program_lines.h"
#include "setup/setup.h"

namespace trunnion::regression {

/// What is in force from a segment on, until the next row.
struct StateRow {
    std::uint64_t first_segment = 0;
    std::uint32_t line = 0;  ///< of the block; 0: before the first
    std::uint16_t program = 0;
    ControlSnapshot state;
};
/// Where the rotary axes stand from a segment on.
struct RotaryRow {
    std::uint64_t first_segment = 0;
    std::array<double, 3> rotary_deg{};
};

struct RecordedRun {
    controller::RunResult result;
    PathRecord path;    ///< in the space asked for
    KeyedLines blocks;  ///< one key for each move and function: layer `blocks`
    FunctionEvents functions;
    SpilledArray<StateRow> states;
    SpilledArray<RotaryRow> rotaries;
    std::vector<OpenedProgram> opened;  ///< subprograms, in the order of their first call
    bool reads_bare_words = false;      ///< axis words without a point, parameter 3401 not given
    bool skips = false;                 ///< G31 moved
    std::string printed;
    std::map<int, double> variables;  ///< common variables in use
    offsets::Stores stores;           ///< as the program left them
};

struct RecordOptions {
    PathSpace space = PathSpace::tip;
    Tolerances tolerances;
    std::vector<std::string> program_folders;  ///< searched before the program's own folder
    std::uint64_t max_blocks = 0;
    std::string call;  ///< a block that calls the program ("G65 P9814 D25.4"); empty: runs itself
    bool devices = false;  ///< the setup's probe and artefacts answer G31
};

/// The kinematics that the setup's control believes in; nothing without parameters.
std::optional<positioning::RotaryTransform> believed_transform(const setup::Setup& setup);

/// The same axes in the same places: the setups are states of one machine's stores.
bool same_machine(const setup::Setup& a, const setup::Setup& b);

/// Without `devices` G31 runs to its end. NC alarms are in the result. With `seen_through` the
/// path is where the tip goes when that setup's pivot parameters and tool lengths are the true
/// ones.
RecordedRun record_run(const setup::Setup& setup, const interpreter::ProgramText& program,
                       const RecordOptions& options, const setup::Setup* seen_through = nullptr);

}  // namespace trunnion::regression
