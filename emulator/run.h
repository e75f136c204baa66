// Runs an NC program on a setup: control, machine, devices, and what came of it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "base/budget.h"
#include "controller/controller.h"
#include "emulator/compensating_sink.h"
#include "emulator/replay.h"
#include "emulator/trace.h"
#include "setup/setup.h"

namespace trunnion::emulator {

struct RunOptions {
    std::uint64_t seed = 1;
    bool trace = false;
    double trace_step_mm = 0.0;        ///< above 0: SAMPLE rows at this distance along the path
    double trace_chord_mm = 0.0;       ///< above 0: SAMPLE rows that follow curves this closely
    bool truth = false;                ///< physical tip in the trace
    bool automatic_ballbar = false;    ///< the bar reads where it can, without BALLBAR ON
    std::vector<std::string> measure;  ///< words for MeasureStation
    TraceChunk trace_chunk;            ///< receives the trace as it grows; empty: RunLog::trace_csv
    Budget budget;                     ///< used up: the run ends with `limit`
    std::map<int, double> variables;   ///< set before the run
    std::vector<int> wanted_variables;  ///< reported after it; none: all common ones in use
    AxisPositions start;                ///< where the axes stand before the run
    EffectModels effects;
    Compensation compensation;  ///< of the control, when set; readings and trace hold the
                                ///< compensated positions
};

/// What a run did.
struct RunLog {
    controller::RunResult result;
    BudgetLimit limit = BudgetLimit::none;  ///< which one ended the run
    std::string printed;
    records::ReadingTable readings;
    std::string trace_csv;
    std::map<int, double> variables;  ///< NaN: vacant
    offsets::Stores stores;           ///< as the program left them
    std::vector<std::string> notes;
};

/// A program's text or its O number in the source.
using ProgramChoice = std::variant<interpreter::ProgramText, int>;

/// Runs on a copy of the setup. Same inputs and seed: the same log. NC alarms are in the result.
RunLog run_program(const setup::Setup& setup, interpreter::ProgramSource& programs,
                   const ProgramChoice& program, const RunOptions& options);

/// What the control knows of the machine's axes.
controller::ControlConfig control_config(const setup::Setup& setup);

}  // namespace trunnion::emulator
