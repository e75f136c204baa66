// Inner products of the columns of a sparse matrix with those of a dense one.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace trunnion::estimation {

/// B'A: columns of B x columns of A. Each entry is a sum in the order of the rows.
Eigen::MatrixXd sparse_products(const Eigen::Ref<const Eigen::MatrixXd>& b,
                                const Eigen::SparseMatrix<double>& a);

}  // namespace trunnion::estimation
