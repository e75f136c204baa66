// What a control may be built or set to do differently from the one of a setup: one table.
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
    std::string what;  ///< what a control with this value does, one sentence without a full stop
    std::function<bool(const setup::Setup&)> holds;  ///< the setup's control does so already
    std::function<void(setup::Setup&)> take;

    std::string name() const { return key + '=' + value; }
};

/// Every row: keys of [control] and [control.hurco], bits of parameters, generations, dialects.
/// Rows that only a Hurco has hold for every other control: there they change nothing.
const std::vector<Choice>& choice_table();

/// The row that "KEY=VALUE" names; nothing where there is none such.
std::optional<Choice> find_choice(const std::string& text);

}  // namespace trunnion::choices
