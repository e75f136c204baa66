// G54.2: a fixture offset measured at reference angles, turned with the table.
#pragma once

#include <array>
#include <vector>

#include "geometry/axes.h"
#include "offsets/stores.h"

namespace trunnion::positioning {

/// One of the groups 7580-7588: a + turn of the rotary axis carries + of `from` to + of `to`.
struct FixtureGroup {
    Axis rotary;
    Axis from, to;
};

/// What G54.2 knows of the machine: groups in the order computed (nearest the work first) and the
/// linear axes that take the offset (7575#0 FAX). It never reads 19680-19714.
struct FixtureSettings {
    std::vector<FixtureGroup> groups;
    bool assumed = false;  ///< 7580-7588 are absent: a left-handed table's groups by axis letter
    std::array<bool, axis_count> enabled{};
};

/// Throws Alarm 5459 when a group names axes that cannot be. `axis_order`: the control's axes.
FixtureSettings decode_fixture_settings(const offsets::Parameters& parameters,
                                        const std::vector<Axis>& axis_order);

/// The offset vector in force (mm, along M axes): R(angles) R(reference)^-1 offset, with R = group
/// 3 * group 2 * group 1. `machine`: machine coordinates, mm and deg.
offsets::OffsetVector turned_fixture_offset(const FixtureSettings& settings,
                                            const offsets::FixtureOffset& fixture,
                                            const offsets::OffsetVector& machine);

}  // namespace trunnion::positioning
