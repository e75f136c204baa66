// Generates the NC programs of the four-function test for a machine.
#pragma once

#include <map>
#include <string>

#include "pivot/pivot_plan.h"

namespace trunnion::pivot {

/// Programs by file name: O8001.nc to O8004.nc for the functions of the machine, and common.nc
/// (O8110-O8150). They call O8100, programs/sphere9.nc. Each measures the sphere at home before
/// every map and prints the active stores, every measured centre, and END.
std::map<std::string, std::string> pivot_programs(const PivotPlan& plan);

}  // namespace trunnion::pivot
