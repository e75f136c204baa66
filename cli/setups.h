// The setup of a command.
#pragma once

#include <string>
#include <vector>

#include "setup/setup.h"

namespace trunnion::cli {

/// inputs::open_setup, with its notes printed on stderr.
setup::Setup open_setup(const std::string& path);

/// Prints the notes of a setup that was read, and with --verbose what it did not give itself.
void tell_setup(const setup::Setup& setup, const std::vector<std::string>& notes);

}  // namespace trunnion::cli
