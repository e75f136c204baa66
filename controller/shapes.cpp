// Codes that shape the programmed figure: scaling G51, mirror G51.1, rotation G68.
#include "controller/control_state.h"
#include "controller/g_codes.h"
#include "controller/g_handlers.h"

namespace trunnion {

namespace {

/// A factor word: with a decimal point as it stands, else thousandths (5400#7 SCR, assumed 0.001).
double factor_word(const ControlState& c, char letter) {
    const double value = c.words.get(letter);
    const double factor = c.words.is_bare(letter) ? value * 0.001 : value;
    if (factor == 0.0) raise_alarm(142, c.words.column_of(letter));
    return factor;
}

/// Centre from the axis words; the present position where an axis is not named.
ControlPosition centre_of(const ControlState& c) {
    ControlPosition out = c.program;
    for (const ControlAxis& entry : c.config.axes)
        if (c.words.has(letter_of(entry.axis))) out[entry.axis] = c.axis_word(entry.axis);
    return out;
}

}  // namespace

void g_scaling(ControlState& c, const GCode& code) {
    Coordinates::AxisFactor scaling;
    scaling.factor.value.fill(1.0);
    scaling.centre = centre_of(c);
    constexpr std::pair<Axis, char> own[] = {{Axis::X, 'I'}, {Axis::Y, 'J'}, {Axis::Z, 'K'}};
    const bool each = c.words.has('I') || c.words.has('J') || c.words.has('K');
    for (const auto& [axis, letter] : own) {
        if (each && c.words.has(letter)) scaling.factor[axis] = factor_word(c, letter);
        if (!each && c.words.has('P')) scaling.factor[axis] = factor_word(c, 'P');
    }
    if (!each && !c.words.has('P')) raise_alarm(142);
    c.modal.set(ModalGroup::scaling, code.code10);
    c.coordinates.scaling = scaling;
    c.frame_changed();
}

void g_scaling_off(ControlState& c, const GCode& code) {
    c.modal.set(ModalGroup::scaling, code.code10);
    c.coordinates.scaling.reset();
    c.frame_changed();
}

void g_mirror(ControlState& c, const GCode& code) {
    if (!c.coordinates.mirror) {
        c.coordinates.mirror.emplace();
        c.coordinates.mirror->factor.value.fill(1.0);
    }
    Coordinates::AxisFactor& mirror = *c.coordinates.mirror;
    for (const ControlAxis& entry : c.config.axes) {
        if (!c.words.has(letter_of(entry.axis))) continue;
        mirror.factor[entry.axis] = -1.0;
        mirror.centre[entry.axis] = c.axis_word(entry.axis);
    }
    c.modal.set(ModalGroup::mirror, code.code10);
    c.frame_changed();
}

void g_mirror_off(ControlState& c, const GCode& code) {
    if (!c.coordinates.mirror) return;
    bool left = false;
    for (const ControlAxis& entry : c.config.axes) {
        double& factor = c.coordinates.mirror->factor[entry.axis];
        if (c.words.has(letter_of(entry.axis)) || !c.words.has_axis()) factor = 1.0;
        left = left || factor != 1.0;
    }
    if (!left) {
        c.coordinates.mirror.reset();
        c.modal.set(ModalGroup::mirror, code.code10);
    }
    c.frame_changed();
}

void g_rotation(ControlState& c, const GCode& code) {
    if (c.five_axis.plane) raise_alarm(5457, "(G68 inside G68.2)");  // assumed
    const PlaneAxes& plane = plane_axes(c.modal);
    Coordinates::PlaneRotation rotation;
    ControlPosition centre = c.program;
    for (const Axis axis : {plane.first, plane.second})
        if (c.words.has(letter_of(axis))) centre[axis] = c.axis_word(axis);
    rotation.centre = xyz_of(centre);
    rotation.axis = Vector3::Unit(static_cast<Eigen::Index>(index_of(plane.normal)));
    // R without a point: thousandths of a degree, or degrees with 3401#0 = 1.
    rotation.angle_deg = c.words.get('R', c.stores.parameters.get(5410)) *
                         (c.words.has('R') && c.words.is_bare('R') ? c.bare_rotary : 1.0);
    const bool adds = !c.absolute() && c.stores.parameters.bit(5400, 0);  // RIN
    if (adds && c.coordinates.rotation) rotation.angle_deg += c.coordinates.rotation->angle_deg;
    c.modal.set(ModalGroup::rotation, code.code10);
    c.coordinates.rotation = rotation;
    c.frame_changed();
}

}  // namespace trunnion
