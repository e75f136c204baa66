// What is said of the causes only after all are weighed: that one holds at the measured places
// alone, and that they do less than H says.
#pragma once

#include <optional>
#include <vector>

#include "diagnosis/diagnosis_report.h"
#include "diagnosis/verdict/claims.h"

namespace trunnion::diagnosis {

/// The judgement with causes that do not hold between their places, if there are any:
/// - a ripple that the places do not resolve is the more likely one, or anything else than the
///   ripple that was found: both are the same at the places and differ between them;
/// - a cause that is not claimed and many times the usual size (rules::enormous): the places hardly
///   show it, or other causes take it back there;
/// or with what the causes do of the gap, where that is less than half of H.
std::optional<Judgement> doubted(const Outcome& found, const std::vector<Claim>& claims);

/// Doubts claims of what something else does as well by the physics of the test: the measured
/// surface, a line of sight that bends, one feed, the last digit.
void doubt_look_alikes(const Outcome& found, std::vector<Claim>& claims);
/// Says so of the causes.
void tell_look_alikes(const Outcome& found, std::vector<Cause>& causes);

}  // namespace trunnion::diagnosis
