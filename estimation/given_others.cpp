#include "estimation/given_others.h"

#include <cmath>

#include "estimation/inner_products.h"

namespace trunnion::estimation {

GivenOthers::GivenOthers(const GivenMembers& all, Eigen::Index first, Eigen::Index count,
                         double tau)
    : all_(all), first_(first), count_(count) {
    // R is lower triangular: the rows above the first row of the group are zero in its columns.
    const auto own = all.half().block(first, first, all.half().rows() - first, count);
    own_ = Eigen::LLT<Eigen::MatrixXd>(inner_products(own)).matrixL();
    own_mean_ = own_.triangularView<Eigen::Lower>().solve(all.mean().segment(first, count));
    gained_ = -0.5 * own_mean_.squaredNorm() - (own_.diagonal().array() / tau).log().sum();
}

/// L^-1 C_g times the products of the members with a group: what hides in the absent group's part.
Eigen::MatrixXd GivenOthers::shown(const Eigen::MatrixXd& taken) const {
    const Eigen::Index rows = taken.rows() - first_;
    Eigen::MatrixXd shown =
        inner_products(all_.half().block(first_, first_, rows, count_), taken.bottomRows(rows));
    own_.triangularView<Eigen::Lower>().solveInPlace(shown);
    return shown;
}

void GivenOthers::replace(const Eigen::MatrixXd& taken, const GroupInformation& left, double tau) {
    GroupInformation alone = leave(taken, left);
    taken_ = taken;
    shown_ = shown(taken);
    alone.information.diagonal().array() += 1.0 / (tau * tau);
    in_place_.compute(alone.information);
    in_place_z_ = in_place_.matrixL().solve(alone.product);
    in_place_mean_ = in_place_.matrixU().solve(in_place_z_);
    gained_ += 0.5 * in_place_z_.squaredNorm() -
               (in_place_.matrixLLT().diagonal().array() * tau).log().sum();
}

GroupInformation GivenOthers::leave(const Eigen::MatrixXd& taken, GroupInformation left,
                                    const Eigen::MatrixXd& cross) const {
    const Eigen::MatrixXd back = shown(taken);
    left.information += inner_products(back);
    left.product.noalias() += back.transpose() * own_mean_;
    if (in_place_mean_.size() == 0) return left;
    Eigen::MatrixXd joint = cross / (all_.nu() * all_.nu());
    joint -= inner_products(taken_, taken);
    joint += inner_products(shown_, back);
    in_place_.matrixL().solveInPlace(joint);
    left.information -= inner_products(joint);
    left.product.noalias() -= joint.transpose() * in_place_z_;
    return left;
}

Eigen::VectorXd GivenOthers::mean() const {
    const Eigen::Index rows = all_.half().rows() - first_;
    Eigen::VectorXd absent = own_mean_, moved = Eigen::VectorXd::Zero(all_.half().rows());
    if (in_place_mean_.size() > 0) {
        moved -= taken_ * in_place_mean_;
        absent -= shown_ * in_place_mean_;
    }
    own_.transpose().triangularView<Eigen::Upper>().solveInPlace(absent);
    moved.tail(rows) -= all_.half().block(first_, first_, rows, count_) * absent;
    Eigen::VectorXd mean =
        all_.mean() + all_.half().triangularView<Eigen::Lower>().transpose() * moved;
    mean.segment(first_, count_).setZero();  // but for rounding
    return mean;
}

}  // namespace trunnion::estimation
