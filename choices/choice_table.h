// Possible differences between a control and that of a setup: one table of options and settings.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "setup/setup.h"

namespace trunnion::choices {

/// One value of one choice: "tcp_frame=rotary_zero", "5006#6=1", "dialect=hurco".
struct Choice {
    std::string key, value;
    std::string what;  ///< behaviour of a control with this value, one sentence without a full stop
    std::function<bool(const setup::Setup&)> holds;  ///< true when the setup's control already has
                                                     ///< the value
    std::function<void(setup::Setup&)> take;
    bool rounds = false;  ///< positions, so that it may look like the printing of a log

    std::string name() const { return key + '=' + value; }
};

/// All rows: keys of [control] and [control.hurco], bits of parameters, generations, dialects. Rows
/// for a Hurco only hold for every other control, where they have no effect.
const std::vector<Choice>& choice_table();

/// The row named by "KEY=VALUE"; empty if there is none.
std::optional<Choice> find_choice(const std::string& text);

}  // namespace trunnion::choices
