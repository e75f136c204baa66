#include "diagnosis/measured_surface.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

/// The direction of all readings of one surface that was clamped once; none for other readings.
std::optional<Vector3> normal_of_surface(const Prepared& p) {
    constexpr double parallel = 0.999;
    if (p.replay.size() == 0 || p.replay.sessions().size() > 1) return {};
    const emulator::Contact& first = p.replay.contact(0);
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        const emulator::Contact& contact = p.replay.contact(i);
        if (contact.device != records::Device::point || contact.artefact != first.artefact ||
            std::abs(contact.direction_W.dot(first.direction_W)) < parallel)
            return {};
    }
    return first.direction_M;
}

bool is_form_of_path(const ColumnGroup& group) {
    using enum effects::EffectKind;
    if (!is_cause(group.kind)) return false;
    const effects::EffectKind motion = group.effect ? group.effect->kind : group.table.motion;
    return motion == straightness || motion == angular;
}

/// True for an error of an axis that moves along the surface.
bool goes_along(const Prepared& p, const ColumnGroup& group, const Vector3& normal) {
    constexpr double along = 0.5;
    const std::optional<Axis> axis = group.effect ? group.effect->axis : group.table.axis.axis;
    for (const kinematics::AxisGeometry& own : p.base.setup.machine.chain.axes())
        if (axis && own.axis == *axis && !own.rotary)
            return std::abs(own.direction.dot(normal)) < along;
    return false;
}

bool has_surface(const std::vector<std::string>& rivals) {
    return std::find(rivals.begin(), rivals.end(), form_of_surface) != rivals.end();
}

}  // namespace

void doubt_measured_surface(const Outcome& found, std::vector<Claim>& claims) {
    const auto normal = normal_of_surface(found.prepared);
    if (!normal) return;
    for (Claim& claim : claims) {
        const ColumnGroup& group = found.design.group(found.model.members[claim.position]);
        if (!is_form_of_path(group) || !goes_along(found.prepared, group, *normal)) continue;
        claim.probability = std::min(claim.probability, rules::claimed);
        if (!has_surface(claim.rivals)) claim.rivals.push_back(form_of_surface);
    }
}

void tell_measured_surface(const Outcome& found, std::vector<Cause>& causes) {
    if (!normal_of_surface(found.prepared)) return;
    for (Cause& cause : causes)
        if (has_surface(cause.rivals))
            cause.what +=
                ". Or the measured surface has this form: heights are surface minus axis, and it "
                "was read as it lies only. Turned or shifted (as another session) it would tell";
}

}  // namespace trunnion::diagnosis
