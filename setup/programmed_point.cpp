#include "setup/programmed_point.h"

#include "base/alarm.h"
#include "positioning/rotary_transform.h"

namespace trunnion::setup {

namespace {

std::optional<RotaryStores> stores_of(const Setup& setup) {
    try {
        return rotary_stores(setup.machine.chain, setup.stores);
    } catch (const Alarm&) {  // a program that uses them stops with this alarm
        return std::nullopt;
    }
}

/// By the offset of the probe; its physical length where the control has none.
Vector3 believed_tool_mm(const Setup& setup, const Vector3& along) {
    const double length_mm = probe_length_mm(setup);
    return length_mm > 0.0 ? Vector3(length_mm * along) : Vector3(-setup.probe->tip_S_mm);
}

bool by_g54(PositioningMode mode) {
    return mode == PositioningMode::dpp || mode == PositioningMode::rtdfo;
}

}  // namespace

int probe_offset(const ProbeSettings& probe) {
    return probe.tool > 0 ? probe.tool : 1;
}

double probe_length_mm(const Setup& setup) {
    const auto number = static_cast<std::size_t>(probe_offset(*setup.probe));
    const auto& tools = setup.stores.tools.tool;
    return number < tools.size() ? tools[number].length_mm() : 0.0;
}

ProgrammedPoint::ProgrammedPoint(const Setup& setup, const std::optional<RotaryStores>& stores,
                                 std::optional<double> length_mm)
    : stores_(stores) {
    if (!setup.probe) stores_.reset();
    if (!stores_) return;
    const Vector3& along = stores_->pivot.tool_direction;
    tool_mm_ = length_mm ? Vector3(*length_mm * along) : believed_tool_mm(setup, along);
}

ProgrammedPoint::ProgrammedPoint(const Setup& setup) : ProgrammedPoint(setup, stores_of(setup)) {}

std::optional<Vector3> ProgrammedPoint::at(PositioningMode mode, const AxisPositions& machine,
                                           double extension_mm) const {
    if (!stores_ || mode == PositioningMode::none) return std::nullopt;
    offsets::PivotParameters pivot = stores_->pivot;
    if (by_g54(mode)) {
        pivot.table_point_mm = stores_->g54;
        pivot.table_offset_mm = Vector3::Zero();
    }
    const Vector3 tool_mm = tool_mm_ + extension_mm * pivot.tool_direction;
    return positioning::RotaryTransform(pivot).tip_W(machine, tool_mm);
}

}  // namespace trunnion::setup
