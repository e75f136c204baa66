// Fit of a machine to error maps: Gauss-Newton with a free vector for each zeroing.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "pivot/pivot_maps.h"

namespace trunnion::pivot {

/// One unknown of the machine: a shift (mm) or rotation (rad) of a rotary axis line, or a shift of
/// the stylus ball in the spindle frame.
struct LineUnknown {
    std::optional<Axis> axis;  ///< empty: the stylus ball
    bool tilt = false;
    Vector3 direction = Vector3::UnitX();  ///< direction of the shift or axis of the rotation, in M
    std::string name;
};

/// Machine fitted to error maps: two positions and two tilts of each rotary axis (for a head also
/// the stylus ball position), fitted to all points simultaneously, with one free vector (scatter)
/// for each zeroing of the sphere.
struct PivotFit {
    kinematics::Machine machine;  ///< the known machine with the fitted location errors added
    std::vector<LineUnknown> unknowns;
    Eigen::MatrixXd covariance;       ///< of the unknowns, mm and rad
    std::vector<std::size_t> unseen;  ///< unknowns that change no reading
    double noise_um = 0.0;            ///< of one measured centre along one axis, from the residuals
    double zero_scatter_um = 0.0;     ///< scatter of the zeroings along one axis; 0 for fewer than
                                      ///< two
    int zeroings = 0;
};

/// `machine` with one unknown changed by `value` (mm or rad).
kinematics::Machine moved(kinematics::Machine machine, const LineUnknown& unknown, double value);

/// What a fit and its verdict start from.
struct PivotEvidence {
    kinematics::Machine known;  ///< without the errors to be found: nominal positions of the rotary
                                ///< axes
    setup::RotaryStores in_force;
    Vector3 sphere_mm = Vector3::Zero(), tip_S_mm = Vector3(0, 0, -150);
    double increment_mm = 0.001;
    double limit_um = 3.0;  ///< stores that cause less are not stale
    bool hurco = false;     ///< use the terms of its part set-up for what cannot be determined
};

/// Throws InputError when the maps have too few points.
PivotFit fit_pivot_machine(const PivotEvidence& evidence, const std::vector<PivotMap>& maps);

}  // namespace trunnion::pivot
