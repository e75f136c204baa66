// Runs a program on the emulated control only and stores the input of the layers.
#pragma once

#include <functional>
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

/// The active state from a segment on, until the next row.
struct StateRow {
    std::uint64_t first_segment = 0;
    std::uint32_t line = 0;  ///< of the block; 0: before the first block
    std::uint16_t program = 0;
    ControlSnapshot state;
};
/// Rotary positions from a segment on.
struct RotaryRow {
    std::uint64_t first_segment = 0;
    std::array<double, 3> rotary_deg{};
};

struct RecordedRun {
    controller::RunResult result;
    PathRecord path;    ///< in the requested space
    KeyedLines blocks;  ///< one key for each move and function: layer `blocks`
    FunctionEvents functions;
    SpilledArray<StateRow> states;
    ControlSnapshot last_state;  ///< after the last block
    SpilledArray<RotaryRow> rotaries;
    std::vector<OpenedProgram> opened;  ///< subprograms, in the order of their first call
    bool reads_bare_words = false;      ///< axis words without point occur and 3401 is not given
    bool skips = false;                 ///< G31 moved an axis
    std::string printed;
    std::map<int, double> variables;  ///< common variables in use
    offsets::Stores stores;           ///< after the program
};

struct RecordOptions {
    PathSpace space = PathSpace::tip;
    Tolerances tolerances;
    std::vector<std::string> program_folders;  ///< searched before the folder of the program
    std::uint64_t max_blocks = 0;
    std::string call;  ///< a block that calls the program ("G65 P9814 D25.4"); empty: runs itself
    bool devices = false;              ///< the setup's probe and artefacts answer G31
    std::function<bool()> go_on = {};  ///< false ends the run as a limit
};

/// The believed kinematics of the setup's control; empty without parameters.
std::optional<positioning::RotaryTransform> believed_transform(const setup::Setup& setup);

/// True for the same axes at the same places: the setups then differ in the stores only.
bool same_machine(const setup::Setup& a, const setup::Setup& b);

/// Without `devices` G31 always reaches its programmed end. NC alarms are in the result. With
/// `seen_through` the path is that of the tip on a machine whose pivot parameters and tool lengths
/// are those of that setup.
RecordedRun record_run(const setup::Setup& setup, const interpreter::ProgramText& program,
                       const RecordOptions& options, const setup::Setup* seen_through = nullptr);

}  // namespace trunnion::regression
