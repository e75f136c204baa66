#include "controller/tool_vector.h"

#include "controller/alarms.h"

namespace trunnion::controller {

Vector3 tool_vector(const SortedWords& words) {
    const Vector3 vector(words.get('I', 0.0), words.get('J', 0.0), words.get('K', 0.0));
    if (vector.norm() < 1e-9)
        raise_alarm(5421, "(I J K is no direction)", words.column_of_first(tool_vector_letters));
    return vector;
}

AxisPositions with_tool_along(const Vector3& n_W, const SortedWords& words, const Modal& modal,
                              const Frames& frames, const AxisPositions& axes) {
    const positioning::RotaryTransform& transform = *frames.believed.transform;
    const positioning::RotarySolution present = transform.rotaries(frames.axes);
    const positioning::RotaryTravel travel = frames.rotary_travel(modal.settings);
    const bool hurco = modal.settings.is_hurco();
    const positioning::Branch branch =
        hurco ? modal.tilt.value_or(modal.settings.hurco.tilt) : positioning::Branch::nearest;
    positioning::RotaryChoice choice =
        positioning::choose_rotaries(transform, n_W, present, travel, branch);
    if (!choice.chosen && hurco)
        choice = positioning::choose_rotaries(transform, n_W, present, travel);
    if (!choice.chosen)
        raise_alarm(5421, "(no rotary position for this tool axis)",
                    words.column_of_first(tool_vector_letters));
    return transform.with_rotaries(axes, *choice.chosen);
}

bool leads_tool(const SortedWords& words, const Modal& modal, const TipControl& tip) {
    if (!tip.in_force || !(words.present & tool_vector_letters)) return false;
    if (tip.by_vector) return true;
    const int code = modal.codes[ModalGroup::motion];
    return tip.by_angle_or_vector && !modal.in_cycle() && (code == 0 || code == 10);
}

}  // namespace trunnion::controller
