#include "setup/control_machine.h"

#include <algorithm>

#include "base/alarm.h"
#include "controller/settings.h"
#include "offsets/axis_numbers.h"
#include "offsets/pivot_parameters.h"
#include "setup/control_axes.h"

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
    // Only X, Y and Z have the direction of their number; 1022 gives that of a parallel axis.
    if (index_of(axis) < 3) geometry.direction = Vector3::Unit(static_cast<int>(index_of(axis)));
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

/// Stroke limits and rapid speeds of the control: 1320, 1321, 1420.
void take_strokes(Setup& setup) {
    std::vector<controller::ControlAxis> axes;
    for (const kinematics::AxisGeometry& axis : control_axes(setup))
        axes.push_back({axis.axis, axis.rotary, axis.min, axis.max, {}, {}});
    controller::sort_axes(axes, setup.stores.parameters);
    controller::take_strokes(axes, setup.stores.parameters);
    kinematics::Chain& chain = setup.machine.chain;
    for (auto* group : {&chain.work, &chain.tool, &setup.auxiliary})
        for (kinematics::AxisGeometry& geometry : *group)
            for (const controller::ControlAxis& axis : axes) {
                if (axis.axis != geometry.axis) continue;
                if (axis.min < axis.max) {  // else 1320 and 1321 alone stop it
                    geometry.min = axis.min;
                    geometry.max = axis.max;
                }
                if (axis.rapid_speed) geometry.max_speed = axis.rapid_speed;
            }
}

/// The letters of 1020 by axis number; X Y Z without it.
std::vector<Axis> named_axes(const offsets::Parameters& parameters) {
    std::vector<Axis> axes;
    if (const auto names = parameters.entry.find(1020); names != parameters.entry.end())
        for (const auto& [number, code] : names->second.by_axis)
            if (const auto axis = axis_of(static_cast<char>(code))) axes.push_back(*axis);
    return axes.empty() ? std::vector{Axis::X, Axis::Y, Axis::Z} : axes;
}

/// U, V, W beside X, Y, Z by 1022 carry the tool with them; an axis that no parameter places is
/// auxiliary.
void add_other_axes(Setup& setup) {
    kinematics::Chain& chain = setup.machine.chain;
    const std::vector<Axis> named = named_axes(setup.stores.parameters);
    const ParallelAxes parallel = offsets::parallel_axes(setup.stores.parameters, named);
    for (const Axis axis : named) {
        if (chain.find(axis)) continue;
        kinematics::AxisGeometry geometry = slide(axis);
        geometry.rotary = is_rotary(axis);
        const bool beside = index_of(axis) >= index_of(Axis::U) &&
                            parallel.beside[index_of(axis) - index_of(Axis::U)] >= 0;
        if (beside)
            geometry.direction = Vector3::Unit(parallel.beside[index_of(axis) - index_of(Axis::U)]);
        if (beside)
            chain.tool.insert(chain.tool.begin(), geometry);
        else
            setup.auxiliary.push_back(geometry);
    }
}

/// The table of a pitch compensation the other way round; of a rotary axis over one turn to either
/// side.
kinematics::ErrorCurve compensated_error(const offsets::AxisCompensation& one, double along) {
    kinematics::ErrorCurve curve;
    const int turns = one.turn > 0.0 ? 1 : 0;
    for (int turn = -turns; turn <= turns; ++turn)
        for (std::size_t i = 0; i < one.at.size(); ++i) {
            const double at = one.at[i] + turn * one.turn;
            if (!curve.at.empty() && at <= curve.at.back() + 1e-9) continue;
            curve.at.push_back(at);
            curve.value.push_back(-along * one.value[i]);
        }
    return curve;
}

/// The builder measured what 1851 and the pitch data take away: the machine is assumed to have it.
void assume_compensated_errors(Setup& setup) {
    for (const offsets::AxisCompensation& one : compensated_axes(setup)) {
        const kinematics::AxisGeometry* axis = setup.machine.chain.find(one.axis);
        if (!axis) continue;
        if (one.backlash != 0.0)
            setup.effects.push_back({axis->name + ".backlash",
                                     {{axis->rotary ? "gap_rad" : "gap_mm", {-one.backlash}}}});
        if (one.at.empty()) continue;
        auto& motion = setup.machine.errors.axis[index_of(one.axis)].motion;
        for (std::size_t k = 0; k < 3; ++k)
            if (const double along = axis->direction[static_cast<Eigen::Index>(k)]; along != 0.0)
                motion[k + (axis->rotary ? 3 : 0)] = compensated_error(one, along);
    }
}

void add_slides(const std::vector<Axis>& named, kinematics::Chain& chain) {
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        if (std::find(named.begin(), named.end(), axis) != named.end())
            chain.tool.push_back(slide(axis));
}

/// Lines of the rotary axes by 19680-19714.
void add_rotary_axes(const offsets::PivotParameters& pivot, kinematics::Chain& chain) {
    const Vector3 head = pivot.holder_offset_mm * pivot.tool_direction + pivot.tool_offset_mm;
    if (pivot.unit == offsets::MechanicalUnit::table_table)
        chain.work = {rotary(pivot.first, pivot.table_point_mm),
                      rotary(pivot.second, pivot.table_point_mm + pivot.table_offset_mm)};
    else
        chain.tool.push_back(rotary(pivot.first, head));
    if (pivot.unit == offsets::MechanicalUnit::mixed)
        chain.work = {rotary(pivot.second, pivot.table_point_mm)};
    if (pivot.unit == offsets::MechanicalUnit::tool_tool)
        chain.tool.push_back(rotary(pivot.second, head - pivot.tool_second_offset_mm));
}

}  // namespace

bool has_rotary_geometry(const offsets::Stores& stores) {
    const auto pivot = offsets::decode_pivot(stores.parameters);
    return pivot && !pivot->first.hypothetical && !pivot->second.hypothetical;
}

Setup setup_of_control(const offsets::Stores& stores, const std::string& path) {
    const auto pivot = offsets::decode_pivot(stores.parameters);
    if (pivot && !has_rotary_geometry(stores))
        throw InputError(
            "one of the rotary axes of 19680 is hypothetical, which a setup cannot express",
            {path});
    Setup setup;
    setup.name = path;
    setup.path = path;
    setup.stores = stores;
    add_slides(named_axes(stores.parameters), setup.machine.chain);
    if (pivot) add_rotary_axes(*pivot, setup.machine.chain);
    add_other_axes(setup);
    setup.chain_text = text_of(setup.machine.chain);
    take_strokes(setup);
    assume_compensated_errors(setup);
    return setup;
}

}  // namespace trunnion::setup
