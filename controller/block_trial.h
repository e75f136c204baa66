// Trial execution: blocks run one after another without motion; the first alarm is returned.
#pragma once

#include <memory>
#include <optional>

#include "base/alarm.h"
#include "controller/cautions.h"
#include "controller/control_config.h"
#include "interpreter/block_words.h"
#include "interpreter/evaluate.h"
#include "offsets/stores.h"

namespace trunnion::controller {

/// Processes the words like a run, for a program without jumps, on its own copy of the stores. Not
/// for blocks whose result depends on devices (G31).
class BlockTrial {
  public:
    BlockTrial(ControlConfig config, offsets::Stores stores);
    ~BlockTrial();

    /// The alarm that stops the run at this block; empty when the block is executed.
    std::optional<Alarm> run(const interpreter::BlockWords& block);
    /// The alarm found from the words alone: codes, addresses, digits, table of word rules.
    std::optional<Alarm> read(const interpreter::BlockWords& block);
    /// Executes what waits for a later block, as at M30.
    std::optional<Alarm> end();
    /// Sets a system variable.
    std::optional<Alarm> assign(int number, double value, const std::string& comment);
    /// What the blocks since the last call do that is seldom meant.
    std::vector<ToldCaution> cautions();
    /// How expressions are evaluated in the present state.
    interpreter::EvaluationRules rules() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Alarm number for reading (or writing) a variable from #1000 on: 115, 116, or 0. Only alarms that
/// do not depend on what the program did before.
int variable_alarm(int number, bool writes, const ControlConfig& config,
                   const offsets::Stores& stores);

}  // namespace trunnion::controller
