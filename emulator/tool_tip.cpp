#include "emulator/tool_tip.h"

#include <algorithm>

#include "positioning/rotary_transform.h"

namespace trunnion::emulator {

double tool_length_mm(const setup::Setup& setup, int tool) {
    if (const auto own = setup.tools.find(tool); own != setup.tools.end())
        return own->second.length_mm;
    const auto& tools = setup.stores.tools.tool;
    const auto n = static_cast<std::size_t>(std::max(0, tool));
    return n == 0 || n >= tools.size() ? 0.0 : tools[n].length_mm();
}

Vector3 physical_tip_S(const setup::Setup& setup, const motion::AxisMove& move,
                       double extension_mm) {
    if (setup.probe && setup.probe->tool != 0 && move.tool == setup.probe->tool)
        return setup.probe->tip_with(extension_mm);
    const double length_mm = tool_length_mm(setup, move.tool);
    if (length_mm == 0.0) return -move.tool_vector_mm;
    const Vector3 direction =
        move.transform ? move.transform->pivot().tool_direction : Vector3::UnitZ();
    return -length_mm * direction;
}

Contact tip_contact(const setup::Setup& setup, const motion::AxisMove& move) {
    Contact contact;
    contact.tip = true;
    contact.stylus =
        !setup.probe || setup.probe->tool == 0 || move.tool == 0 || move.tool == setup.probe->tool;
    return contact;
}

Vector3 physical_tip_W(const PhysicalState& state, const Vector3& tip_S_mm) {
    return state.poses.pose_MW.inverse() *
           (state.poses.pose_MS * (tip_S_mm + state.extra.tip_shift_mm));
}

}  // namespace trunnion::emulator
