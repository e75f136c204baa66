// Cholesky factor and inverse of lower triangular matrices of a few hundred rows, in panels of
// eight rows by four columns: the innermost loops of a diagnosis.
//
// Vectors     the functions are compiled for several widths of vectors, and the processor decides
//             at the start. Each element is one sum in the order of the rows, at any width: the
//             results are the same on every processor.
// Storage     column-major, the number of rows a multiple of eight (padded_rows). What is above the
//             diagonal is neither read nor meaningful in a factor, and zero in an inverse.
// Failure     a matrix that is not positive definite gives NaN.
#pragma once

#include <Eigen/Core>

namespace trunnion::estimation {

inline Eigen::Index padded_rows(Eigen::Index rows) {
    return (rows + 7) / 8 * 8;
}

/// Replaces a symmetric positive definite matrix (its lower triangle) by L, where L L' is the
/// matrix.
void factor_in_place(Eigen::MatrixXd& matrix);

/// Inverse of a lower triangular matrix.
Eigen::MatrixXd inverse_of_lower(const Eigen::MatrixXd& lower);

}  // namespace trunnion::estimation
