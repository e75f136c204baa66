#include "estimation/ranked_least_squares.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace trunnion::estimation {
namespace {

/// Gauss-Jordan with full pivoting on the rows of `basis`: the same space with few entries each.
std::vector<Eigen::VectorXd> sparse_basis(Eigen::MatrixXd basis) {
    std::vector<Eigen::VectorXd> result;
    for (Eigen::Index r = 0; r < basis.rows(); ++r) {
        Eigen::Index row = 0, column = 0;
        basis.bottomRows(basis.rows() - r).cwiseAbs().maxCoeff(&row, &column);
        basis.row(r).swap(basis.row(r + row));
        basis.row(r) /= basis(r, column);
        for (Eigen::Index other = 0; other < basis.rows(); ++other)
            if (other != r) basis.row(other) -= basis(other, column) * basis.row(r);
    }
    for (Eigen::Index r = 0; r < basis.rows(); ++r) {
        Eigen::VectorXd v = basis.row(r).transpose();
        v /= v.cwiseAbs().maxCoeff();
        result.push_back((v.array().abs() < 1e-3).select(0.0, v));
    }
    return result;
}

}  // namespace

LinearFit solve_ranked(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
                       double threshold) {
    const Eigen::Index p = information.rows();
    LinearFit fit;
    fit.value = Eigen::VectorXd::Zero(p);
    fit.sigma = Eigen::VectorXd::Zero(p);
    fit.covariance = Eigen::MatrixXd::Zero(p, p);
    if (p == 0) return fit;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(information);
    // Rounding of the normal equations leaves about 1e-16 of the largest eigenvalue.
    const double floor = std::max(threshold * threshold, 1e-13 * eigen.eigenvalues().maxCoeff());
    Eigen::Index unseen = 0;
    while (unseen < p && eigen.eigenvalues()(unseen) < floor) ++unseen;
    for (Eigen::Index k = unseen; k < p; ++k) {
        const Eigen::VectorXd v = eigen.eigenvectors().col(k);
        fit.value += v * (v.dot(gradient) / eigen.eigenvalues()(k));
        fit.covariance += v * v.transpose() / eigen.eigenvalues()(k);
    }
    fit.sigma = fit.covariance.diagonal().cwiseSqrt();
    if (unseen == 0) return fit;
    fit.null_space = sparse_basis(eigen.eigenvectors().leftCols(unseen).transpose());
    for (const Eigen::VectorXd& v : fit.null_space)
        for (Eigen::Index j = 0; j < p; ++j)
            if (v(j) != 0.0) fit.sigma(j) = std::numeric_limits<double>::quiet_NaN();
    return fit;
}

}  // namespace trunnion::estimation
