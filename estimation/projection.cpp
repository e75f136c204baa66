#include "estimation/projection.h"

#include <Eigen/QR>

#include "estimation/ranked_least_squares.h"

namespace trunnion::estimation {
namespace {

constexpr double rounding = 1e-8;  ///< relative to the largest direction

}  // namespace

Projection::Projection(Eigen::MatrixXd known) : basis_(known.rows(), 0) {
    if (known.cols() == 0) return;
    for (auto column : known.colwise())
        if (const double length = column.norm(); length > 0.0) column /= length;
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(known.rows(), known.cols());
    qr.setThreshold(rounding);
    qr.compute(known);
    basis_ = qr.householderQ() * Eigen::MatrixXd::Identity(known.rows(), qr.rank());
}

double explained_beside(const Projection& known, const Eigen::MatrixXd& columns,
                        const Eigen::VectorXd& data, double threshold) {
    const Eigen::MatrixXd own = known.beside(columns);
    const Eigen::VectorXd product = own.transpose() * known.beside(data);
    return product.dot(solve_ranked(own.transpose() * own, product, threshold).value);
}

}  // namespace trunnion::estimation
