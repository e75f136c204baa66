// Chamfers and corner radii (,C and ,R) between two sides.
#pragma once

#include <optional>

#include "cutter/path_move.h"

namespace trunnion::cutter {

/// Shortens both sides and returns the piece between them; nothing where the path goes straight on.
/// PS0052 when `second` is a rapid, PS0055 when a side is too short.
std::optional<PathMove> take_corner(PathMove& first, PathMove& second);

}  // namespace trunnion::cutter
