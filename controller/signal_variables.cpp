#include "controller/signal_variables.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cmath>
#include <ctime>
#include <string>

#include "base/alarm.h"
#include "interpreter/variables.h"

namespace trunnion::controller {

namespace {

double not_vacant(double value) {
    return interpreter::is_vacant(value) ? 0.0 : value;
}

[[noreturn]] void raise_program_alarm(double value, std::string_view comment) {
    const int n = static_cast<int>(std::lround(std::fmod(value, 1e6)));
    throw Alarm(3000 + n, std::string(comment));
}

/// #1032 and #1132: the single bits as one number.
double word_of(int first, const Signals& signals) {
    double word = 0.0;
    for (int bit = 0; bit < 32; ++bit)
        if (const auto one = signals.find(first + bit); one != signals.end() && one->second != 0.0)
            word += std::ldexp(1.0, bit);
    return word;
}

}  // namespace

std::optional<double> signal_variable(int number, const Signals& signals) {
    const bool is_signal = (number >= 1000 && number <= 1035) || (number >= 1100 && number <= 1135);
    if (!is_signal) return std::nullopt;
    if (const auto it = signals.find(number); it != signals.end()) return it->second;
    return number % 100 == 32 ? word_of(number - 32, signals) : 0.0;
}

bool set_signal_variable(int number, double value, Signals& signals) {
    if (number < 1100 || number > 1135) return false;
    signals[number] = not_vacant(value);
    return true;
}

std::optional<double> ClockVariables::get(int number, double run_time_s) const {
    if (number == 3001) return std::floor(run_time_s * 1000.0 - offset_ms_);
    if (number == 3002) return (static_cast<double>(clock_s_) + run_time_s) / 3600.0 - offset_h_;
    if (number == 3003 || number == 3004 || number == 3007)
        return controls_[static_cast<std::size_t>(number - 3000)];
    if (number == 3901 || number == 3902) return parts_[static_cast<std::size_t>(number - 3901)];
    if (number != 3011 && number != 3012) return std::nullopt;
    const std::tm t =
        fmt::gmtime(static_cast<std::time_t>(clock_s_) + static_cast<std::time_t>(run_time_s));
    return number == 3011 ? (t.tm_year + 1900) * 10000.0 + (t.tm_mon + 1) * 100.0 + t.tm_mday
                          : t.tm_hour * 10000.0 + t.tm_min * 100.0 + t.tm_sec;
}

bool ClockVariables::set(int number, double value, std::string_view comment, Mover& mover) {
    switch (number) {
        case 3000:
            if (!interpreter::is_vacant(value)) raise_program_alarm(value, comment);
            return true;
        case 3001: offset_ms_ = mover.record().time_s * 1000.0 - not_vacant(value); return true;
        case 3002:
            offset_h_ += get(3002, mover.record().time_s).value() - not_vacant(value);
            return true;
        case 3003:
        case 3004:
            controls_[static_cast<std::size_t>(number - 3000)] = not_vacant(value);
            return true;
        case 3901:
        case 3902: parts_[static_cast<std::size_t>(number - 3901)] = not_vacant(value); return true;
        case 3006:
            mover.note(
                fmt::format("#3006 = {}: stop with message \"{}\", continued", value, comment));
            mover.axes.m_code(0);
            return true;
        default: return false;
    }
}

}  // namespace trunnion::controller
