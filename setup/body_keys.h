// [[body]] of a setup file.
#pragma once

#include <string>

#include "base/toml_reader.h"
#include "setup/setup.h"

namespace trunnion::setup {

/// Throws InputError for a size that is not positive, a key of another kind, or a duplicate name.
void read_bodies(const TomlFile& file, Setup& setup);
std::string body_text(const Body& body);

}  // namespace trunnion::setup
