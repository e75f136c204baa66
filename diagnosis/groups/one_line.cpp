// The only line along which an axis was read (ISO 230-2), or several that see it through the same
// arm: an angle of the axis is its positioning there.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "diagnosis/groups/candidate_groups.h"
#include "diagnosis/rules/rules.h"

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

struct Lines {
    bool only = false;  ///< all tests in which the axis moves are lines along it
    bool same = true;   ///< ... and one and the same
};

Lines lines_along(const Prepared& p, const kinematics::AxisGeometry& axis) {
    std::optional<std::size_t> line;
    Lines lines;
    for (const auto& [test, rows] : rows_by_test(p)) {
        const double at = p.replay.sample(rows.front()).position[axis.axis];
        if (std::all_of(rows.begin(), rows.end(), [&](std::size_t i) {
                return p.replay.sample(i).position[axis.axis] == at;
            }))
            continue;
        if (!is_line_along(p, rows, axis)) return {};
        if (line && !is_same_line(p, *line, rows.front(), axis.axis)) lines.same = false;
        line = rows.front();
    }
    lines.only = line.has_value();
    return lines;
}

bool are_angles_of(const ColumnGroup& group, Axis axis) {
    if (group.kind == GroupKind::table)
        return group.table.motion == effects::EffectKind::angular && group.table.axis.axis == axis;
    return group.kind == GroupKind::textbook && group.effect->axis == axis &&
           group.effect->kind == effects::EffectKind::angular;
}

/// True where what angles in proportion to the position do is a scale, on all lines: an axis that
/// rests beside the moving one may carry neither the target nor the moving one's slide, and then
/// the arm is the same wherever it rests.
bool have_one_arm(const Design& design, Axis axis) {
    constexpr double none = 1e-6;  // of the squared columns
    std::vector<Eigen::Index> scale;
    for (const auto& entry : design.groups())
        if (entry.group.kind == GroupKind::textbook && entry.group.effect->axis == axis &&
            entry.group.effect->kind == effects::EffectKind::scale && !entry.group.is_change())
            scale = entry.group.features;
    if (scale.empty()) return false;
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        const ColumnGroup& group = design.group(k);
        if (group.kind == GroupKind::textbook && !group.unnamed && !group.is_change() &&
            are_angles_of(group, axis))
            return design.outside(k, scale) < none;
    }
    return false;
}

}  // namespace

void take_line_for_positioning(Design& design, const Prepared& prepared) {
    for (const kinematics::AxisGeometry& axis : prepared.base.setup.machine.chain.axes()) {
        if (axis.rotary) continue;
        const Lines lines = lines_along(prepared, axis);
        if (!lines.only || !(lines.same || have_one_arm(design, axis.axis))) continue;
        for (std::size_t k = 0; k < design.groups().size(); ++k)
            if (are_angles_of(design.group(k), axis.axis)) design.keep_as_positioning(k);
    }
}

void take_radius_for_stretch(Design& design) {
    constexpr double alike = 1e-3;  // of the squared columns
    const auto textbook = [&](std::size_t k, effects::EffectKind kind) {
        const ColumnGroup& group = design.group(k);
        return group.kind == GroupKind::textbook && group.effect->kind == kind &&
               !group.is_change();
    };
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        if (!textbook(k, effects::EffectKind::machine_expansion)) continue;
        for (std::size_t r = 0; r < design.groups().size(); ++r)
            if (textbook(r, effects::EffectKind::probe_radius) &&
                design.groups()[r].moves_readings() &&
                design.outside(k, design.group(r).features) < alike) {
                design.keep_as_rival(k);
                design.favour(k, rules::far_off);
                break;
            }
    }
}

}  // namespace trunnion::diagnosis
