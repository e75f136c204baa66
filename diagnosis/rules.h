// The thresholds of the verdict in one place; docs/diagnosis.md says why.
#pragma once

#include <algorithm>

namespace trunnion::rules {

constexpr double least_share = 0.05;    ///< of the gap: below it an effect is background
constexpr double least_square = 0.03;   ///< of the noise variance: below it nobody cares
constexpr double plain_square = 0.08;   ///< ... and below it a driver alone makes no gap
constexpr double most_outliers = 0.04;  ///< of the readings
constexpr double most_noise = 2.0;      ///< times the stated variance: more is no noise
constexpr double gap_p = 5e-3;          ///< chance level at which effects make a gap
constexpr double effects_tried = 60.0;  ///< by which that chance is corrected
constexpr double driver_p = 1e-4;       ///< chance level at which a driver counts
constexpr double driver_share = 0.05;
constexpr double admit_share = 0.10;    ///< unexplained part from which "unknown" is named
constexpr double admit_square = 0.25;   ///< ... or, of what is no background, of the noise variance
constexpr double least_heldout = 0.2;   ///< shrink on held-out readings of a claim that is one
constexpr double unknown_belief = 0.8;  ///< ... or from which belief in an unknown cause
constexpr double rival_loss = 12.0;     ///< chi-squared a rival may lose
constexpr double rival_part = 0.04;     ///< ... or part of the contribution
constexpr double effect_prior = -3.2188758248682006;  ///< log 0.04: one effect in 25 is there

/// Chi-squared that an effect may lose against the claimed one and still be its rival.
inline double rival_limit(double contribution) {
    const double most = 0.3 * contribution;
    return std::min(most,
                    std::clamp(rival_part * contribution, rival_loss, std::max(rival_loss, most)));
}

}  // namespace trunnion::rules
