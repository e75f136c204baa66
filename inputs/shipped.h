// Files that ship with the product.
#pragma once

#include <string>

namespace trunnion::inputs {

/// A folder or file that ships with the product ("machines/bc_table.toml", "programs"). Search
/// order: the folder named by TRUNNION_HOME; the folder of the program and its parents (a build
/// inside the source tree, or share/trunnion of an installation); the folder where this build was
/// installed or built. Throws InputError that lists these folders when it is not found.
std::string shipped(const std::string& relative);

}  // namespace trunnion::inputs
