// What of some columns lies outside the span of others.
#include <algorithm>

#include "diagnosis/search/design.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion::diagnosis {
namespace {

double part_outside(const Eigen::MatrixXd& gram, const Eigen::MatrixXd& cross, double own) {
    const estimation::LinearFit all =
        estimation::solve_ranked(gram, Eigen::VectorXd::Zero(cross.rows()));
    const double inside = (all.covariance * cross).cwiseProduct(cross).sum();
    return 1.0 - inside / std::max(1e-300, own);
}

}  // namespace

double Design::outside(std::size_t k, const std::vector<Eigen::Index>& features) const {
    const ColumnGroup& group = groups_[k].group;
    const std::vector<Run> runs = runs_of(features);
    Eigen::MatrixXd cross = gram_of(runs, groups_[k].runs);
    if (group.shape.size() > 0) cross = Eigen::MatrixXd(cross * group.shape);
    return part_outside(gram_of(runs, runs), cross, groups_[k].gram.trace());
}

double Design::outside(const std::vector<Eigen::Index>& own,
                       const std::vector<Eigen::Index>& features) const {
    const std::vector<Run> runs = runs_of(features), own_runs = runs_of(own);
    return part_outside(gram_of(runs, runs), gram_of(runs, own_runs),
                        gram_of(own_runs, own_runs).trace());
}

}  // namespace trunnion::diagnosis
