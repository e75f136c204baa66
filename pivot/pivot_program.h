// Writes the NC programs of the four-function test for a machine.
#pragma once

#include <map>
#include <string>

#include "pivot/pivot_plan.h"

namespace trunnion::pivot {

/// Programs by file name: O8001.nc to O8004.nc as far as the machine has the function, and
/// common.nc (O8110-O8150). They call O8100, programs/sphere9.nc. Each finds the sphere at home
/// before every map, prints the stores in force, every found centre, and END.
std::map<std::string, std::string> pivot_programs(const PivotPlan& plan);

}  // namespace trunnion::pivot
