// The setup that a command or a script works on.
#pragma once

#include <string>
#include <vector>

#include "setup/setup.h"

namespace trunnion::inputs {

/// Loads a setup file, backup folder included; an empty path is machines/bc_table.toml. `notes`:
/// what was derived or is not known, a line each.
setup::Setup open_setup(const std::string& path, std::vector<std::string>& notes);

}  // namespace trunnion::inputs
