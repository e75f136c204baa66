// [control.hurco]: options of a Hurco, and the centrelines of its part set-up.
#pragma once

#include <string>

#include "base/toml_reader.h"
#include "setup/setup.h"

namespace trunnion::setup {

/// Reads the table. `centreline` gives, for each rotary table axis, the intersection of its line
/// with the plane perpendicular to it: A = { Y = 210, Z = -450 }, C = { X = 330, Y = 205 }; mm,
/// machine coordinates, all axes at zero.
void read_hurco(const TomlFile& file, const TomlValue& table, Setup& setup);
/// Makes the believed table axes pass through the centrelines. Returns the reason if impossible,
/// else an empty text.
std::string believe_centrelines(const Setup& setup, offsets::Parameters& parameters);
/// The table as text that reads back to the same values; empty when all are defaults.
std::string hurco_text(const Setup& setup);

}  // namespace trunnion::setup
