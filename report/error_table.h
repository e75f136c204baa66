// A free-form error in usable form: table, picture, and pitch error compensation data.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// The positioning error of a linear axis, with its claimed scale, as increments at equidistant
/// positions in the sense in which the axis counts, in whole detection units. The value of a
/// position is added by the compensation on the way from the previous position: minus the increase
/// of the error. Rounding errors do not accumulate. Sign, increments and units as on a Fanuc
/// control with incremental pitch error compensation are *assumed*; see docs/diagnosis.md.
struct PitchErrorData {
    double first_mm = 0.0, interval_mm = 0.0, unit_mm = 1e-3;
    std::vector<int> value;  ///< of the positions after the first
};
/// Empty when the cause has no free-form positioning error of a linear axis, and for one that holds
/// at the measured places only: the control interpolates between its points.
std::optional<PitchErrorData> pitch_error_data(const diagnosis::Cause& cause,
                                               double unit_mm = 1e-3);

/// The values of a free-form cause, one line a position: error, position, value and its sigma (µm
/// or µrad), then the pitch error data, or why there are none. Empty for other causes.
std::string error_table(const diagnosis::Cause& cause);

/// The same as curves over the position, an SVG picture for each error with a band of two sigma.
std::string error_curves(const diagnosis::Cause& cause);

}  // namespace trunnion::report
