#include "controller/polar_words.h"

#include <cmath>

#include "controller/control_state.h"

namespace trunnion {

void start_polar_words(ControlState& c) {
    const PlaneAxes& plane = plane_axes(c.modal);
    c.polar_angle_deg = deg_from_rad(std::atan2(c.program[plane.second], c.program[plane.first]));
}

ControlPosition polar_target(ControlState& c) {
    const PlaneAxes& plane = plane_axes(c.modal);
    ControlPosition out = c.program;
    const bool relative = !c.absolute();
    for (const ControlAxis& entry : c.config.axes) {
        const Axis axis = entry.axis;
        if (axis == plane.first || axis == plane.second || !c.words.has(letter_of(axis))) continue;
        out[axis] = (relative ? out[axis] : 0.0) + c.axis_word(axis);
    }
    const char radius_word = letter_of(plane.first), angle_word = letter_of(plane.second);
    if (!c.words.has(radius_word) && !c.words.has(angle_word)) return out;

    const double x = c.program[plane.first], y = c.program[plane.second];
    double radius = std::hypot(x, y);
    double pole_x = 0.0, pole_y = 0.0;
    if (relative && c.words.has(radius_word)) {  // G91: the pole is where the tool stands
        pole_x = x;
        pole_y = y;
    }
    if (c.words.has(radius_word)) radius = c.length_word(radius_word);
    if (c.words.has(angle_word)) {
        const double word =
            c.words.get(angle_word) * (c.words.is_bare(angle_word) ? c.bare_rotary : 1.0);
        c.polar_angle_deg = relative ? c.polar_angle_deg + word : word;
    }
    const double angle = rad_from_deg(c.polar_angle_deg);
    out[plane.first] = pole_x + radius * std::cos(angle);
    out[plane.second] = pole_y + radius * std::sin(angle);
    return out;
}

}  // namespace trunnion
