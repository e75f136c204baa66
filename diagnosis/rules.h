// The thresholds of the verdict in one place; docs/diagnosis.md says why.
#pragma once

#include <algorithm>

namespace trunnion::diagnosis::rules {

// Priors of being there, in nats.
constexpr double effect_prior = -3.2188758248682006;  ///< ln 0.04: a catalogue effect
constexpr double table_prior = -3.912023005428146;    ///< ln 0.02: free form, driver

// A gap is there when the evidence says so and readings left out say so.
constexpr double least_evidence = 3.0;   ///< nats of the whole model
constexpr double plain_evidence = 15.0;  ///< ... from which left-out blocks need not agree
constexpr double least_t = 2.0;          ///< of the loss saved on left-out blocks
constexpr double least_saving = 0.02;    ///< of the noise variance
constexpr double least_driver = 0.08;    ///< of the noise variance: a driver alone makes a gap
constexpr double large_zero = 1.0;       ///< rms of a zero, in sigma, that is part of the gap

constexpr double explained = 0.8, partly = 0.5;  ///< of H
constexpr double between_part = 0.2;   ///< of the gap that tables carry which do not interpolate
constexpr double between_least = 0.5;  ///< part that a table must predict at places left out

constexpr double least_share = 0.05;  ///< of the gap: below it an effect is background ...
constexpr double least_rms = 0.7;     ///< ... unless it moves the readings by this many sigma
constexpr double most_own = 3.0;      ///< sum of squares of parts that cancel
constexpr double main_family = 0.6;   ///< of an axis's free forms: below, none is named

constexpr double most_outliers = 0.04;  ///< of the readings
constexpr double driver_p = 1e-4;       ///< chance level at which a driver counts
constexpr double driver_share = 0.05;
constexpr double rival_loss = 12.0;  ///< chi-squared a rival may lose
constexpr double rival_part = 0.04;  ///< ... or part of the contribution

/// Chi-squared that an effect may lose against the claimed one and still be its rival.
inline double rival_limit(double contribution) {
    const double most = 0.3 * contribution;
    return std::min(most,
                    std::clamp(rival_part * contribution, rival_loss, std::max(rival_loss, most)));
}

}  // namespace trunnion::diagnosis::rules
