// The pivot demonstration as table, JSON and pictures.
#pragma once

#include <map>
#include <string>

#include "pivot/pivot_maps.h"

namespace trunnion {

/// Table of error vectors (largest of each arc) and circle radii, the stores, the verdict.
std::string pivot_table(const PivotDemonstration& demonstration);
/// `{"schema":"trunnion.pivot/1",...}` of formats.md.
std::string pivot_json(const PivotDemonstration& demonstration);
/// Pictures by file name: distances.svg (distance from the map's mean, as figure 4 of pivot 2021),
/// circles.svg (the eccentric circles of each map, as its figure 5).
std::map<std::string, std::string> pivot_pictures(const PivotDemonstration& demonstration);

}  // namespace trunnion
