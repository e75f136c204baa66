// A volumetric map as CSV, JSON and text; its pictures are in volumetric_pictures.h.
#pragma once

#include <string>
#include <vector>

#include "base/read_file.h"
#include "volumetric/volumetric.h"

namespace trunnion::report {

/// One row a pose: axis positions, nominal tip in W, error in W (mm), and the cause with the
/// largest contribution.
std::string volumetric_csv(const volumetric::VolumetricMap& map);
/// `{"schema":"trunnion.volumetric/1",...}` of docs/formats.md.
std::string volumetric_json(const volumetric::VolumetricMap& map,
                            const std::vector<FileRead>& inputs = {});
/// Worst place, rms, and a table of causes.
std::string volumetric_text(const volumetric::VolumetricMap& map);

/// The cause with the largest contribution at a point; empty if there is none.
std::string cause_name(const volumetric::VolumetricMap& map,
                       const volumetric::VolumetricPoint& point);
/// "X-200 Y0 B30": mm and deg.
std::string place_text(const AxisNames& names, const std::vector<Axis>& axes,
                       const AxisPositions& q);

}  // namespace trunnion::report
