#include "estimation/ranked_least_squares.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

namespace trunnion::estimation {
namespace {

/// Gauss-Jordan elimination with full pivoting on the rows of `basis`: a basis of the same space
/// with few non-zero entries.
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

using Eigensolver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;

Directions split(const Eigensolver& eigen, Eigen::Index unseen) {
    const Eigen::Index seen = eigen.eigenvalues().size() - unseen;
    return {eigen.eigenvectors().rightCols(seen), eigen.eigenvalues().tail(seen),
            eigen.eigenvectors().leftCols(unseen)};
}

}  // namespace

Directions directions_above(const Eigen::MatrixXd& information, double least, double part) {
    if (information.size() == 0) return {};
    const Eigensolver eigen(information);
    const double floor = std::max(least, part * eigen.eigenvalues().maxCoeff());
    return split(eigen, (eigen.eigenvalues().array() < floor).count());
}

Directions directions_beside(const Eigen::MatrixXd& information, Eigen::Index unseen) {
    return information.size() == 0 ? Directions{} : split(Eigensolver(information), unseen);
}

LinearFit solve_ranked(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
                       double threshold) {
    const Eigen::Index p = information.rows();
    LinearFit fit;
    fit.value = Eigen::VectorXd::Zero(p);
    fit.sigma = Eigen::VectorXd::Zero(p);
    fit.covariance = Eigen::MatrixXd::Zero(p, p);
    fit.unseen.resize(p, 0);
    if (p == 0) return fit;
    const Directions d = directions_above(information, threshold * threshold);
    fit.value = d.seen * (d.seen.transpose() * gradient).cwiseQuotient(d.information);
    fit.covariance = d.inverse();
    fit.sigma = fit.covariance.diagonal().cwiseSqrt();
    fit.unseen = d.unseen;
    if (d.unseen.cols() == 0) return fit;
    fit.null_space = sparse_basis(d.unseen.transpose());
    for (const Eigen::VectorXd& v : fit.null_space)
        for (Eigen::Index j = 0; j < p; ++j)
            if (v(j) != 0.0) fit.sigma(j) = std::numeric_limits<double>::quiet_NaN();
    return fit;
}

double explained(const Eigen::MatrixXd& information, const Eigen::VectorXd& gradient,
                 double threshold) {
    const Directions d = directions_above(information, threshold * threshold);
    if (d.seen.cols() == 0) return 0.0;
    return (d.seen.transpose() * gradient).cwiseAbs2().cwiseQuotient(d.information).sum();
}

}  // namespace trunnion::estimation
