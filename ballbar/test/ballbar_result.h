// The eight location errors with standard uncertainties, in the two ways they are quoted.
#pragma once

#include <vector>

#include "ballbar/test/ballbar_fit.h"
#include "ballbar/test/ballbar_published.h"

namespace trunnion::ballbar::test {

struct ErrorEstimate {
    kinematics::ErrorName name;
    double value = 0.0;  ///< mm or rad
    double sigma = 0.0;  ///< standard uncertainty, mm or rad
};

/// `nominal` with the fitted location errors added.
kinematics::Machine machine_of(const kinematics::Machine& nominal, const BallbarFit& fit);

/// As the setup file means them: at point_mm, in the frame of the carrier.
std::vector<ErrorEstimate> chain_estimates(const BallbarFit& fit, double reading_sigma_mm);

/// Lines of both axes of a machine with errors as the paper means them: in M, all axes at zero, at
/// the nominal intersection.
std::vector<NamedError> lines_at_intersection(const kinematics::Machine& nominal,
                                              const kinematics::Machine& machine);

/// The fitted ones with their uncertainty.
std::vector<ErrorEstimate> intersection_estimates(const kinematics::Machine& nominal,
                                                  const BallbarFit& fit, double reading_sigma_mm);

/// X Y Z of a control that knows the errors in `known`: the cup goes where the programmed position
/// would put it on the table of a machine without them. Rotary positions are kept.
AxisPositions compensated(const AxisPositions& programmed, const kinematics::Machine& nominal,
                          const kinematics::Machine& known, const Vector3& cup_S_mm);

}  // namespace trunnion::ballbar::test
