#include "controller/surface_speed.h"

#include <algorithm>
#include <cmath>

#include "controller/g_codes.h"
#include "controller/g_handlers.h"

namespace trunnion {

namespace {

/// Minutes for one turn at a radius: in proportion to it between the limits of speed.
struct TurnTime {
    double minutes_per_mm;  ///< of radius
    double least, most;     ///< minutes

    double at(double radius_mm) const {
        return std::clamp(minutes_per_mm * std::abs(radius_mm), least, most);
    }
    /// Integral of `at` from 0 to a radius.
    double sum(double radius_mm) const {
        const double a = std::abs(radius_mm);
        const double low = least / minutes_per_mm, high = most / minutes_per_mm;
        double out = least * std::min(a, low);
        if (a > low) out += 0.5 * minutes_per_mm * (std::pow(std::min(a, high), 2) - low * low);
        if (a > high) out += most * (a - high);
        return radius_mm < 0.0 ? -out : out;
    }
    double mean(double from_mm, double to_mm) const {
        if (std::abs(to_mm - from_mm) < 1e-9) return at(to_mm);
        return (sum(to_mm) - sum(from_mm)) / (to_mm - from_mm);
    }
};

TurnTime turn_time(const ControlState& c) {
    const double mm_min = c.spindle.surface * (c.inch() ? 304.8 : 1000.0);
    const double g92 = c.spindle.most_rpm > 0.0 ? c.spindle.most_rpm : c.settings.most_rpm;
    const double most = std::min(g92, c.settings.most_rpm);
    const double least = std::clamp(c.settings.least_surface_rpm, 1e-9, most);
    return {2.0 * pi / mm_min, 1.0 / most, 1.0 / least};
}

Axis radius_axis(const ControlState& c) {
    const bool named = c.words.has('P') && c.words.get('P') != 0.0;
    const int number = named ? c.whole_word('P') : c.settings.surface_axis_number;
    if (number < 1 || number > static_cast<int>(c.config.axes.size()) ||
        c.config.axes[static_cast<std::size_t>(number - 1)].rotary)
        raise_alarm(190, c.words.column_of('P'));
    return c.config.axes[static_cast<std::size_t>(number - 1)].axis;
}

void turn_at(ControlState& c, double radius_mm) {
    if (!c.spindle.by_surface || c.spindle.surface <= 0.0) return;
    c.spindle.rpm = 1.0 / turn_time(c).at(radius_mm);
}

}  // namespace

void take_s_word(ControlState& c, double s) {
    c.spindle.programmed = s;
    (c.spindle.by_surface ? c.spindle.surface : c.spindle.rpm) = s;
    turn_at(c, c.program[c.spindle.radius_axis]);
}

void follow_surface_speed(ControlState& c, const ControlPosition& target) {
    if (c.spindle.surface <= 0.0) return;
    const Axis axis = c.spindle.radius_axis;
    const double from_mm = c.program[axis];
    turn_at(c, target[axis]);
    c.move.spindle_rpm = c.spindle_rpm();
    if (!c.modal.is(ModalGroup::feed_mode, 950) || c.spindle.direction == 0) return;
    const double mm_turn = c.feed.programmed * c.unit_mm;
    if (mm_turn <= 0.0) return;
    c.feed.seconds_per_mm = 60.0 * turn_time(c).mean(from_mm, target[axis]) / mm_turn;
    c.feed.mm_min = mm_turn * c.spindle.rpm;
}

/// G97 without S keeps the speed that G96 had reached; G96 without S takes its last one.
void g_speed_mode(ControlState& c, const GCode& code) {
    c.modal.set(code.group, code.code10);
    c.spindle.by_surface = code.code10 == 960;
    if (c.spindle.by_surface) c.spindle.radius_axis = radius_axis(c);
    turn_at(c, c.program[c.spindle.radius_axis]);
    c.feed_changed();
}

}  // namespace trunnion
