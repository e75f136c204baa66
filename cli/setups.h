// The setup of a command.
#pragma once

#include <string>

#include "setup/setup.h"

namespace trunnion::cli {

/// inputs::open_setup, with its notes printed on stderr.
setup::Setup open_setup(const std::string& path);

}  // namespace trunnion::cli
