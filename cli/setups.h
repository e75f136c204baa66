// The setup a command works on.
#pragma once

#include <string>

#include "setup/setup.h"

namespace trunnion::cli {

/// Loads a setup file, backup folder included; an empty path is machines/bc_table.toml. Notes go to
/// stderr.
setup::Setup open_setup(const std::string& path);

}  // namespace trunnion::cli
