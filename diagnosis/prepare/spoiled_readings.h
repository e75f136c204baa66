// Spoiled readings, a few of few or up to a fifth of many: the evidence tells them from what the
// machine does. (A few of many, which spoil no fit: diagnosis/prepare/outliers.h.)
#pragma once

#include "diagnosis/prepare/prepare.h"

namespace trunnion::diagnosis {

/// Name of a rival: the readings of one visit of a pose are wrong. No setup contains it.
inline constexpr const char* spoiled_visit = "reading.spoiled";

/// True where each reading is taken for itself, so that one may go wrong alone.
inline bool is_single(records::Device device) {
    return device != records::Device::ballbar && device != records::Device::axis;
}

/// Columns and residuals of the device rows, in sigma or whitened.
struct LinearModel {
    Eigen::MatrixXd columns;
    Eigen::VectorXd data;
};
/// Of the set-up alone, in sigma.
LinearModel set_up_of(const identification::BaseModel& base);

struct DoubtfulReadings {
    std::vector<std::size_t> rows;           ///< device rows, ascending; empty: none are in doubt
    double largest = 0.0;                    ///< of their residuals, in the unit of the model
    double usual = 0.0;                      ///< robust deviation of all residuals, in the same
    double scale = 1.0;                      ///< of the whitened rows of a search, in that unit
    std::size_t visits = 0, all_visits = 0;  ///< of a position: those of `rows`, and all
};
/// Readings far from a fit of `model` that they cannot influence (estimation/trimmed_fit.h), where
/// they are at most 20 % of `used`, of more than 1,000 readings more than 4 %, and not side by side
/// in time. Only of devices whose readings are taken one by one: a ballbar or a servo log is one
/// course.
DoubtfulReadings doubtful_readings(const Prepared& prepared, const LinearModel& model,
                                   const std::vector<bool>& used);

/// Log likelihood of doubtful readings as spoiled ones, each anywhere in their spread, and of the
/// other visits as good ones: a wrong star or a slip spoils all readings of a visit. To be added to
/// the likelihood of a model of the others.
double likelihood_of_spoiled(const DoubtfulReadings& doubtful);

}  // namespace trunnion::diagnosis
