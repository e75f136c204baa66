// Fitted parameters as JSON, common to identify, diagnose and predict.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::report {

/// [{"effect", "name", "value", "sigma", "unit"}]: the components of a vector parameter are arrays
/// in one entry; a missing sigma is null.
nlohmann::ordered_json json_parameters(const std::vector<identification::FitParameter>& parameters);

/// "dp_mm[y]"
std::string with_component(const identification::FitParameter& parameter);
/// {"names", "matrix", "correlation"}: rows and columns in the order of names, in the units of the
/// parameters; null for an unobservable parameter.
nlohmann::ordered_json json_covariance(const std::vector<identification::FitParameter>& parameters,
                                       const Eigen::MatrixXd& covariance);
/// [{"names": [...], "direction": [...]}]
nlohmann::ordered_json json_inseparable(const std::vector<identification::Inseparable>& groups);

}  // namespace trunnion::report
