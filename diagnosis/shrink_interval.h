// How sure the shrink of the gap is: what fresh readings may show, drawn from everything that is
// not known for certain.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "diagnosis/fresh_readings.h"
#include "diagnosis/solution.h"

namespace trunnion::inline base {
class SeededNoise;
}  // namespace trunnion::inline base

namespace trunnion::diagnosis {

/// A model that may be the truth, with its weight among all (the first is the chosen one).
struct PossibleTruth {
    Model model;
    double weight = 1.0;
};

/// What predictions of one left-out stretch miss beyond noise and the fit's own error.
struct Missed {
    double square = 0.0, noise = 0.0, rows = 0.0;  ///< mm^2, mm^2, count
};

/// What the draws need beside the truths.
struct DrawSetting {
    std::vector<Missed> missed;
    double unknown = 0.0;        ///< chance that the effects stand in for something else
    double doubt = 0.0;          ///< relative standard error of the noise variance
    double independent = 1.0;    ///< readings that know as much about the noise as these
    double noise_per_row = 0.0;  ///< mm^2
    std::uint64_t seed = 1;
};

/// Draws machines that agree with the readings and as many fresh readings of them. Unknown are:
/// which model is true, the values of its parameters and of the set-up (their joint covariance,
/// with even chance that what the readings leave open is small), the size of the noise, which
/// places fresh readings will stress (weights of whole passes and stretches of poses), the
/// remainder that no model explains, and the noise that the fresh readings happen to have, of which
/// only the variance can be taken off. With a chance of `unknown` the effects are stand-ins for
/// something the catalogue lacks: a part of what they predict is wrong.
class ShrinkDraws {
  public:
    ShrinkDraws(Design& design, const FreshReadings& fresh, std::vector<PossibleTruth> truths,
                DrawSetting setting);

    /// 95 % interval of the shrink that `model` gives against the set-up alone.
    std::pair<double, double> interval(const Model& model) const;

  private:
    struct Draw {
        double remainder = 0.0;   ///< mm^2, weighted
        double false_part = 0.0;  ///< of what the effects predict: comes twice
        double noise = 0.0;       ///< mm^2, weighted: expected of the fresh readings' own
        /// Standard normal: deviation of the fresh noise from its expectation, and its projection
        /// on the error before and after.
        double off = 0.0, along_before = 0.0, along_after = 0.0;
    };
    double as_read(double square, const Draw& draw, double along) const;
    std::vector<double> squares_off(const Eigen::VectorXd& x) const;
    void take_places(const FreshReadings& fresh);
    void draw_all();
    Eigen::VectorXd over_places(const Model& model, const Eigen::VectorXd& x) const;

    Design& design_;
    std::vector<PossibleTruth> truths_;
    DrawSetting setting_;
    std::map<std::size_t, Eigen::Index> place_;  ///< first column of each group; set-up is first
    Eigen::Index places_ = 0;
    Eigen::MatrixXd columns_;  ///< of all places on the fresh readings, stretch after stretch
    std::vector<Eigen::Index> rows_;  ///< of the stretches
    std::vector<Draw> draws_;
    Eigen::MatrixXd read_;     ///< what each drawn machine reads there, a column a draw
    Eigen::MatrixXd weights_;  ///< of the stretches, a column a draw
};

/// Rows of stretches: every pass of the ballbar; the poses of the probe, in order, in parts.
std::vector<std::vector<Eigen::Index>> stretches_of(const std::vector<NoiseBlock>& blocks);

}  // namespace trunnion::diagnosis
