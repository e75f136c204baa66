// Which pivot store is stale, its error, the values to enter, and what the readings cannot
// determine.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "base/finite.h"
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

/// One value that may be entered.
struct StoreVerdict {
    setup::StoreNumber in_force;
    Finite exact_mm = 0.0, type_mm = 0.0;
    Finite error_mm = 0.0;  ///< in force minus what is right; 0 in directions that nothing sees
    double sigma_mm = 0.0;
    bool stale = false;
};

/// One group of stores, over its functions.
struct GroupVerdict {
    PivotGroup group = PivotGroup::g54;
    bool measured = false;    ///< a function of this group was run
    Finite visible_um = 0.0;  ///< largest error over the maps that its stores cause
    double sigma_um = 0.0;    ///< of that
    Finite left_um = 0.0;     ///< after typing: tilts, axes that do not meet, the increment
    bool stale = false;
};

struct PivotVerdict {
    PivotFit fit;
    setup::RotaryStores in_force, right, typed;
    std::vector<StoreVerdict> stores;
    std::vector<GroupVerdict> groups;  ///< G54 (with a rotary table), P1970x
    std::vector<std::string> unobservable;
    double increment_mm = 0.001;
    double limit_um = 3.0;
    Finite agree_um = 0.0;  ///< largest difference of two functions at one pose after typing

    const GroupVerdict* find(PivotGroup group) const;
};

/// Input of a verdict.
struct PivotEvidence {
    kinematics::Machine known;  ///< without the errors to be found: nominal positions of the rotary
                                ///< axes
    setup::RotaryStores in_force;
    Vector3 sphere_mm = Vector3::Zero(), tip_S_mm = Vector3(0, 0, -150);
    double increment_mm = 0.001;
    double limit_um = 3.0;  ///< stores that cause less are not stale
    bool hurco = false;     ///< use the terms of its part set-up for what cannot be determined
};

PivotFit fit_pivot_machine(const PivotEvidence& evidence, const std::vector<PivotMap>& maps);

/// Throws InputError when the maps have too few points.
PivotVerdict judge_pivot(const PivotEvidence& evidence, const std::vector<PivotMap>& maps);

/// Adds expected errors and circles of all points by a machine; also the measured circles.
void add_expected(const PivotModel& model, const offsets::PivotParameters& pivot,
                  std::vector<PivotMap>& maps);

/// One plain sentence for each store group, in the terms of the dialect.
std::string sentence(const PivotVerdict& verdict, bool hurco);

}  // namespace trunnion::pivot
