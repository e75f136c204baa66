// Picture of a positioning test by ISO 230-2: deviations, means, +-2 s bands, and B, M, E, R, A.
#pragma once

#include <string>

#include "records/iso230_2.h"

namespace trunnion::report {

/// One axis: `title` ("X"), its deviations, and whether they are angles (then deg and arcsec, else
/// mm and um). Parameters that the points do not determine are omitted.
std::string iso230_2_picture(const std::string& title,
                             const std::vector<records::DeviationPoint>& points, bool rotary);

}  // namespace trunnion::report
