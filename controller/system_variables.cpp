#include "controller/system_variables.h"

#include "controller/five_axis.h"
#include "controller/offset_variables.h"
#include "controller/state_variables.h"

namespace trunnion {

ControlPosition work_position(const ControlState& c) {
    ControlPosition out = c.coordinates.shaped_from_program(c.program);
    if (!c.settings.work_positions_with_length) return out;
    const ControlPosition length = shown_tool_length(c);
    for (std::size_t i = 0; i < axis_count; ++i) out.value[i] += length.value[i];
    return out;
}

double ControlVariables::get(int number) {
    double value = 0.0;
    if (number >= 5061 && number <= 5080) c_.result.reads_skip = true;
    if (read_offset_variable(c_, number, value) || read_state_variable(c_, number, value))
        return value;
    raise_alarm(115);
}

void ControlVariables::set(int number, double value, const char* comment) {
    if (write_state_variable(c_, number, value, comment ? comment : "")) return;
    if (write_offset_variable(c_, number, is_vacant(value) ? 0.0 : value)) return;
    double ignored = 0.0;
    raise_alarm(read_state_variable(c_, number, ignored) ? 116 : 115);
}

double ControlVariables::parameter(int number, int bit, int axis) {
    const auto it = c_.stores.parameters.entry.find(number);
    if (it == c_.stores.parameters.entry.end()) return 0.0;
    double value = it->second.value;
    if (axis > 0) {
        const auto own = it->second.by_axis.find(axis);
        if (own != it->second.by_axis.end()) value = own->second;
    }
    if (bit < 0) return value;
    if (bit > 7) raise_alarm(115);
    return static_cast<double>(static_cast<unsigned>(value) >> static_cast<unsigned>(bit) & 1U);
}

}  // namespace trunnion
