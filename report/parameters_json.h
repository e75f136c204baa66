// Fitted parameters as JSON: identify, diagnose and predict print them alike.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::report {

/// [{"effect", "name", "value", "sigma", "unit"}]: components of a vector parameter in one entry
/// with arrays; a sigma that does not exist is null.
nlohmann::ordered_json json_parameters(const std::vector<identification::FitParameter>& parameters);

/// "dp_mm[y]"
std::string with_component(const identification::FitParameter& parameter);
/// {"names", "matrix", "correlation"}: rows and columns in the order of names, units of the
/// parameters; null where a parameter is not seen.
nlohmann::ordered_json json_covariance(const std::vector<identification::FitParameter>& parameters,
                                       const Eigen::MatrixXd& covariance);
/// [{"names": [...], "direction": [...]}]
nlohmann::ordered_json json_inseparable(const std::vector<identification::Inseparable>& groups);

}  // namespace trunnion::report
