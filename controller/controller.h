// The emulated control: runs NC programs on its stores and drives a MotionSink. Belief only.
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
/// Called before the first block and after each block.
using BlockWatch = std::function<void(const Control&)>;

class Controller {
  public:
    /// The program changes `stores` (G10, system variables, #500...).
    Controller(ControlConfig config, offsets::Stores& stores, interpreter::ProgramSource& programs,
               motion::MotionSink& sink, interpreter::Interpreter::Print print);
    ~Controller();

    /// Runs a program from its first block to its end, an alarm or a limit. Alarms are returned,
    /// not thrown.
    RunResult run(const interpreter::ProgramText& program);
    RunResult run(int o_number);

    /// Macro variables, before a run (--set) or after it (--vars).
    void set_variable(int number, double value);
    double variable(int number) const;
    std::vector<int> used_common_variables() const;

    /// Observer for callers that compare or explain runs and need the whole state.
    void watch(BlockWatch watch);

    /// Machine position of the axes before the run (default: all zero).
    void place(const AxisPositions& machine);

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace trunnion::controller
