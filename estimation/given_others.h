// What members leave when one of them is absent, or another group stands in its place: from the
// factorisation of all of them, without another one.
//
// Model       that of estimation/variance_groups.h. C: covariance of all members; g: the columns of
//             one group. Without that group the covariance is C - C_g C_gg^-1 C_g'. Another group k
//             beside the rest has the precision P = I / tau^2 + its information; what it takes from
//             others is their joint information with it, by P^-1.
// Assumes     sizes above zero of the members, and the same sizes and noise for the rest.
// Failure     none.
#pragma once

#include "estimation/variance_groups.h"

namespace trunnion::estimation {

class GivenOthers {
  public:
    /// Columns first .. first + count of the members, of size `tau`, are absent. `all` must outlive
    /// this.
    GivenOthers(const GivenMembers& all, Eigen::Index first, Eigen::Index count, double tau);
    /// Another group in their place, of size `tau`. `taken`, `left`: what all members take
    /// (GivenMembers::taken) and leave of it.
    void replace(const Eigen::MatrixXd& taken, const GroupInformation& left, double tau);

    /// Information of a group beside the rest. `cross`: products of the columns in place with those
    /// of this group; empty if nothing is in place.
    GroupInformation leave(const Eigen::MatrixXd& taken, GroupInformation left,
                           const Eigen::MatrixXd& cross = {}) const;
    /// Of b: all members, zero for the absent group; and the group in its place.
    Eigen::VectorXd mean() const;
    const Eigen::VectorXd& mean_in_place() const { return in_place_mean_; }
    /// Log likelihood, minus that with all members.
    double gained() const { return gained_; }

  private:
    Eigen::MatrixXd shown(const Eigen::MatrixXd& taken) const;

    const GivenMembers& all_;
    Eigen::Index first_, count_;
    Eigen::MatrixXd own_;       ///< L, where C_gg = L L'
    Eigen::VectorXd own_mean_;  ///< L^-1 times the mean of the absent group
    double gained_ = 0.0;
    Eigen::MatrixXd taken_, shown_;                                ///< of the group in place
    Eigen::LLT<Eigen::MatrixXd> in_place_{Eigen::MatrixXd(0, 0)};  ///< P
    Eigen::VectorXd in_place_mean_, in_place_z_;
};

}  // namespace trunnion::estimation
