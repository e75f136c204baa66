#include "controller/shapes.h"

#include "controller/alarms.h"

namespace trunnion::controller {

namespace {

/// A scaling factor: as written with a decimal point, else in thousandths (5400#7 SCR, assumed
/// 0.001).
double factor_word(const SortedWords& words, char letter) {
    const double factor = words.get(letter) * (words.is_bare(letter) ? 0.001 : 1.0);
    if (factor == 0.0) raise_alarm(142, words.column_of(letter));
    return factor;
}

/// Centre from the axis words; the present position for axes without a word.
offsets::ControlPosition centre_of(const SortedWords& words, const Modal& modal,
                                   const Frames& frames) {
    offsets::ControlPosition out = frames.program;
    for (const ControlAxis& entry : modal.settings.axes)
        if (words.has(entry.axis)) out[entry.axis] = words.axis_value(entry.axis);
    return out;
}

}  // namespace

void set_scaling(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    Coordinates::AxisFactor scaling;
    scaling.factor.value.fill(1.0);
    scaling.centre = centre_of(words, modal, frames);
    constexpr std::pair<Axis, char> own[] = {{Axis::X, 'I'}, {Axis::Y, 'J'}, {Axis::Z, 'K'}};
    const bool each = words.has('I') || words.has('J') || words.has('K');
    for (const auto& [axis, letter] : own) {
        if (each && words.has(letter)) scaling.factor[axis] = factor_word(words, letter);
        if (!each && words.has('P')) scaling.factor[axis] = factor_word(words, 'P');
    }
    if (!each && !words.has('P')) raise_alarm(142);
    modal.codes.set(ModalGroup::scaling, 510);
    frames.stages.scaling = scaling;
    mover.frames_changed();
}

void end_scaling(Modal& modal, Frames& frames, Mover& mover) {
    modal.codes.set(ModalGroup::scaling, 500);
    frames.stages.scaling.reset();
    mover.frames_changed();
}

void set_mirror(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    auto& mirror = frames.stages.mirror;
    if (!mirror) {
        mirror.emplace();
        mirror->factor.value.fill(1.0);
    }
    for (const ControlAxis& entry : modal.settings.axes) {
        if (!words.has(entry.axis)) continue;
        mirror->factor[entry.axis] = -1.0;
        mirror->centre[entry.axis] = words.axis_value(entry.axis);
    }
    modal.codes.set(ModalGroup::mirror, 511);
    mover.frames_changed();
}

void end_mirror(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    auto& mirror = frames.stages.mirror;
    if (!mirror) return;
    bool left = false;
    for (const ControlAxis& entry : modal.settings.axes) {
        double& factor = mirror->factor[entry.axis];
        if (words.has(entry.axis) || !words.has_axis()) factor = 1.0;
        left = left || factor != 1.0;
    }
    if (!left) {
        mirror.reset();
        modal.codes.set(ModalGroup::mirror, 501);
    }
    mover.frames_changed();
}

/// G68 X Y Z I J K R turns space about any direction and shifts the origin to its centre
/// (B-62764EN/01 p. 243). A Hurco has no such words.
void refuse_turn_of_space(const SortedWords& words, const Modal& modal) {
    if (modal.settings.is_hurco()) return;
    if (const int column = words.column_of_first(SortedWords::centre_letters))
        refuse_option("three-dimensional coordinate conversion, G68 with I J K", column);
}

void set_rotation(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    refuse_turn_of_space(words, modal);
    if (frames.plane) raise_alarm(5457, "(G68 inside G68.2)");
    const motion::PlaneAxes& plane = modal.plane();
    const offsets::Parameters& parameters = frames.stores().parameters;
    Coordinates::PlaneRotation rotation;
    offsets::ControlPosition centre = frames.program;
    for (const Axis axis : {plane.first, plane.second})
        if (words.has(axis)) centre[axis] = words.axis_value(axis);
    rotation.centre = offsets::xyz_of(centre);
    rotation.axis = unit_along(plane.normal);
    // R without decimal point: thousandths of a degree, or degrees with 3401#0 = 1.
    rotation.angle_deg = words.has('R') ? words.angle_deg('R') : parameters.get(5410);
    const bool adds = !modal.absolute() && parameters.bit(5400, 0);  // RIN
    const auto& present = frames.stages.rotation;
    if (adds && present) rotation.angle_deg += present->angle_deg;
    modal.codes.set(ModalGroup::rotation, 680);
    frames.stages.rotation = rotation;
    mover.frames_changed();
}

void end_rotation(Modal& modal, Frames& frames, Mover& mover) {
    modal.codes.set(ModalGroup::rotation, 690);
    frames.stages.rotation.reset();
    mover.frames_changed();
}

}  // namespace trunnion::controller
