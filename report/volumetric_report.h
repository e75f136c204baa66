// A volumetric map as CSV, text and pictures.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/volumetric.h"

namespace trunnion {

/// One row a pose: axis positions, nominal tip in W, error in W (mm), and the cause that
/// contributes most there.
std::string volumetric_csv(const VolumetricMap& map);
/// Worst place, rms, and a table of causes.
std::string volumetric_text(const VolumetricMap& map);
/// File name and SVG: one map of error vectors for each height, rotary axes nearest to zero.
std::vector<std::pair<std::string, std::string>> volumetric_pictures(const VolumetricMap& map);

}  // namespace trunnion
