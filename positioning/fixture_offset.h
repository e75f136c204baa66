// G54.2: a fixture offset measured at reference angles that turns with the table.
#pragma once

#include <array>
#include <vector>

#include "geometry/axes.h"
#include "offsets/stores.h"

namespace trunnion::positioning {

/// One group of parameters 7580-7588: a + rotation of `rotary` turns the + direction of `from`
/// towards the + direction of `to`.
struct FixtureGroup {
    Axis rotary;
    Axis from, to;
};

/// Parameters of G54.2: the groups in the order of computation (nearest the workpiece first) and
/// the linear axes that take the offset (7575#0 FAX). Parameters 19680-19714 are not used.
struct FixtureSettings {
    std::vector<FixtureGroup> groups;
    bool assumed = false;  ///< 7580-7588 are absent: groups of a left-handed table, by axis letter
    std::array<bool, axis_count> enabled{};
};

/// Decodes 7575 and 7580-7588. Throws Alarm 5459 when a group names an axis that does not exist or
/// is of the wrong kind. `axis_order`: the axes of the control, number 1 first.
FixtureSettings decode_fixture_settings(const offsets::Parameters& parameters,
                                        const std::vector<Axis>& axis_order);

/// The offset vector in force, mm along the axes of M: R(angles) R(reference)^-1 offset, with R =
/// group 3 * group 2 * group 1. Rotary components and disabled axes are 0. `machine`: machine
/// coordinates, mm and deg.
offsets::OffsetVector turned_fixture_offset(const FixtureSettings& settings,
                                            const offsets::FixtureOffset& fixture,
                                            const offsets::OffsetVector& machine);

}  // namespace trunnion::positioning
