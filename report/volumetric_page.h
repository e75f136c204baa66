// The page of a volumetric map: worst place, causes, pictures.
#pragma once

#include "report/page.h"
#include "volumetric/volumetric.h"

namespace trunnion::report {

Page volumetric_page(const volumetric::VolumetricMap& map);

}  // namespace trunnion::report
