#include "controller/state_variables.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>

#include "controller/five_axis.h"
#include "controller/system_variables.h"

namespace trunnion {

namespace {

double in_units(const ControlState& c, const ControlAxis& axis, double value) {
    return axis.rotary ? value : value / c.unit_mm;
}

/// #5001.. block end, #5021.. machine, #5041.. work, #5061.. skip, #5081.. tool length,
/// #5101.. servo deviation: always 0 here.
bool read_position(const ControlState& c, int number, double& value) {
    if (number < 5001 || number > 5120) return false;
    const auto n = static_cast<std::size_t>((number - 5001) % 20);
    if (n >= c.config.axes.size()) return false;
    const ControlAxis& axis = c.config.axes[n];
    ControlPosition p;
    switch ((number - 5001) / 20) {
        case 0:
            p = c.coordinates.shaped_from_program(c.program);
            break;
        case 1:
            p = c.machine;
            break;
        case 2:
            p = work_position(c);
            break;
        case 3:
            p = c.skip.work;
            break;
        case 4:
            p = shown_tool_length(c);
            break;
        default:
            break;
    }
    value = in_units(c, axis, p[axis.axis]);
    return true;
}

/// #4001-#4030 the previous block, #4201.. the running one, #4401.. the interrupted one: the same
/// here, because a macro statement runs when the blocks before it are done.
bool read_modal(const ControlState& c, int number, double& value) {
    if (number < 4001 || number > 4599) return false;
    const int n = (number - 4001) % 200 + 1;
    if (n <= 30) {
        value = n < static_cast<int>(modal_group_count)
                    ? c.modal.code10[static_cast<std::size_t>(n)] / 10.0
                    : 0.0;
        return true;
    }
    switch (n) {
        case 107:
            value = c.radius_number;
            return true;
        case 109:
            value = c.feed.programmed;
            return true;
        case 111:
            value = c.length_number;
            return true;
        case 113:
            value = c.last_m;
            return true;
        case 114:
            value = c.sequence_number ? c.sequence_number() : 0;
            return true;
        case 115:
            value = c.program_number ? c.program_number() : 0;
            return true;
        case 119:
            value = c.spindle.programmed;
            return true;
        case 120:
            value = c.tool_selected;
            return true;
        case 130:
            value = c.work_number;
            return true;
        default:
            return n <= 130;
    }
}

std::tm now(const ControlState& c) {
    const std::time_t t =
        static_cast<std::time_t>(c.config.clock_s) + static_cast<std::time_t>(c.result.time_s);
    return fmt::gmtime(t);
}

bool read_clock(const ControlState& c, int number, double& value) {
    switch (number) {
        case 3001:
            value = std::floor(c.result.time_s * 1000.0 - c.clock_offset_ms);
            return true;
        case 3002:
            value = (static_cast<double>(c.config.clock_s) + c.result.time_s) / 3600.0;
            return true;
        case 3011: {
            const std::tm t = now(c);
            value = (t.tm_year + 1900) * 10000.0 + (t.tm_mon + 1) * 100.0 + t.tm_mday;
            return true;
        }
        case 3012: {
            const std::tm t = now(c);
            value = t.tm_hour * 10000.0 + t.tm_min * 100.0 + t.tm_sec;
            return true;
        }
        default:
            return false;
    }
}

/// #1000-#1031 single inputs, #1032-#1035 words; #1100.. the outputs.
bool is_signal(int number) {
    return (number >= 1000 && number <= 1035) || (number >= 1100 && number <= 1135);
}

double signal(const ControlState& c, int number) {
    const auto it = c.stores.signals.find(number);
    if (it != c.stores.signals.end()) return it->second;
    if (number % 100 < 32) return 0.0;
    const int first = number - 32;  // #1032 and #1132: the bits of the singles as one number
    double word = 0.0;
    for (int bit = 0; bit < 32 && number % 100 == 32; ++bit)
        if (const auto one = c.stores.signals.find(first + bit);
            one != c.stores.signals.end() && one->second != 0.0)
            word += std::ldexp(1.0, bit);
    return word;
}

[[noreturn]] void raise_program_alarm(double value, std::string_view comment) {
    const int n = static_cast<int>(std::lround(value));
    throw Alarm(3000 + n, std::string(comment));
}

}  // namespace

bool read_state_variable(const ControlState& c, int number, double& value) {
    if (is_signal(number)) {
        value = signal(c, number);
        return true;
    }
    if (number >= 3003 && number <= 3008) {
        value = c.controls[static_cast<std::size_t>(number - 3000) % 8];
        return number == 3003 || number == 3004 || number == 3007;
    }
    if (number == 5500) {
        value = c.fixture_number;
        return true;
    }
    if (number > 5500 && number <= 5500 + static_cast<int>(c.config.axes.size())) {
        const ControlAxis& axis = c.config.axes[static_cast<std::size_t>(number - 5501)];
        value = in_units(c, axis, c.coordinates.fixture[axis.axis]);
        return true;
    }
    return read_clock(c, number, value) || read_modal(c, number, value) ||
           read_position(c, number, value);
}

bool write_state_variable(ControlState& c, int number, double value, std::string_view comment) {
    switch (number) {
        case 3000:
            if (is_vacant(value)) return true;
            raise_program_alarm(value, comment);
        case 3001:
            c.clock_offset_ms = c.result.time_s * 1000.0 - (is_vacant(value) ? 0.0 : value);
            return true;
        case 3003:
        case 3004:
            c.controls[static_cast<std::size_t>(number - 3000)] = is_vacant(value) ? 0.0 : value;
            return true;
        case 3006:
            c.note(fmt::format("#3006 = {}: stop with message \"{}\", continued", value, comment));
            c.send_m_code(0);
            return true;
        default:
            break;
    }
    if (number >= 1100 && number <= 1135) {
        c.stores.signals[number] = is_vacant(value) ? 0.0 : value;
        return true;
    }
    return false;
}

}  // namespace trunnion
