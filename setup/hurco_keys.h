// [control.hurco]: the choices of a Hurco, and the centrelines of its part set-up.
#pragma once

#include <string>

#include "base/toml_reader.h"
#include "setup/setup.h"

namespace trunnion::setup {

/// Reads the table. `centreline` holds, for each rotary axis of the table, where its line crosses
/// the plane across it: A = { Y = 210, Z = -450 }, C = { X = 330, Y = 205 }; mm, machine
/// coordinates, all axes at zero.
void read_hurco(const TomlFile& file, const TomlValue& table, Setup& setup);
/// The believed axes of the table go through the centrelines. Returns why they cannot, or nothing.
std::string believe_centrelines(const Setup& setup, offsets::Parameters& parameters);
/// The table as it reads again to the same values; nothing when all are the defaults.
std::string hurco_text(const Setup& setup);

}  // namespace trunnion::setup
