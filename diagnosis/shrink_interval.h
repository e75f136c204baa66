// How sure the shrink of the gap is: what fresh readings may show, drawn from everything that is
// not known for certain.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <utility>
#include <vector>

#include "diagnosis/fresh_readings.h"

namespace trunnion {

class SeededNoise;

/// A set of effects that may be the truth, with its weight among all (the first is the chosen one).
struct PossibleTruth {
    std::vector<Eigen::Index> columns;  ///< of the candidates
    double scale = 1.0;                 ///< of the prior
    double weight = 1.0;
};

/// Draws machines that agree with the readings and as many fresh readings of them. Unknown are:
/// which set of effects is true, the values of its parameters and of the base (their joint
/// covariance, with even chance that what the readings leave open is small), the size of the noise,
/// which places fresh readings will stress (weights of whole passes and stretches of poses), the
/// remainder that no set explains (what predictions of left-out passes miss beyond all this, for
/// each reading), and the noise that the fresh readings happen to have, of which only the variance
/// can be taken off. With a chance of `unknown` the effects are stand-ins for something the
/// catalogue lacks: a part of what they predict is wrong.
class ShrinkDraws {
  public:
    /// `used` marks rows that count; `doubt`: relative standard error of the noise variance;
    /// `independent`: readings that know as much about the noise as these correlated ones.
    ShrinkDraws(const Design& design, const std::vector<NoiseBlock>& blocks,
                const FreshReadings& fresh, const Eigen::VectorXd& noise_mm,
                const std::vector<bool>& used, std::vector<PossibleTruth> truths, double unknown,
                std::uint64_t seed, double doubt, double independent);

    /// 95 % interval of the shrink that the effects in `columns`, fitted beside the base, give.
    std::pair<double, double> interval(const std::vector<Eigen::Index>& columns,
                                       double scale) const;

  private:
    struct Draw {
        double remainder = 0.0;   ///< mm^2, weighted
        double false_part = 0.0;  ///< of what the effects predict: comes twice
        double noise = 0.0;       ///< mm^2, weighted: expected of the fresh readings' own
        /// Standard normal: how far their noise is off that, and along what is off before, after.
        double off = 0.0, along_before = 0.0, along_after = 0.0;
    };
    struct Missed {
        double square = 0.0, noise = 0.0, rows = 0.0;  ///< mm^2, mm^2, count of one stretch
    };
    double as_read(double square, const Draw& draw, double along) const;
    std::vector<double> squares_off(const Eigen::VectorXd& x) const;
    void take_places(const FreshReadings& fresh);
    static double chance_of_remainder(const std::vector<Missed>& missed);
    static double remainder_per_row(const std::vector<Missed>& missed, double noise_factor,
                                    SeededNoise& random);
    Eigen::VectorXd over_places(const std::vector<Eigen::Index>& columns,
                                const Eigen::VectorXd& x) const;
    std::vector<Missed> missed(const std::vector<NoiseBlock>& blocks,
                               const Eigen::VectorXd& noise_mm,
                               const std::vector<bool>& used) const;

    const Design& design_;
    std::vector<PossibleTruth> truths_;
    std::vector<Eigen::Index> places_;     ///< columns of any truth, base first
    std::vector<Eigen::MatrixXd> square_;  ///< of those columns, by stretch of fresh readings
    std::vector<double> rows_;             ///< of those stretches
    std::vector<Draw> draws_;
    double independent_ = 1.0;
    Eigen::MatrixXd machines_;            ///< a column a draw, over `places_`
    Eigen::MatrixXd weights_;             ///< of the stretches, a column a draw
    std::vector<Eigen::VectorXd> moved_;  ///< square of each draw's own readings, by stretch
};

}  // namespace trunnion
