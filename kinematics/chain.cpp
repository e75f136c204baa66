#include "kinematics/chain.h"

#include <algorithm>
#include <string>

#include "base/alarm.h"

namespace trunnion {
namespace {

Vector3 unit_of(Axis axis) {
    return Vector3::Unit(static_cast<Eigen::Index>(index_of(axis) % 3));
}

/// + moves the tool; a table axis therefore moves the work the other way (ISO 841).
AxisGeometry default_geometry(Axis axis, bool carries_work) {
    AxisGeometry geometry;
    geometry.axis = axis;
    geometry.rotary = is_rotary(axis);
    geometry.direction = carries_work ? Vector3(-unit_of(axis)) : unit_of(axis);
    return geometry;
}

std::vector<std::string_view> split(std::string_view text) {
    std::vector<std::string_view> parts;
    std::size_t i = 0;
    while ((i = text.find_first_not_of(" \t", i)) != std::string_view::npos) {
        const std::size_t end = std::min(text.find_first_of(" \t", i), text.size());
        parts.push_back(text.substr(i, end - i));
        i = end;
    }
    return parts;
}

Axis chain_axis(std::string_view part, const Chain& so_far) {
    const auto axis = part.size() == 1 ? axis_of(part[0]) : std::nullopt;
    if (!axis)
        throw InputError("'" + std::string(part) +
                         "' is not an axis letter in the chain (XYZABCUVW)");
    if (so_far.find(*axis))
        throw InputError(std::string("axis ") + letter_of(*axis) + " stands twice in the chain");
    return *axis;
}

}  // namespace

const AxisGeometry* Chain::find(Axis axis) const {
    for (const auto* side : {&work, &tool})
        for (const AxisGeometry& geometry : *side)
            if (geometry.axis == axis) return &geometry;
    return nullptr;
}

std::vector<AxisGeometry> Chain::axes() const {
    std::vector<AxisGeometry> all;
    for (const Axis axis : all_axes)
        if (const AxisGeometry* geometry = find(axis)) all.push_back(*geometry);
    return all;
}

Chain parse_chain(std::string_view text) {
    const std::vector<std::string_view> parts = split(text);
    const auto bed = std::find(parts.begin(), parts.end(), "b");
    if (parts.size() < 3 || parts.front() != "w" || parts.back() != "t" || bed == parts.end())
        throw InputError("a chain reads 'w AXES b AXES t', e.g. 'w C B b X Y Z t'");
    Chain chain;
    for (auto part = bed - 1; part != parts.begin();
         --part)  // nearest the bed is the first carrier
        chain.work.push_back(default_geometry(chain_axis(*part, chain), true));
    for (auto part = bed + 1; part != parts.end() - 1; ++part)
        chain.tool.push_back(default_geometry(chain_axis(*part, chain), false));
    return chain;
}

}  // namespace trunnion
