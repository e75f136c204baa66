// [[session]] of a setup file: fitted set-up quantities of one day.
#pragma once

#include <string>

#include "base/toml_reader.h"
#include "setup/setup.h"

namespace trunnion::setup {

void read_sessions(const TomlFile& file, Setup& setup);
/// The inverse: as TOML text.
std::string session_text(const SessionValues& session);

/// The value of "S1.x_mm", "R1.x_mm", "CMM.a_rad", "CMM.scale", "cup.z_mm", "length_mm" or
/// "stylus+60.x_mm"; nullptr for a name that this setup does not have.
double* set_up_number(Setup& setup, const std::string& quantity);

}  // namespace trunnion::setup
