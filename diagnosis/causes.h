// Converts a claim into a cause for output: parameters or table, with uncertainty.
#pragma once

#include "diagnosis/diagnosis.h"
#include "diagnosis/search/solution.h"
#include "diagnosis/verdict/verdict.h"

namespace trunnion::diagnosis {

/// The chosen model with its solution.
struct FoundModel {
    const Design& design;
    const Model& model;
    const Judgement& judgement;
    const Solution& solution;
    const Eigen::MatrixXd& covariance;  ///< of the solution
};
/// Without its held-out results.
Cause cause_of(const FoundModel& found, const Claim& claim);
/// Directions of the parameters of an effect, in a form of it, that these readings do not
/// determine. A parameter that another form of it has is held at 0, not unseen.
std::vector<identification::Inseparable> unseen_of(const Design& design, std::size_t group);

}  // namespace trunnion::diagnosis
