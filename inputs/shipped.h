// Files that ship with the product.
#pragma once

#include <string>

namespace trunnion::inputs {

/// A folder or file that ships with the product ("machines/bc_table.toml", "programs"). It is
/// looked for in the folder that TRUNNION_HOME names, then beside the program and its parent
/// folders (a build inside the source tree, or share/trunnion of an installation), then where this
/// build was installed or made. Throws InputError that lists these places when it is nowhere.
std::string shipped(const std::string& relative);

}  // namespace trunnion::inputs
