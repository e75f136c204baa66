// G68.2 and G68.3 of a Hurco: a plane by rotation angles A B C, or by its X and Y directions.
#pragma once

#include "controller/mover.h"

namespace trunnion::controller {

/// Origin X Y Z in the frame of the work offset. A B C (deg): G68.2 rotates about the fixed axes A,
/// then B, then C, so the frame is Rz(C) Ry(B) Rx(A); G68.3 rotates about the moved axes, Rx(A)
/// Ry(B) Rz(C) (inferred from a post processor; an option exchanges them). I J K and U V W:
/// directions of X and Y, perpendicular within 0.01. No motion. Inside another plane the frame
/// refers to that plane. PS5457 for invalid words, PS5456 inside a plane when planes do not stack.
void set_transform_plane(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                         int code10);

}  // namespace trunnion::controller
