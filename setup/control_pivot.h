// Comparison of the pivot in the stores of a control with a measured one.
#pragma once

#include <optional>
#include <string>

#include "geometry/pose.h"
#include "offsets/stores.h"

namespace trunnion::setup {

/// The pivot of a rotary table: the point of the second axis nearest to the first, in machine
/// coordinates, mm, all axes at zero.
struct PivotAgreement {
    Vector3 parameters_mm = Vector3::Zero();  ///< from 19700-19705
    Vector3 g54_mm = Vector3::Zero();         ///< G54 plus the external offset
    std::optional<Vector3> measured_mm;

    /// The largest distance between two of the points.
    double apart_mm() const;
    /// True when they agree within half a least increment of 0.001 mm on each axis.
    bool agrees() const;
};

/// Throws InputError at `path` unless 19680 describes a machine with both rotary axes in the table.
PivotAgreement compare_pivots(const offsets::Stores& stores,
                              const std::optional<Vector3>& measured_mm, const std::string& path);
/// One line: each point, and their largest distance.
std::string text_of(const PivotAgreement& agreement);

}  // namespace trunnion::setup
