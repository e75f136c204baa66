// The emulated control: runs NC programs on its stores and drives a MotionSink. BELIEF only.
#pragma once

#include <memory>
#include <vector>

#include "controller/control_config.h"
#include "controller/run_result.h"
#include "interpreter/interpreter.h"
#include "interpreter/program_source.h"
#include "motion/motion.h"
#include "offsets/stores.h"

namespace trunnion::controller {

struct Control;
/// Looks at the control: before the first block and after each one.
using BlockWatch = std::function<void(const Control&)>;

class Controller {
  public:
    /// `stores` is changed by the program (G10, system variables, #500...).
    Controller(ControlConfig config, offsets::Stores& stores, interpreter::ProgramSource& programs,
               motion::MotionSink& sink, interpreter::Interpreter::Print print);
    ~Controller();

    /// Runs a program from its first block to its end, alarm or limit. Alarms do not escape.
    RunResult run(const interpreter::ProgramText& program);
    RunResult run(int o_number);

    /// Macro variables, before a run (--set) or after it (--vars).
    void set_variable(int number, double value);
    double variable(int number) const;
    std::vector<int> used_common_variables() const;

    /// Who looks on; for callers that compare or explain, who read the state in one place.
    void watch(BlockWatch watch);

    /// Machine position the axes stand at before the run (default: all zero).
    void place(const AxisPositions& machine);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trunnion::controller
