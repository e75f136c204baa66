// Polar plots of the single-set-up ballbar procedure.
#pragma once

#include <map>
#include <string>

#include "ballbar/test/ballbar_procedure.h"

namespace trunnion::report {

/// Polar plots by file name: planar ones centred, rotary ones about their mean with the fitted
/// eccentric circle.
std::map<std::string, std::string> ballbar_pictures(const ballbar::test::BallbarResult& result);

}  // namespace trunnion::report
