#include "controller/surface_speed.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "controller/alarms.h"

namespace trunnion::controller {

namespace {

/// Minutes per revolution as a function of the radius: proportional to it between the speed limits.
struct TurnTime {
    double minutes_per_mm;  ///< per mm of radius
    double least, most;     ///< minutes

    double at(double radius_mm) const {
        return std::clamp(minutes_per_mm * std::abs(radius_mm), least, most);
    }
    /// Integral from 0 to a radius.
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

TurnTime turn_time(const Modal& modal) {
    const ControlSettings& settings = modal.settings;
    const double mm_min = modal.spindle.surface * (modal.units.inch() ? 304.8 : 1000.0);
    const double g92 = modal.spindle.most_rpm > 0.0 ? modal.spindle.most_rpm : settings.most_rpm;
    const double most = std::min(g92, settings.most_rpm);
    const double least = std::clamp(settings.least_surface_rpm, 1e-9, most);
    return {2.0 * pi / mm_min, 1.0 / most, 1.0 / least};
}

Axis radius_axis(const SortedWords& words, const ControlSettings& settings) {
    const bool named = words.has('P') && words.get('P') != 0.0;
    const int number = named ? words.whole('P') : settings.surface_axis_number;
    if (number < 1 || number > static_cast<int>(settings.axes.size()) ||
        settings.axes[static_cast<std::size_t>(number - 1)].rotary)
        raise_alarm(190, words.column_of('P'));
    return settings.axes[static_cast<std::size_t>(number - 1)].axis;
}

void turn_at(Modal& modal, double radius_mm) {
    if (!modal.spindle.by_surface || modal.spindle.surface <= 0.0) return;
    modal.spindle.rpm = 1.0 / turn_time(modal).at(radius_mm);
}

}  // namespace

void take_s_word(Modal& modal, double s, const offsets::ControlPosition& position) {
    SpindleState& spindle = modal.spindle;
    spindle.programmed = s;
    (spindle.by_surface ? spindle.surface : spindle.rpm) = s;
    turn_at(modal, position[spindle.radius_axis]);
}

void follow_surface_speed(Modal& modal, const offsets::ControlPosition& from,
                          const offsets::ControlPosition& to) {
    if (modal.spindle.surface <= 0.0) return;
    const Axis axis = modal.spindle.radius_axis;
    turn_at(modal, to[axis]);
    modal.block.spindle_rpm = modal.spindle.signed_rpm();
    if (!modal.is(ModalGroup::feed_mode, 950) || modal.spindle.direction == 0) return;
    motion::FeedState& feed = modal.block.feed;
    const double mm_turn = feed.programmed * modal.units.unit_mm;
    if (mm_turn <= 0.0) return;
    feed.seconds_per_mm = 60.0 * turn_time(modal).mean(from[axis], to[axis]) / mm_turn;
    feed.mm_min = mm_turn * modal.spindle.rpm;
}

void set_speed_mode(const SortedWords& words, Modal& modal, int code10,
                    const offsets::ControlPosition& position) {
    modal.codes.set(ModalGroup::surface_speed, code10);
    modal.spindle.by_surface = code10 == 960;
    if (modal.spindle.by_surface) modal.spindle.radius_axis = radius_axis(words, modal.settings);
    turn_at(modal, position[modal.spindle.radius_axis]);
    modal.feed_changed();
}

}  // namespace trunnion::controller
