// The setup of a command or a script.
#pragma once

#include <string>
#include <vector>

#include "setup/setup.h"

namespace trunnion::inputs {

/// Loads a setup file including its backup folder; an empty path means machines/bc_table.toml.
/// `notes`: derived values and unknown keys, one line each.
setup::Setup open_setup(const std::string& path, std::vector<std::string>& notes);

}  // namespace trunnion::inputs
