// Figures of the four-function test.
#pragma once

#include <map>
#include <string>

#include "report/pivot_report.h"

namespace trunnion::report {

/// Pictures by file name: distances.svg (distance from the map's mean, measured and expected, as
/// figure 4 of pivot 2021), circles.svg (measured points, circle and its centre, as its figure 5).
std::map<std::string, std::string> pivot_pictures(const PivotResult& result);

}  // namespace trunnion::report
