// An error in free form as the shop needs it: a table, a picture, pitch error data to type in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// The positioning error of a linear axis as increments at even places, in whole detection units.
/// The value of a place is what the compensation adds on the way there from the place before:
/// minus the rise of the error. Rounded so that no rounding adds up. Sign, increments and units as
/// on a Fanuc control with incremental pitch error compensation are *assumed*; see
/// docs/diagnosis.md.
struct PitchErrorData {
    double first_mm = 0.0, interval_mm = 0.0, unit_mm = 1e-3;
    std::vector<int> value;  ///< of the places behind the first
};
/// Nothing where the cause holds no positioning error of a linear axis in free form.
std::optional<PitchErrorData> pitch_error_data(const diagnosis::Cause& cause,
                                               double unit_mm = 1e-3);

/// The values of a cause in free form, one line a place: error, place, value and its sigma (um or
/// urad), then the pitch error data where there are some. Empty for other causes.
std::string error_table(const diagnosis::Cause& cause);

/// The same as a curve over the place, an SVG picture for each error with a band of two sigma.
std::string error_curves(const diagnosis::Cause& cause);

}  // namespace trunnion::report
