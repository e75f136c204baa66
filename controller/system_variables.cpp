#include "controller/system_variables.h"

#include "controller/alarms.h"
#include "controller/offset_variables.h"
#include "controller/position_variables.h"

namespace trunnion::controller {

/// Variables without a function in the control: the extended P-CODE variables (six digits, from
/// memory) and the ranges of the machine builder.
bool ControlVariables::is_free(int number) const {
    if (number >= 900000 && number <= 999999) return true;
    for (const auto& [first, last] : c_.config.builder.variables)
        if (number >= first && number <= last) return true;
    return false;
}

std::optional<double> ControlVariables::find(int number) const {
    if (const auto own = free_.find(number); own != free_.end()) return own->second;
    if (is_free(number)) return interpreter::vacant;
    if (const auto value = offset_variable(number, c_.modal, c_.frames)) return value;
    if (const auto value = signal_variable(number, c_.stores.signals)) return value;
    if (const auto value = c_.clock.get(number, c_.mover.record().time_s)) return value;
    if (const auto value = modal_variable(number, c_.modal, c_.place)) return value;
    return position_variable(number, c_.modal, c_.frames, c_.skip);
}

double ControlVariables::get(int number) {
    if ((number >= 5061 && number <= 5080) || (number >= 100151 && number <= 100200))
        reads_skip_ = true;
    const auto value = find(number);
    const bool of_d = number >= 2401 && number <= 2800 && !c_.modal.settings.d_offsets_from_2401;
    if (!value && of_d) raise_alarm(115, "(D offsets are here with 6004#5 = 1)");
    if (!value) raise_alarm(115);
    return *value;
}

void ControlVariables::set(int number, double value, const char* comment) {
    if (c_.clock.set(number, value, comment, c_.mover)) return;
    if (set_signal_variable(number, value, c_.stores.signals)) return;
    if (is_free(number)) return void(free_[number] = value);
    const double written = interpreter::is_vacant(value) ? 0.0 : value;
    if (set_offset_variable(number, written, c_.modal, c_.frames, c_.mover)) return;
    raise_alarm(find(number) ? 116 : 115);
}

double ControlVariables::parameter(int number, int bit, int axis) {
    // The five-axis group is Fanuc's: a Hurco keeps centrelines in its part set-up instead, and 0
    // would be taken for one.
    const bool five_axis = number >= 19680 && number <= 19749;
    if (five_axis && c_.modal.settings.is_hurco())
        raise_alarm(9003, "PRM[" + std::to_string(number) + "]");
    if (bit > 7) raise_alarm(115);
    const auto it = c_.stores.parameters.entry.find(number);
    if (it == c_.stores.parameters.entry.end()) return 0.0;
    double value = it->second.value;
    if (axis > 0) {
        const auto own = it->second.by_axis.find(axis);
        if (own != it->second.by_axis.end()) value = own->second;
    }
    if (bit < 0) return value;
    return static_cast<double>(static_cast<unsigned>(value) >> static_cast<unsigned>(bit) & 1U);
}

}  // namespace trunnion::controller
