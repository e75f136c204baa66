// The verdict, determined by one number: the fraction of the excess on left-out readings that the
// model removes.
#pragma once

#include "diagnosis/verdict/claims.h"
#include "diagnosis/verdict/verdict_kind.h"

namespace trunnion::diagnosis {

/// The noise assumed by search and verdict.
struct NoiseBelief {
    NoiseModel model;
    estimation::NoisePrior prior;  ///< of the noise in whitened readings
    double most = 1e300;           ///< maximum variance of whitened noise; anything larger is not
                                   ///< noise
};

/// Results of the left-out readings for a model.
struct Judgement {
    double floor = 1.0;                ///< variance of the noise, whitened
    double before = 0.0, after = 0.0;  ///< mean squares of left-out residuals: set-up alone, with
                                       ///< the causes
    double part = 0.0;                 ///< H = (before - after) / (before - floor (1 + rank / n))
    double beside_zeros = 0.0;         ///< the same with all zeros predicted both times
    double evidence = 0.0;             ///< of the model beside the scatter of zeros, nats
    double chance = 1.0;               ///< that noise alone lets a model explain as much
    bool repeated = false;             ///< repeats tell the noise
    bool gap = false;
    double scatter = 1.0;       ///< of repeats, relative to the noise that is stated of the devices
    bool only_scatter = false;  ///< the gap is nothing but that
    bool alike_near = false;    ///< the gap is that neighbours are off alike
    bool alike_in_time = false;  ///< ... that successive readings of a pass are
    bool between_places = true;
    std::vector<bool> large;         ///< members that are large zeros
    std::vector<bool> interpolates;  ///< members: tables valid between their positions, ripples of
                                     ///< a unique period, drifts that nothing of time is beside
    std::vector<std::vector<double>> equal_periods;  ///< of members: the others
    std::vector<Support> support;                    ///< of each member
    Eigen::VectorXd left;         ///< whitened left-out residuals, with the causes
    Eigen::VectorXd left_before;  ///< ... with the set-up alone
};
/// `rows`: the blocks of the readings, left out in turn.
Judgement judged(FoldColumns& rows, const Prepared& prepared, const Model& model,
                 const NoiseBelief& noise);

Verdict verdict_of(const Judgement& judgement, const std::vector<Claim>& claims);

/// Removes members without benefit for left-out readings, the weakest first.
Model without_idle_members(FoldColumns& rows, const SearchSetting& setting, Model model);

/// Drivers that the readings depend on when only the set-up is fitted, strongest first.
std::vector<DriverShare> where_of(const Design& design, double floor);

}  // namespace trunnion::diagnosis
