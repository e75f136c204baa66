// Runs an NC program on a setup: control, machine, devices, and the result.
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
    double trace_step_mm = 0.0;         ///< > 0: SAMPLE rows at this distance along the path
    double trace_chord_mm = 0.0;        ///< > 0: SAMPLE rows within this distance of curves
    bool truth = false;                 ///< write the physical tip to the trace
    bool automatic_ballbar = false;     ///< the bar reads wherever it can, without BALLBAR ON
    std::vector<std::string> measure;   ///< commands for MeasureStation
    TraceChunk trace_chunk;             ///< receives the trace in pieces; empty: RunLog::trace_csv
    Budget budget;                      ///< when used up, the run ends with `limit`
    std::map<int, double> variables;    ///< set before the run
    std::vector<int> wanted_variables;  ///< reported after the run; empty: all common variables in
                                        ///< use
    AxisPositions start;                ///< axis positions before the run
    EffectModels effects;
    Compensation compensation;  ///< compensation of the control; readings and trace contain the
                                ///< compensated positions
};

/// Result of a run.
struct RunLog {
    controller::RunResult result;
    BudgetLimit limit = BudgetLimit::none;  ///< the limit that ended the run
    std::string printed;
    records::ReadingTable readings;
    std::string trace_csv;
    std::map<int, double> variables;  ///< NaN: vacant
    offsets::Stores stores;           ///< after the program
    std::vector<std::string> notes;
};

/// The text of a program, or its O number in the source.
using ProgramChoice = std::variant<interpreter::ProgramText, int>;

/// Runs on a copy of the setup. Same inputs and seed give the same log. NC alarms are in the
/// result.
RunLog run_program(const setup::Setup& setup, interpreter::ProgramSource& programs,
                   const ProgramChoice& program, const RunOptions& options);

/// "PS0010 IMPROPER G-CODE", as on the control's screen.
std::string title_of(const Alarm& alarm);

/// The control's knowledge of the machine's axes.
controller::ControlConfig control_config(const setup::Setup& setup);

}  // namespace trunnion::emulator
