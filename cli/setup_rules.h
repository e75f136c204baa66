// The rules of one setup's control for `check`.
#pragma once

#include <map>
#include <utility>

#include "check/check.h"
#include "interpreter/interpreter.h"
#include "setup/setup.h"

namespace trunnion::cli {

/// Each variable is looked up once. The setup and this value must outlive the options.
class SetupRules {
  public:
    explicit SetupRules(const setup::Setup& setup);
    check::CheckOptions options();

  private:
    const setup::Setup& setup_;
    interpreter::CodeCalls calls_;
    std::map<std::pair<int, bool>, int> variables_;
};

}  // namespace trunnion::cli
