// Even orders of the lag at one feed, which are scales (one_feed.cpp).
#pragma once

#include <vector>

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// On circles at one feed the acceleration of an axis goes with its position, so that
/// `servo.contour` and the scales of the axes have the same columns. One effect of several columns
/// has the prior of one scale, not of all: where the scales do its work, to within noise, it is as
/// likely as they at most, and they are its rivals. Another feed tells them apart.
void doubt_contour_at_one_feed(const Outcome& found, std::vector<Claim>& claims);

/// Says so of a cause that has these rivals.
void tell_one_feed(std::vector<Cause>& causes);

}  // namespace trunnion::diagnosis
