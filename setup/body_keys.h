// [[body]] of a setup file.
#pragma once

#include <string>

#include "base/toml_reader.h"
#include "setup/setup.h"

namespace trunnion::setup {

/// Throws InputError for a size that is not above 0, a key of another kind, a name used twice.
void read_bodies(const TomlFile& file, Setup& setup);
std::string body_text(const Body& body);

}  // namespace trunnion::setup
