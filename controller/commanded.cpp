#include "controller/commanded.h"

#include <cmath>

namespace trunnion::controller {

namespace {

/// Distance (deg) to |wanted| mod 360 in the direction of its sign.
double way_by_sign(double present, double wanted) {
    const double way = std::fmod(std::abs(wanted) - present, 360.0);
    if (std::signbit(wanted)) return way > 0.0 ? way - 360.0 : way;
    return way < 0.0 ? way + 360.0 : way;
}

void take_shortest_way(const SortedWords& words, const Modal& modal,
                       const offsets::ControlPosition& present, offsets::ControlPosition& target) {
    for (const Axis axis : {Axis::A, Axis::B, Axis::C}) {
        if (!words.has(axis)) continue;
        const auto bit = static_cast<std::uint16_t>(1U << index_of(axis));
        if (!modal.shortest_way && !(modal.settings.rollover & bit)) continue;
        const double from = present[axis], wanted = target[axis];
        const bool by_sign = !modal.shortest_way && (modal.settings.rollover_signed & bit);
        target[axis] =
            from + (by_sign ? way_by_sign(from, wanted) : std::remainder(wanted - from, 360.0));
    }
}

/// The axis words as coordinates.
offsets::ControlPosition plain_target(const SortedWords& words, const Modal& modal,
                                      const offsets::ControlPosition& present) {
    offsets::ControlPosition out = present;
    for (const ControlAxis& entry : modal.settings.axes) {
        const Axis axis = entry.axis;
        if (!words.has(axis)) continue;
        const double value = words.axis_value(axis);
        out[axis] = modal.absolute() ? value : out[axis] + value;
    }
    return out;
}

offsets::ControlPosition polar_target(const SortedWords& words, Modal& modal,
                                      const offsets::ControlPosition& present) {
    const motion::PlaneAxes& plane = modal.plane();
    offsets::ControlPosition out = plain_target(words, modal, present);
    const char radius_word = letter_of(plane.first), angle_word = letter_of(plane.second);
    if (!words.has(radius_word) && !words.has(angle_word)) return out;
    const double x = present[plane.first], y = present[plane.second];
    const bool relative = !modal.absolute();
    const bool pole_is_here = relative && words.has(radius_word);
    const double radius = words.has(radius_word) ? words.length_mm(radius_word) : std::hypot(x, y);
    if (words.has(angle_word))
        modal.polar_angle_deg =
            words.angle_deg(angle_word) + (relative ? modal.polar_angle_deg : 0.0);
    const double angle = rad_from_deg(modal.polar_angle_deg);
    out[plane.first] = (pole_is_here ? x : 0.0) + radius * std::cos(angle);
    out[plane.second] = (pole_is_here ? y : 0.0) + radius * std::sin(angle);
    return out;
}

}  // namespace

offsets::ControlPosition commanded_position(const SortedWords& words, Modal& modal,
                                            const Frames& frames) {
    if (modal.is(ModalGroup::polar_words, 160)) return polar_target(words, modal, frames.program);
    offsets::ControlPosition out = plain_target(words, modal, frames.program);
    if (modal.absolute() && (modal.settings.rollover || modal.shortest_way))
        take_shortest_way(words, modal, frames.program, out);
    return out;
}

void start_polar_words(Modal& modal, const offsets::ControlPosition& position) {
    const motion::PlaneAxes& plane = modal.plane();
    modal.polar_angle_deg = deg_from_rad(std::atan2(position[plane.second], position[plane.first]));
}

}  // namespace trunnion::controller
