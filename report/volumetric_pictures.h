// A volumetric map as printable pictures.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "volumetric/volumetric.h"

namespace trunnion::report {

/// File names and SVG. volumetric_z1.svg, ...: one height each, rotary axes nearest to zero: size
/// of the error as colour, its X and Y components as arrows, its worst place and the cause there.
/// volumetric_axes.svg: largest and rms error as a function of each axis over the whole grid, with
/// the causes.
std::vector<std::pair<std::string, std::string>> volumetric_pictures(
    const volumetric::VolumetricMap& map);

}  // namespace trunnion::report
