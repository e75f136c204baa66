// Parameters of ISO 230-2:2014 for the positioning of one axis: B, M, E, R, A.
#pragma once

#include <string>
#include <vector>

#include "records/readings.h"

namespace trunnion::records {

/// One measured deviation, actual - target, mm or rad.
struct DeviationPoint {
    double target = 0.0;
    int direction = 0;  ///< direction of approach, +1 or -1
    double deviation = 0.0;
};

/// One target position: mean and standard deviation (divisor n - 1) of each direction. NaN when a
/// direction has no value, or for the deviation of a single value.
struct TargetFigures {
    double target = 0.0;
    double mean_up = 0.0, mean_down = 0.0, s_up = 0.0, s_down = 0.0;
    int n_up = 0, n_down = 0;
    double reversal() const { return mean_up - mean_down; }
    double mean() const { return 0.5 * (mean_up + mean_down); }
};

/// All in the unit of the deviations. NaN for parameters that the points do not determine: B, M and
/// the bi-directional ones need both directions, R and A need repeats.
struct Iso230Figures {
    std::vector<TargetFigures> targets;
    double reversal_B = 0.0;        ///< mean up - mean down with the largest magnitude
    double mean_reversal = 0.0;     ///< mean of (mean up - mean down) over the targets
    double mean_deviation_M = 0.0;  ///< range of the bi-directional means
    double systematic_E = 0.0;      ///< range of the unidirectional means of both directions
    double systematic_E_up = 0.0, systematic_E_down = 0.0;
    double repeatability_R = 0.0;  ///< maximum of 2 s_up + 2 s_down + |B_i|, 4 s_up, 4 s_down
    double repeatability_R_up = 0.0, repeatability_R_down = 0.0;  ///< maximum of 4 s
    double accuracy_A = 0.0;  ///< range of mean +- 2 s over both directions
    double accuracy_A_up = 0.0, accuracy_A_down = 0.0;
};

/// Source: ISO 230-2:2014, clauses 3.10 to 3.22. Points belong to the same target when their target
/// values are equal.
Iso230Figures iso230_2_figures(const std::vector<DeviationPoint>& points);
/// "B 12.3 um, M 4.0, E 14.1, R 2.0, A 15.9 um"; arcsec for a rotary axis. With values in one
/// direction: E, R and A of this direction.
std::string iso230_2_words(const Iso230Figures& figures, bool rotary);

/// The points of the `linear` and `angle` rows of a test. Targets are positions of the one axis
/// that moves in the test. Throws InputError with position when no axis or several axes move.
std::vector<DeviationPoint> deviation_points(const ReadingTable& table, const std::string& test);

}  // namespace trunnion::records
