// Both paths of a comparison as figures: three views, and close-ups of differences.
#pragma once

#include <string>

#include "regression/comparison.h"

namespace trunnion::report {

/// Side, top and front view, then close-ups of the first and the worst difference if they are
/// small; empty when there is nothing to draw. Cuts and nearby differences determine the scale;
/// rapids are faint and end at the frame.
std::string pictures_html(const regression::Comparison& comparison);
/// Explanation of their colours and marks.
constexpr const char* pictures_legend =
    "Grey: cuts of A. Light blue, dashed: cuts of B. Thick orange: what differs in A; thick blue, "
    "dashed: in B. Numbers are those of the list. Ring: the first difference and the place where "
    "both lie farthest apart. Arrow: the tool axis, from the tip to the spindle. Faint: rapids.";

}  // namespace trunnion::report
