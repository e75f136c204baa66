// The setup a command works on.
#pragma once

#include <string>

#include "setup/setup.h"

namespace trunnion::cli {

/// inputs::open_setup, its notes on stderr.
setup::Setup open_setup(const std::string& path);

}  // namespace trunnion::cli
