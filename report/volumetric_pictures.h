// A volumetric map as pictures to print.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "volumetric/volumetric.h"

namespace trunnion::report {

/// File name and SVG. volumetric_z1.svg, ...: one height each, rotary axes nearest to zero: length
/// of the error as colour, its X and Y as arrows, its worst place, and what causes it there.
/// volumetric_axes.svg: worst and rms error against each axis over the whole grid, with the causes.
std::vector<std::pair<std::string, std::string>> volumetric_pictures(
    const volumetric::VolumetricMap& map);

}  // namespace trunnion::report
