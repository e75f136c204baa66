// A free-form error in usable form: table, picture, and pitch error compensation data.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.h"

namespace trunnion::report {

/// The positioning error of an axis, with all that is claimed of it (Cause::beyond), as increments
/// at equidistant positions in the sense in which the axis counts, in whole detection units. Those
/// of a whole turn add up to zero. The value of a position is added by the compensation on the way
/// from the previous position: minus the increase of the error. Rounding errors do not accumulate.
/// Sign, increments and units as on a Fanuc control with incremental pitch error compensation are
/// *assumed*; see docs/diagnosis.md.
struct PitchErrorData {
    bool rotary = false;
    double first = 0.0, interval = 0.0, unit = 1e-3;  ///< mm or deg
    std::vector<int> value;                           ///< of the positions after the first
};
/// Empty when the cause has no free-form positioning error, and for one that holds at the measured
/// places only: the control interpolates between its points. `unit`: mm or deg.
std::optional<PitchErrorData> pitch_error_data(const diagnosis::Cause& cause, double unit = 1e-3);

/// The pitch error data in words, or why there are none; empty for a cause without them.
std::string pitch_error_text(const diagnosis::Cause& cause);

/// The values of a free-form cause, one line a position: error, position, value and its sigma (µm
/// or µrad), then the pitch error data. Empty for other causes.
std::string error_table(const diagnosis::Cause& cause);

/// The same as curves over the position, an SVG picture for each error with a band of two sigma.
std::string error_curves(const diagnosis::Cause& cause);

}  // namespace trunnion::report
