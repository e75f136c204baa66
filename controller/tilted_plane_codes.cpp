// G68.2, G68.3, G68.4, G69, G53.1 and G53.6: tilted working plane and tool axis direction.
#include <fmt/format.h>

#include "controller/five_axis.h"
#include "controller/g_codes.h"
#include "controller/g_handlers.h"
#include "controller/tool_length.h"
#include "positioning/rotary_choice.h"

namespace trunnion {

namespace {

constexpr int deepest_nesting = 8;  ///< G68.2 and G68.4 on top of it (assumed)

std::optional<double> length_of(const ControlState& c, char letter) {
    if (!c.words.has(letter)) return std::nullopt;
    return c.length_word(letter);
}
/// Angles and components of vectors: no inches.
std::optional<double> number_of(const ControlState& c, char letter) {
    if (!c.words.has(letter)) return std::nullopt;
    return c.words.get(letter) * (c.words.is_bare(letter) ? c.bare_rotary : 1.0);
}
std::optional<double> whole_of(const ControlState& c, char letter) {
    if (!c.words.has(letter)) return std::nullopt;
    return c.words.get(letter);
}

PlaneWords plane_words(const ControlState& c) {
    PlaneWords words;
    words.x = length_of(c, 'X');
    words.y = length_of(c, 'Y');
    words.z = length_of(c, 'Z');
    words.i = number_of(c, 'I');
    words.j = number_of(c, 'J');
    words.k = number_of(c, 'K');
    words.r = number_of(c, 'R');
    words.p = whole_of(c, 'P');
    words.q = whole_of(c, 'Q');
    return words;
}

void check_plane_may_start(const ControlState& c) {
    if (c.five_axis.tcp) raise_alarm(5421, "(a tilted plane under it)");
    if (c.fixture_number != 0) raise_alarm(5457, "(G54.2 is in force)");
    if (!c.modal.is(ModalGroup::cutter, 400))
        raise_alarm(5457, "(cutter compensation is in force)");
    if (c.five_axis.fault) throw Alarm(*c.five_axis.fault);
}

Vector3 origin_of_work(const ControlState& c) {
    Coordinates plain = c.coordinates;
    plain.feature_MF.reset();
    return xyz_of(plain.work_origin()) + xyz_of(plain.plane_local);
}

/// A new frame; G52 counts along the plane from now on.
void set_plane(ControlState& c, const Pose& pose_PF, int nesting) {
    if (!c.five_axis.plane) {
        set_xyz(c.coordinates.plane_local, xyz_of(c.coordinates.local));
        set_xyz(c.coordinates.local, Vector3::Zero());
        c.modal.set(ModalGroup::rotation, 682);
    }
    c.five_axis.plane = TiltedPlaneState{pose_PF, nesting, {}};
    place_plane(c);
    five_axis_changed(c);
    c.frame_changed();
}

Vector3 tool_direction_P(const ControlState& c) {
    return c.five_axis.transform ? c.five_axis.transform->tool_direction_W(c.move.from)
                                 : Vector3::UnitZ();
}

Vector3 tip_P(const ControlState& c) {
    const Vector3 tip_W =
        c.five_axis.transform
            ? c.five_axis.transform->tip_W(c.move.from, c.move.tool_vector_mm)
            : Vector3(c.move.parallel.linear(c.move.from) - c.move.tool_vector_mm);
    return tip_W - origin_of_work(c);
}

/// 12321 (0 the reference tool axis, 1 X, 2 Y, 3 Z; values assumed) and 12322 (deg).
VerticalAxis vertical_axis(const ControlState& c) {
    VerticalAxis vertical;
    const int number = static_cast<int>(c.stores.parameters.get(12321));
    if (number < 0 || number > 3) raise_alarm(5459, "(No.12321)");
    if (number > 0) vertical.direction_P = Vector3::Unit(number - 1);
    if (number == 0 && c.five_axis.transform)
        vertical.direction_P = c.five_axis.transform->pivot().tool_direction;
    vertical.threshold_rad = rad_from_deg(c.stores.parameters.get(12322));
    return vertical;
}

}  // namespace

ControlPosition tool_length_in_plane(const ControlState& c) {
    ControlPosition length = c.coordinates.length;
    set_xyz(length, c.move.tool_vector_mm);
    if (!c.five_axis.transform) return length;
    const AxisPositions& there = c.five_axis.plane->latched;
    const Vector3 gauge = c.move.parallel.linear(there);
    set_xyz(length, gauge - c.five_axis.transform->pose_MW(there) *
                                c.five_axis.transform->tip_W(there, c.move.tool_vector_mm));
    return length;
}

ControlPosition shown_tool_length(const ControlState& c) {
    ControlPosition length = c.coordinates.length;
    if (c.five_axis.plane) set_xyz(length, c.move.tool_vector_mm);
    return length;
}

void place_plane(ControlState& c) {
    TiltedPlaneState& plane = *c.five_axis.plane;
    plane.latched = c.move.from;
    Pose pose_MP = Pose::shift(origin_of_work(c));
    if (c.five_axis.transform) pose_MP = c.five_axis.transform->pose_MW(plane.latched) * pose_MP;
    c.coordinates.feature_MF = pose_MP * plane.pose_PF;
    c.coordinates.length = tool_length_in_plane(c);
}

namespace {

std::optional<Pose> add_to_plane(ControlState& c) try {
    return c.five_axis.definition.add(plane_words(c));
} catch (const PlaneFormatError& error) {
    raise_alarm(5457, fmt::format("({})", error.what_is_wrong),
                error.letter == 0 ? 0 : c.words.column_of(error.letter));
}

}  // namespace

void g_tilted_plane(ControlState& c, const GCode& code) {
    FiveAxisState& five = c.five_axis;
    check_plane_may_start(c);
    const bool on_top = code.code10 == 684;
    if (on_top && !five.plane) raise_alarm(5457, "(G68.4 without G68.2)");
    if (!on_top && five.plane) raise_alarm(5456);
    if (on_top && five.plane->nesting >= deepest_nesting) raise_alarm(5456);
    five.definition_code10 = code.code10;
    const auto pose = add_to_plane(c);
    five_axis_changed(c);
    if (!pose) return;
    if (on_top)
        set_plane(c, five.plane->pose_PF * *pose, five.plane->nesting + 1);
    else
        set_plane(c, *pose, 1);
}

void g_tilted_plane_by_tool(ControlState& c, const GCode&) {
    check_plane_may_start(c);
    if (c.five_axis.plane) raise_alarm(5456);
    const PlaneWords words = plane_words(c);
    Vector3 origin = tip_P(c);
    if (words.x) origin.x() = *words.x;
    if (words.y) origin.y() = *words.y;
    if (words.z) origin.z() = *words.z;
    set_plane(
        c, plane_of_tool(tool_direction_P(c), origin, words.r.value_or(0.0), vertical_axis(c)), 1);
}

void cancel_tilted_plane(ControlState& c) {
    if (!c.five_axis.plane) return;
    if (c.five_axis.tcp) raise_alarm(5421, "(G69 under it)");
    c.five_axis.plane.reset();
    c.coordinates.feature_MF.reset();
    set_xyz(c.coordinates.local, xyz_of(c.coordinates.plane_local));
    set_xyz(c.coordinates.plane_local, Vector3::Zero());
    set_xyz(c.coordinates.length, c.move.tool_vector_mm);
    c.modal.set(ModalGroup::rotation, 690);
    five_axis_changed(c);
    c.frame_changed();
}

void g_rotation_cancel(ControlState& c, const GCode& code) {
    if (c.five_axis.plane) return cancel_tilted_plane(c);
    c.modal.set(ModalGroup::rotation, code.code10);
    c.coordinates.rotation.reset();
    c.frame_changed();
}

namespace {

std::string rotary_text(const ControlState& c, const RotarySolution& s) {
    const PivotParameters& pivot = c.five_axis.transform->pivot();
    std::string out;
    const auto add = [&](const PivotAxis& axis, double angle_rad) {
        if (axis.hypothetical) return;
        out += fmt::format("{}{}{:.4f}", out.empty() ? "" : " ", letter_of(axis.axis),
                           deg_from_rad(angle_rad) + 0.0);
    };
    add(pivot.first, s.first_rad);
    add(pivot.second, s.second_rad);
    return out;
}

/// Both solutions stand in the notes; a program that indexes thousands of times is not repeated.
void note_solutions(ControlState& c, const GCode& code, const RotaryChoice& choice) {
    if (c.result.notes.size() > 200) return;
    std::string text = fmt::format("{} line {}: {}", g_code_text(code.code10), c.words.line,
                                   rotary_text(c, *choice.chosen));
    for (const RotarySolution& other : choice.all)
        if (!(other == *choice.chosen)) text += ", other solution " + rotary_text(c, other);
    for (const RotarySolution& other : choice.out_of_travel)
        text += ", other solution " + rotary_text(c, other) + " out of travel";
    c.note(text);
}

Branch branch_of(const ControlState& c) {
    const int p = c.words.has('P') ? c.whole_word('P') : 0;
    if (p < 0 || p > 2) raise_alarm(5458, "(P is 0, 1 or 2)", c.words.column_of('P'));
    return static_cast<Branch>(p);
}

/// Rotary positions that put the tool along the feature's Z.
RotaryChoice tool_axis_choice(ControlState& c) {
    if (c.five_axis.tcp) raise_alarm(5458, "(tool centre point control is in force)");
    if (!c.five_axis.plane) raise_alarm(5458, "(no tilted plane is in force)");
    if (!c.modal.is(ModalGroup::cutter, 400))
        raise_alarm(5458, "(cutter compensation is in force)");
    const RotaryTransform& transform = five_axis_transform(c, 5458);
    RotaryChoice choice =
        choose_rotaries(transform, c.five_axis.plane->pose_PF.rotation.col(2),
                        transform.rotaries(c.move.from), rotary_travel(c), branch_of(c));
    if (!choice.chosen) raise_alarm(5458, "(no rotary position within travel)");
    return choice;
}

ControlPosition with_rotaries(const ControlState& c, const RotarySolution& s) {
    const PivotParameters& pivot = c.five_axis.transform->pivot();
    const RotarySolution present = c.five_axis.transform->rotaries(c.move.from);
    ControlPosition out = c.machine;  // an axis that stays keeps its degrees to the last bit
    if (!pivot.first.hypothetical && s.first_rad != present.first_rad)
        out[pivot.first.axis] = deg_from_rad(s.first_rad);
    if (!pivot.second.hypothetical && s.second_rad != present.second_rad)
        out[pivot.second.axis] = deg_from_rad(s.second_rad);
    return out;
}

void refuse_axis_words(const ControlState& c) {
    if (const int column = c.words.column_of_first(SortedWords::axis_letters))
        raise_alarm(5458, "(an axis word in its block)", column);
}

MotionKind turning_kind(const ControlState& c) {
    return c.modal.is(ModalGroup::motion, 10) ? MotionKind::linear : MotionKind::rapid;
}

}  // namespace

void g_tool_axis(ControlState& c, const GCode& code) {
    refuse_axis_words(c);
    const RotaryChoice choice = tool_axis_choice(c);
    note_solutions(c, code, choice);
    move_machine(c, turning_kind(c), with_rotaries(c, *choice.chosen));
    place_plane(c);
    c.frame_changed();
}

void g_tool_axis_keeping_tip(ControlState& c, const GCode& code) {
    refuse_axis_words(c);
    const RotaryChoice choice = tool_axis_choice(c);
    note_solutions(c, code, choice);
    const RotaryTransform& transform = *c.five_axis.transform;
    // The point kept: the tip of tool H (that in force without H), R mm further from the tip.
    Vector3 tool_vector = c.move.tool_vector_mm;
    if (c.words.has('H'))
        tool_vector = tool_length_mm(c, c.whole_word('H')) * transform.pivot().tool_direction;
    if (c.words.has('R')) tool_vector += c.length_word('R') * transform.pivot().tool_direction;
    const ToolCentrePoint keep =
        ToolCentrePoint::start(transform, c.move.from, TcpFrame::start, tool_vector);
    const Vector3 tip_W = transform.tip_W(c.move.from, tool_vector);
    ControlPosition machine = with_rotaries(c, *choice.chosen);
    const AxisPositions to = keep.machine(tip_W, axis_positions_of(machine));
    set_xyz(machine, {to[Axis::X], to[Axis::Y], to[Axis::Z]});
    const TipLine line(keep, c.move.from, to, tip_W, tip_W);
    CurveMove move;
    move.curve = &line;
    move_along(c, turning_kind(c), c.program, machine, to, move);
    place_plane(c);
    c.frame_changed();
}

}  // namespace trunnion
