// The only line along which an axis was read (ISO 230-2): an angle of the axis, seen through the
// arm of the target, is its positioning there.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "diagnosis/groups/candidate_groups.h"

namespace trunnion::diagnosis {
namespace {

constexpr double along = 0.99;  ///< cosine between the component that is read and the axis

/// Device rows of each test.
std::map<std::string, std::vector<std::size_t>> rows_by_test(const Prepared& p) {
    std::map<std::string, std::vector<std::size_t>> tests;
    for (std::size_t i = 0; i < p.replay.size(); ++i)
        tests[p.table.rows[p.replay.table_row(i)].test].push_back(i);
    return tests;
}

/// True where only this axis moves, and a laser reads along it.
bool is_line_along(const Prepared& p, const std::vector<std::size_t>& rows,
                   const kinematics::AxisGeometry& moving) {
    const AxisPositions& first = p.replay.sample(rows.front()).position;
    for (const std::size_t i : rows) {
        const emulator::Contact& contact = p.replay.contact(i);
        if (contact.device != records::Device::linear ||
            std::abs(contact.direction_M.dot(moving.direction)) < along)
            return false;
        for (const Axis axis : all_axes)
            if (axis != moving.axis && p.replay.sample(i).position[axis] != first[axis])
                return false;
    }
    return true;
}

/// True where the target and the resting axes are the same in both tests.
bool is_same_line(const Prepared& p, std::size_t a, std::size_t b, Axis moving) {
    if (p.replay.contact(a).artefact != p.replay.contact(b).artefact) return false;
    for (const Axis axis : all_axes)
        if (axis != moving &&
            p.replay.sample(a).position[axis] != p.replay.sample(b).position[axis])
            return false;
    return true;
}

/// True where all tests in which the axis moves are along one line.
bool is_read_on_one_line(const Prepared& p, const kinematics::AxisGeometry& axis) {
    std::optional<std::size_t> line;
    for (const auto& [test, rows] : rows_by_test(p)) {
        const double at = p.replay.sample(rows.front()).position[axis.axis];
        if (std::all_of(rows.begin(), rows.end(), [&](std::size_t i) {
                return p.replay.sample(i).position[axis.axis] == at;
            }))
            continue;
        if (!is_line_along(p, rows, axis) ||
            (line && !is_same_line(p, *line, rows.front(), axis.axis)))
            return false;
        line = rows.front();
    }
    return line.has_value();
}

bool are_angles_of(const ColumnGroup& group, Axis axis) {
    if (group.kind == GroupKind::table)
        return group.table.motion == effects::EffectKind::angular && group.table.axis.axis == axis;
    return group.kind == GroupKind::textbook && group.effect->axis == axis &&
           group.effect->kind == effects::EffectKind::angular;
}

}  // namespace

void take_line_for_positioning(Design& design, const Prepared& prepared) {
    for (const kinematics::AxisGeometry& axis : prepared.base.setup.machine.chain.axes()) {
        if (axis.rotary || !is_read_on_one_line(prepared, axis)) continue;
        for (std::size_t k = 0; k < design.groups().size(); ++k)
            if (are_angles_of(design.group(k), axis.axis)) design.keep_as_positioning(k);
    }
}

}  // namespace trunnion::diagnosis
