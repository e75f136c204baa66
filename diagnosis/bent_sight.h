// A line of sight that bends, which looks like an error of the last axis (bent_sight.cpp).
#pragma once

#include <vector>

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// Name of a rival: refraction that nobody took off the readings.
inline constexpr const char* refraction = "air.refraction";

/// Stars tell the direction of the line of sight. A tube that droops (chain.flexure) turns it by
/// cos(elevation), the air by cot(elevation): where these two, the set-up and the other causes do
/// what a claim of positioning of the last axis does, to within noise, it is as likely as they at
/// most, and they are its rivals; of a claimed droop the air alone. Only of a mount (rotary axes
/// alone, target on the last one) whose readings are all angles.
void doubt_bent_sight(const Outcome& found, std::vector<Claim>& claims);

/// Says so of the causes that have this rival.
void tell_bent_sight(std::vector<Cause>& causes);

}  // namespace trunnion::diagnosis
