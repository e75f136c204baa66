// Parameters and causes in workshop units.
#pragma once

#include <string>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// One parameter in workshop units: um and urad instead of mm and rad for small values.
struct ShopValue {
    std::string name, value, sigma, unit;  ///< sigma "-" if it does not exist
};
ShopValue shop_value(const identification::FitParameter& parameter);

/// "gap 81.2 +- 0.9 urad": the parameter with the largest ratio to its uncertainty; of a wave its
/// amplitude.
std::string main_size(const diagnosis::Cause& cause);

}  // namespace trunnion::report
