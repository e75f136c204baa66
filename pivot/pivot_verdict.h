// Which pivot store is stale, by how much, what to type, and what no reading here can tell.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "pivot/pivot_maps.h"

namespace trunnion::pivot {

/// One unknown of the machine: a shift (mm) or a turn (rad) of a rotary axis's line, or a shift of
/// the stylus ball in the spindle frame.
struct LineUnknown {
    std::optional<Axis> axis;  ///< nothing: of the stylus ball
    bool tilt = false;
    Vector3 direction = Vector3::UnitX();  ///< along or about it, in M
    std::string name;
};

/// The machine behind error maps: two positions and two tilts of each rotary axis (of a head also
/// where the stylus ball hangs under it), fitted to all points together with
/// one free vector for each zeroing of the sphere (its scatter).
struct PivotFit {
    kinematics::Machine machine;  ///< the known machine with the fitted location errors added
    std::vector<LineUnknown> unknowns;
    Eigen::MatrixXd covariance;       ///< of the unknowns, mm and rad
    std::vector<std::size_t> unseen;  ///< unknowns that change no reading
    double noise_um = 0.0;            ///< of one found centre along one axis, from the residuals
    double zero_scatter_um = 0.0;     ///< of the zeroings along one axis; 0 for fewer than two
    int zeroings = 0;
};

/// `machine` with one unknown moved.
kinematics::Machine moved(kinematics::Machine machine, const LineUnknown& unknown, double value);

/// One number that may be typed.
struct StoreVerdict {
    setup::StoreNumber in_force;
    double exact_mm = 0.0, type_mm = 0.0;
    double error_mm = 0.0;  ///< in force minus what is right; 0 in directions that nothing sees
    double sigma_mm = 0.0;
    bool stale = false;
};

/// One group of stores over its functions.
struct GroupVerdict {
    PivotGroup group = PivotGroup::g54;
    bool measured = false;    ///< a function of this group was run
    double visible_um = 0.0;  ///< largest error over the maps that its stores cause
    double sigma_um = 0.0;    ///< of that
    double left_um = 0.0;     ///< after typing: tilts, axes that do not meet, the increment
    bool stale = false;
};

struct PivotVerdict {
    PivotFit fit;
    setup::RotaryStores in_force, right, typed;
    std::vector<StoreVerdict> stores;
    std::vector<GroupVerdict> groups;  ///< G54 (of a rotary table), P1970x
    std::vector<std::string> unobservable;
    double increment_mm = 0.001;
    double limit_um = 3.0;
    double agree_um = 0.0;  ///< largest difference of two functions at one pose after typing

    const GroupVerdict* find(PivotGroup group) const;
};

/// What a verdict starts from.
struct PivotEvidence {
    kinematics::Machine known;  ///< without what is to be found: nominal places of the rotary axes
    setup::RotaryStores in_force;
    Vector3 sphere_mm = Vector3::Zero(), tip_S_mm = Vector3(0, 0, -150);
    double increment_mm = 0.001;
    double limit_um = 3.0;  ///< a store that causes less is no stale one
    bool hurco = false;     ///< what cannot be told is said in the words of its part set-up
};

PivotFit fit_pivot_machine(const PivotEvidence& evidence, const std::vector<PivotMap>& maps);

/// Throws InputError when the maps hold too few points to say anything.
PivotVerdict judge_pivot(const PivotEvidence& evidence, const std::vector<PivotMap>& maps);

/// Expected errors and circles of all points by a machine; measured circles too.
void add_expected(const PivotModel& model, const offsets::PivotParameters& pivot,
                  std::vector<PivotMap>& maps);

/// One plain sentence for each store group, in the words of the dialect.
std::string sentence(const PivotVerdict& verdict, bool hurco);

}  // namespace trunnion::pivot
