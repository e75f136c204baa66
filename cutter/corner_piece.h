// Chamfers and corner radii (,C and ,R) between two moves.
#pragma once

#include <optional>

#include "cutter/path_move.h"

namespace trunnion::cutter {

/// Shortens both moves and returns the element between them; empty where the path continues
/// straight. PS0052 when `second` is a rapid, PS0055 when a move is too short.
std::optional<PathMove> take_corner(PathMove& first, PathMove& second);

}  // namespace trunnion::cutter
