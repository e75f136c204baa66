#include "positioning/fixture_offset.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/alarm.h"
#include "base/units.h"
#include "offsets/axis_numbers.h"
#include "offsets/whole_parameter.h"

namespace trunnion::positioning {

namespace {

Axis group_axis(const offsets::Parameters& parameters, int number, const std::vector<Axis>& order,
                bool rotary) {
    const auto axis = offsets::axis_of_number(
        parameters, offsets::whole_parameter(parameters.get(number)), order);
    if (!axis || is_rotary(*axis) != rotary)
        throw Alarm(5459, fmt::format("MACHINE PARAMETER INCORRECT (No.{})", number));
    return *axis;
}

/// Groups of a usual rotary table: a + command turns the table left-handed about +X, +Y or +Z (ISO
/// 841).
std::vector<FixtureGroup> assumed_groups(const std::vector<Axis>& order) {
    constexpr FixtureGroup usual[] = {
        {Axis::C, Axis::Y, Axis::X}, {Axis::B, Axis::X, Axis::Z}, {Axis::A, Axis::Z, Axis::Y}};
    std::vector<FixtureGroup> groups;
    std::copy_if(std::begin(usual), std::end(usual), std::back_inserter(groups), [&](auto& group) {
        return std::find(order.begin(), order.end(), group.rotary) != order.end();
    });
    return groups;
}

bool has_groups(const offsets::Parameters& parameters) {
    for (int number = 7580; number <= 7588; ++number)
        if (parameters.find(number)) return true;
    return false;
}

std::vector<FixtureGroup> typed_groups(const offsets::Parameters& parameters,
                                       const std::vector<Axis>& order) {
    std::vector<FixtureGroup> groups;
    for (int number = 7580; number <= 7586; number += 3) {
        if (parameters.get(number) == 0.0) continue;
        const FixtureGroup group{group_axis(parameters, number, order, true),
                                 group_axis(parameters, number + 1, order, false),
                                 group_axis(parameters, number + 2, order, false)};
        if (group.from == group.to)
            throw Alarm(5459, fmt::format("MACHINE PARAMETER INCORRECT (No.{})", number + 2));
        groups.push_back(group);
    }
    return groups;
}

std::array<bool, axis_count> enabled_axes(const offsets::Parameters& parameters,
                                          const std::vector<Axis>& order) {
    std::array<bool, axis_count> enabled;
    const auto fax = parameters.entry.find(7575);
    enabled.fill(fax == parameters.entry.end() || fax->second.by_axis.empty());
    if (enabled[0]) return enabled;
    for (const auto& [number, bits] : fax->second.by_axis)
        if (const auto axis = offsets::axis_of_number(parameters, number, order))
            enabled[index_of(*axis)] = (static_cast<unsigned>(bits) & 1U) != 0;
    return enabled;
}

void turn(offsets::OffsetVector& v, const FixtureGroup& group, double angle_deg) {
    const double s = std::sin(rad_from_deg(angle_deg)), c = std::cos(rad_from_deg(angle_deg));
    const double from = v[group.from], to = v[group.to];
    v[group.from] = c * from - s * to;
    v[group.to] = s * from + c * to;
}

}  // namespace

FixtureSettings decode_fixture_settings(const offsets::Parameters& parameters,
                                        const std::vector<Axis>& axis_order) {
    FixtureSettings settings;
    settings.assumed = !has_groups(parameters);
    settings.groups =
        settings.assumed ? assumed_groups(axis_order) : typed_groups(parameters, axis_order);
    settings.enabled = enabled_axes(parameters, axis_order);
    return settings;
}

offsets::OffsetVector turned_fixture_offset(const FixtureSettings& settings,
                                            const offsets::FixtureOffset& fixture,
                                            const offsets::OffsetVector& machine) {
    offsets::OffsetVector v = fixture.offset;
    const auto& groups = settings.groups;
    for (auto group = groups.rbegin(); group != groups.rend(); ++group)
        turn(v, *group, -fixture.reference_angles[group->rotary]);
    for (const FixtureGroup& group : groups) turn(v, group, machine[group.rotary]);
    for (const Axis axis : all_axes)
        if (is_rotary(axis) || !settings.enabled[index_of(axis)]) v[axis] = 0.0;
    return v;
}

}  // namespace trunnion::positioning
