// JSON pieces that several commands print.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::cli {

/// [{"effect", "name", "value", "sigma", "unit"}]: components of a vector parameter in one entry
/// with arrays; a sigma that does not exist is null.
nlohmann::ordered_json json_parameters(const std::vector<identification::FitParameter>& parameters);

/// "dp_mm[y]"
std::string with_component(const identification::FitParameter& parameter);
/// [{"names": [...], "direction": [...]}]
/// {"names", "matrix", "correlation"}: rows and columns in the order of names, units of the
/// parameters; null where a parameter is not seen.
nlohmann::ordered_json json_covariance(const std::vector<identification::FitParameter>& parameters,
                                       const Eigen::MatrixXd& covariance);
nlohmann::ordered_json json_inseparable(const std::vector<identification::Inseparable>& groups);

}  // namespace trunnion::cli
