// Whether some columns do the work of a claimed cause (same_work.cpp).
#pragma once

#include <Eigen/Core>

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// Columns, whitened, and those of the named causes of the model but the one at `position`, beside
/// the set-up.
Eigen::MatrixXd named_beside(const Outcome& found, std::size_t position,
                             const Eigen::MatrixXd& columns);

/// True where these columns, fitted to what the claim contributes, leave noise of it, or little.
/// `freedom`: columns of the claim.
bool do_the_same(const Outcome& found, const Eigen::VectorXd& part, const Eigen::MatrixXd& columns,
                 double freedom);

}  // namespace trunnion::diagnosis
