// A control on trial: blocks run one after another, nothing moves, the first refusal is told.
#pragma once

#include <memory>
#include <optional>

#include "base/alarm.h"
#include "controller/control_config.h"
#include "interpreter/block_words.h"
#include "offsets/stores.h"

namespace trunnion::controller {

/// Does what a run does with the words of a program without jumps and variables, on stores of its
/// own. Not for blocks whose outcome depends on devices (G31).
class BlockTrial {
  public:
    BlockTrial(ControlConfig config, offsets::Stores stores);
    ~BlockTrial();

    /// The alarm that stops the run at this block, nothing when it is carried out.
    std::optional<Alarm> run(const interpreter::BlockWords& block);
    /// The alarm of the words alone: codes, addresses, digits, the table of word rules.
    std::optional<Alarm> read(const interpreter::BlockWords& block);
    /// What waits for a later block goes out, as at M30.
    std::optional<Alarm> end();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// The alarm of reading (or writing) a variable from #1000 on: 115, 116, or 0. Only such as hold
/// whatever the program did before.
int variable_alarm(int number, bool writes, const ControlConfig& config,
                   const offsets::Stores& stores);

}  // namespace trunnion::controller
