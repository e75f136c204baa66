// Uncertainty of the reduction of the gap: the possible results of fresh readings, drawn from all
// uncertainties.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "diagnosis/fresh_readings.h"
#include "diagnosis/search/solution.h"

namespace trunnion::inline base {
class SeededNoise;
}  // namespace trunnion::inline base

namespace trunnion::diagnosis {

/// A possible model with its weight among all (the first one is the chosen model).
struct PossibleTruth {
    Model model;
    double weight = 1.0;
};

/// Prediction error on one left-out stretch beyond noise and the fit's own error.
struct Missed {
    double square = 0.0, noise = 0.0, rows = 0.0;  ///< mm^2, mm^2, count
};

/// The same on whole left-out paths, with the set-up alone and with the written causes.
struct Elsewhere {
    std::vector<Missed> before, after;
};

/// Further input of the draws.
struct DrawSetting {
    std::vector<Missed> missed;
    Elsewhere elsewhere;
    double unknown = 0.0;        ///< probability that the effects replace an unknown one
    double doubt = 0.0;          ///< relative standard error of the noise variance
    double independent = 1.0;    ///< number of independent readings with the same information about
                                 ///< the noise
    double noise_per_row = 0.0;  ///< mm^2
    double between = 0.0;        ///< of the squares that tables leave between their places
    std::uint64_t seed = 1;
};

/// Draws machines that agree with the readings, and an equal number of fresh readings of each.
/// Uncertain are: the model; its parameters and the set-up (joint covariance, with even probability
/// that undetermined parameters are small); the size of the noise; the positions of fresh readings
/// (weights of whole passes and of stretches of poses); the unexplained remainder; and the actual
/// noise of the fresh readings, of which only the variance can be subtracted. With probability
/// `unknown` the effects replace something missing from the catalogue, so that part of their
/// prediction is wrong.
class ShrinkDraws {
  public:
    ShrinkDraws(Design& design, const FreshReadings& fresh, std::vector<PossibleTruth> truths,
                DrawSetting setting);

    /// 95 % interval of the shrink by `model`, relative to the set-up alone.
    std::pair<double, double> interval(const Model& model) const;

    /// The same, widened by the interval for fresh readings on paths that were not measured: an
    /// unknown part of them, on which the model fails as it does on left-out paths.
    std::pair<double, double> interval_elsewhere(const Model& model) const;

  private:
    struct Draw {
        double remainder = 0.0;   ///< mm^2, weighted
        double false_part = 0.0;  ///< fraction of the prediction that is wrong; it counts twice
        double noise = 0.0;       ///< mm^2, weighted: expected noise of the fresh readings
        double elsewhere = 0.0;   ///< fraction of the fresh readings over unmeasured paths
        double left_there = 0.0;  ///< what the written causes leave of the squares there
        double between = 0.0;     ///< what tables leave of the squares between their places
        /// Standard normal: deviation of the fresh noise from its expectation, and its projection
        /// on the error before and after the fit.
        double off = 0.0, along_before = 0.0, along_after = 0.0;
    };
    double as_read(double square, const Draw& draw, double along) const;
    std::vector<double> squares_off(const Eigen::VectorXd& x) const;
    std::pair<double, double> ends(const Model& model, bool elsewhere) const;
    void take_places(const FreshReadings& fresh);
    void draw_all();
    Eigen::VectorXd over_places(const Model& model, const Eigen::VectorXd& x) const;

    Design& design_;
    std::vector<PossibleTruth> truths_;
    DrawSetting setting_;
    std::map<std::size_t, Eigen::Index> place_;  ///< first column of each group; the set-up comes
                                                 ///< first
    Eigen::Index places_ = 0;
    Eigen::MatrixXd columns_;         ///< on the fresh readings, stretch after stretch
    std::vector<Eigen::Index> rows_;  ///< of the stretches
    std::vector<Draw> draws_;
    Eigen::MatrixXd read_;     ///< readings of each drawn machine, one column for each draw
    Eigen::MatrixXd weights_;  ///< of the stretches, one column for each draw
};

/// Rows of the stretches: each ballbar pass; the probe poses, in order, in parts.
std::vector<std::vector<Eigen::Index>> stretches_of(const std::vector<NoiseBlock>& blocks);

}  // namespace trunnion::diagnosis
