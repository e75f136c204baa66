// Which pivot store is stale, its error, the values to enter, and what the readings cannot
// determine.
#pragma once

#include <string>
#include <vector>

#include "base/finite.h"
#include "pivot/pivot_fit.h"

namespace trunnion::pivot {

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

/// Throws InputError when the maps have too few points.
PivotVerdict judge_pivot(const PivotEvidence& evidence, const std::vector<PivotMap>& maps);

/// Adds expected errors and circles of all points by a machine; also the measured circles.
void add_expected(const PivotModel& model, const offsets::PivotParameters& pivot,
                  std::vector<PivotMap>& maps);

/// One plain sentence for each store group, in the terms of the dialect.
std::string sentence(const PivotVerdict& verdict, bool hurco);

}  // namespace trunnion::pivot
