// Large effects: the chosen set through the emulator instead of along its derivatives.
#include <algorithm>

#include "diagnosis/diagnoser.h"
#include "effects/settings.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion {

namespace {

constexpr double bend_sigma = 0.25;  ///< of a reading: less than this is no bend

}  // namespace

bool Diagnoser::relinearise() {
    if (set_.members.empty()) return false;
    write_setup();
    const Replay replay(result_.setup, table_);
    const std::vector<double> read = replay.predict(active_models(result_.setup));
    const Eigen::VectorXd x = design_->solve(columns_of(*design_, set_.members), set_.scale);
    const Eigen::VectorXd straight =
        base_.measured_mm -
        Eigen::Map<const Eigen::VectorXd>(read.data(), static_cast<Eigen::Index>(read.size())) +
        known_columns(set_) * x;
    const Eigen::VectorXd change = straight - base_.residual_mm;
    if (change.cwiseQuotient(base_.sigma_mm).cwiseAbs().maxCoeff() < bend_sigma) return false;
    base_.residual_mm = straight;
    used_.assign(used_.size(), true);
    sigma_mm_ = base_.sigma_mm;
    rewhiten();
    drop_outliers();
    set_ = best_set();
    refine_noise();
    refine_set();
    return true;
}

std::vector<Inseparable> Diagnoser::unseen_of(const Candidate& candidate) const {
    std::vector<Inseparable> groups;
    const auto& list = candidate.effect->parameters;
    const auto name = [&](std::size_t j) {
        return full_name({candidate.effect->name, list[j].name, list[j].unit, list[j].component});
    };
    for (std::size_t j = 0; j < list.size(); ++j)
        if (!list[j].is_key() && std::find(candidate.parameters.begin(), candidate.parameters.end(),
                                           j) == candidate.parameters.end())
            groups.push_back({{name(j)}, {1.0}});
    const Eigen::MatrixXd information =
        design_->gram().block(candidate.first, candidate.first, candidate.size(), candidate.size());
    const LinearFit fit = solve_ranked(information, Eigen::VectorXd::Zero(candidate.size()));
    for (const Eigen::VectorXd& v : fit.null_space) {
        Inseparable group;
        for (Eigen::Index k = 0; k < v.size(); ++k)
            if (v(k) != 0.0) {
                group.names.push_back(name(candidate.parameters[static_cast<std::size_t>(k)]));
                group.direction.push_back(v(k));
            }
        groups.push_back(group);
    }
    return groups;
}

}  // namespace trunnion
