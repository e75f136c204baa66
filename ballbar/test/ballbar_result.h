// The eight location errors with standard uncertainties, in both definitions.
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

/// In the definition of the setup file: at point_mm, in the frame of the carrier.
std::vector<ErrorEstimate> chain_estimates(const BallbarFit& fit, double reading_sigma_mm);

/// Lines of both axes of a machine with errors in the definition of the paper: in M, all axes at
/// zero, at the nominal intersection.
std::vector<NamedError> lines_at_intersection(const kinematics::Machine& nominal,
                                              const kinematics::Machine& machine);

/// The fitted errors with their uncertainty.
std::vector<ErrorEstimate> intersection_estimates(const kinematics::Machine& nominal,
                                                  const BallbarFit& fit, double reading_sigma_mm);

/// X Y Z commanded by a control that knows the errors in `known`: the cup moves to the point of the
/// table where the programmed position would put it on an error-free machine. Rotary positions are
/// kept.
AxisPositions compensated(const AxisPositions& programmed, const kinematics::Machine& nominal,
                          const kinematics::Machine& known, const Vector3& cup_S_mm);

}  // namespace trunnion::ballbar::test
