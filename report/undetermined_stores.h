// Stores that rest on locations which the readings do not determine.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "identification/base_model.h"
#include "setup/setup.h"

namespace trunnion::report {

/// Names of the numbers (setup::StoreNumber) that would be others if one of the locations without
/// a sigma were.
std::set<std::string> undetermined_stores(
    const setup::Setup& setup, const std::vector<identification::FitParameter>& parameters);

}  // namespace trunnion::report
