// One number decides the verdict: the part of the excess that the model takes away on readings left
// out.
#pragma once

#include "diagnosis/claims.h"
#include "diagnosis/diagnosis.h"

namespace trunnion::diagnosis {

/// The noise that the search and the verdict take as given.
struct NoiseBelief {
    NoiseModel model;
    estimation::NoisePrior prior;  ///< of the noise left in whitened readings
    double most = 1e300;           ///< variance of whitened noise above which it is no noise
};

/// What readings left out say about a model.
struct Judgement {
    double floor = 1.0;                ///< variance of the noise, whitened
    double before = 0.0, after = 0.0;  ///< mean squares left out: set-up alone, with the causes
    double part = 0.0;                 ///< H = (before - after) / (before - floor (1 + rank / n))
    bool gap = false;
    bool between_places = true;
    std::vector<bool> large;         ///< members that are large zeros
    std::vector<bool> interpolates;  ///< members: tables that hold between their places
    std::vector<Support> support;    ///< of each member
    Eigen::VectorXd left;            ///< whitened residuals left out, with the causes
    Eigen::VectorXd left_before;     ///< ... with the set-up alone
};
Judgement judged(Design& design, const Prepared& prepared, const Model& model,
                 const NoiseBelief& noise, const std::vector<bool>& used);

Verdict verdict_of(const Judgement& judgement, const std::vector<Claim>& claims);

/// Members that readings left out do not miss are taken away, the weakest first.
Model without_idle_members(Design& design, const SearchSetting& setting, const Prepared& prepared,
                           Model model, const std::vector<bool>& used);

/// Drivers that the readings follow when only the set-up is fitted, strongest first.
std::vector<DriverShare> where_of(const Design& design, double floor);

}  // namespace trunnion::diagnosis
