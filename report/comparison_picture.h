// Both paths of a comparison as figures: three views, and the places that differ from near.
#pragma once

#include <string>

#include "regression/comparison.h"

namespace trunnion::report {

/// From the side, from above and from the front, then the first difference and the worst place
/// magnified where they are small; empty when nothing was drawn. The cuts and what differs near
/// them set the scale; rapids are faint and end at the frame.
std::string pictures_html(const regression::Comparison& comparison);
/// What their colours and marks mean.
constexpr const char* pictures_legend =
    "Grey: cuts of A. Light blue, dashed: cuts of B. Thick orange: what differs in A; thick blue, "
    "dashed: in B. Numbers are those of the list. Ring: the first difference and the place where "
    "both lie farthest apart. Arrow: the tool axis, from the tip to the spindle. Faint: rapids.";

}  // namespace trunnion::report
