// Products of the columns of two matrices: A'B, in vectors as wide as the processor has.
//
// Accuracy    each element is a sum in a fixed order that depends on the number of rows alone: the
//             same on every processor, and the same transposed (B'A).
// Failure     none. Matrices without rows give zeros.
#pragma once

#include <Eigen/Core>

namespace trunnion::estimation {

/// A'B; requires the same number of rows.
Eigen::MatrixXd inner_products(const Eigen::Ref<const Eigen::MatrixXd>& a,
                               const Eigen::Ref<const Eigen::MatrixXd>& b);

/// A'A: half of the work.
Eigen::MatrixXd inner_products(const Eigen::Ref<const Eigen::MatrixXd>& a);

/// U'B for an upper triangular U (what is below its diagonal must be zero): half of the work.
Eigen::MatrixXd upper_inner_products(const Eigen::Ref<const Eigen::MatrixXd>& upper,
                                     const Eigen::Ref<const Eigen::MatrixXd>& b);

}  // namespace trunnion::estimation
