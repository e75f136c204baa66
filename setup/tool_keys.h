// [tools] of a setup file.
#pragma once

#include <string>

#include "base/toml_reader.h"
#include "setup/setup.h"

namespace trunnion::setup {

/// Throws InputError for a number that is no T code and for a length or diameter that is not above
/// 0.
void read_physical_tools(const TomlFile& file, Setup& setup);
std::string physical_tools_text(const PhysicalTools& tools);

}  // namespace trunnion::setup
