#include "setup/control_machine.h"

#include "base/alarm.h"
#include "controller/settings.h"
#include "offsets/pivot_parameters.h"

namespace trunnion::setup {

namespace {

kinematics::AxisGeometry rotary(const offsets::PivotAxis& axis, const Vector3& point_mm) {
    kinematics::AxisGeometry geometry;
    geometry.axis = axis.axis;
    geometry.name = letter_of(axis.axis);
    geometry.rotary = true;
    geometry.direction = axis.direction();
    geometry.point_mm = point_mm;
    geometry.min = axis.min_rad;
    geometry.max = axis.max_rad;
    return geometry;
}

kinematics::AxisGeometry slide(Axis axis) {
    kinematics::AxisGeometry geometry;
    geometry.axis = axis;
    geometry.name = letter_of(axis);
    geometry.direction = Vector3::Unit(static_cast<int>(index_of(axis)));
    return geometry;
}

std::string text_of(const kinematics::Chain& chain) {
    std::string text = "w";
    for (auto axis = chain.work.rbegin(); axis != chain.work.rend(); ++axis)
        text += std::string(" ") + letter_of(axis->axis);
    text += " b";
    for (const kinematics::AxisGeometry& axis : chain.tool)
        text += std::string(" ") + letter_of(axis.axis);
    return text + " t";
}

/// Strokes and rapid speeds as the control has them: 1320, 1321, 1420.
void take_strokes(const offsets::Parameters& parameters, kinematics::Chain& chain) {
    std::vector<controller::ControlAxis> axes;
    for (const kinematics::AxisGeometry& axis : chain.axes())
        axes.push_back({axis.axis, axis.rotary, axis.min, axis.max, {}, {}});
    controller::sort_axes(axes, parameters);
    controller::take_strokes(axes, parameters);
    for (auto* side : {&chain.work, &chain.tool})
        for (kinematics::AxisGeometry& geometry : *side)
            for (const controller::ControlAxis& axis : axes) {
                if (axis.axis != geometry.axis) continue;
                geometry.min = axis.min;
                geometry.max = axis.max;
                if (axis.rapid_speed) geometry.max_speed = axis.rapid_speed;
            }
}

}  // namespace

Setup setup_of_control(const offsets::Stores& stores, const std::string& path) {
    const auto pivot = offsets::decode_pivot(stores.parameters);
    if (!pivot || pivot->first.hypothetical || pivot->second.hypothetical)
        throw InputError("these files name no two real rotary axes (19680-19690): give --setup",
                         {path});
    Setup setup;
    setup.name = path;
    setup.path = path;
    setup.stores = stores;
    kinematics::Chain& chain = setup.machine.chain;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) chain.tool.push_back(slide(axis));
    const Vector3 head = pivot->holder_offset_mm * pivot->tool_direction + pivot->tool_offset_mm;
    if (pivot->unit == offsets::MechanicalUnit::table_table)
        chain.work = {rotary(pivot->first, pivot->table_point_mm),
                      rotary(pivot->second, pivot->table_point_mm + pivot->table_offset_mm)};
    else
        chain.tool.push_back(rotary(pivot->first, head));
    if (pivot->unit == offsets::MechanicalUnit::mixed)
        chain.work = {rotary(pivot->second, pivot->table_point_mm)};
    if (pivot->unit == offsets::MechanicalUnit::tool_tool)
        chain.tool.push_back(rotary(pivot->second, head - pivot->tool_second_offset_mm));
    setup.chain_text = text_of(chain);
    take_strokes(stores.parameters, chain);
    return setup;
}

}  // namespace trunnion::setup
