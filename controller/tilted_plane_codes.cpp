#include "controller/tilted_plane_codes.h"

#include <fmt/format.h>

#include "controller/alarms.h"
#include "controller/tool_length.h"

namespace trunnion::controller {

namespace {

constexpr int deepest_nesting = 8;  ///< of G68.2 and the G68.4 on top of it (assumed)

positioning::PlaneWords plane_words(const SortedWords& words) {
    positioning::PlaneWords out;
    const auto read = [&](std::optional<double>& value, char letter, double in_units) {
        if (words.has(letter)) value = in_units;
    };
    read(out.x, 'X', words.length_mm('X'));
    read(out.y, 'Y', words.length_mm('Y'));
    read(out.z, 'Z', words.length_mm('Z'));
    // Angles and components of vectors are not converted from inch.
    read(out.i, 'I', words.angle_deg('I'));
    read(out.j, 'J', words.angle_deg('J'));
    read(out.k, 'K', words.angle_deg('K'));
    read(out.r, 'R', words.angle_deg('R'));
    read(out.p, 'P', words.get('P'));
    read(out.q, 'Q', words.get('Q'));
    return out;
}

Vector3 tool_direction_P(const Frames& frames) {
    const auto& transform = frames.believed.transform;
    return transform ? transform->tool_direction_W(frames.axes) : Vector3::UnitZ();
}

Vector3 tip_P(const Frames& frames) {
    const BelievedGeometry& believed = frames.believed;
    const Vector3& tool = frames.tool.vector_mm;
    const Vector3 tip_W = believed.transform
                              ? believed.transform->tip_W(frames.axes, tool)
                              : Vector3(believed.parallel.linear(frames.axes) - tool);
    return tip_W - frames.origin_of_work();
}

/// 12321 (0 the reference tool axis, 1 X, 2 Y, 3 Z; values assumed) and 12322 (deg).
positioning::VerticalAxis vertical_axis(const Frames& frames) {
    const offsets::Parameters& parameters = frames.stores().parameters;
    const auto& transform = frames.believed.transform;
    positioning::VerticalAxis vertical;
    const double number = parameters.get(12321);
    if (!(number >= 0.0 && number < 4.0)) raise_alarm(5459, "(No.12321)");
    const int axis = static_cast<int>(number);
    if (axis > 0) vertical.direction_P = Vector3::Unit(axis - 1);
    if (axis == 0 && transform) vertical.direction_P = transform->pivot().tool_direction;
    vertical.threshold_rad = rad_from_deg(parameters.get(12322));
    return vertical;
}

std::optional<Pose> add_to(positioning::PlaneDefinition& definition, const SortedWords& words) try {
    return definition.add(plane_words(words));
} catch (const positioning::PlaneFormatError& error) {
    raise_alarm(5457, fmt::format("({})", error.what_is_wrong),
                error.letter == 0 ? 0 : words.column_of(error.letter));
}

}  // namespace

void check_plane_may_start(const Modal& modal, const Frames& frames) {
    if (frames.tip.in_force) raise_alarm(5421, "(a tilted plane under it)");
    if (frames.fixture_number != 0) raise_alarm(5457, "(G54.2 is in force)");
    if (!modal.cutter_is_off()) raise_alarm(5457, "(cutter compensation is in force)");
    if (frames.believed.fault) throw Alarm(*frames.believed.fault);
}

void set_plane(const TiltedPlaneState& plane, Modal& modal, Frames& frames, Mover& mover) {
    Coordinates& stages = frames.stages;
    if (!frames.plane) {
        offsets::set_xyz(stages.plane_local, offsets::xyz_of(stages.local));
        offsets::set_xyz(stages.local, Vector3::Zero());
        modal.codes.set(ModalGroup::rotation, 682);
    }
    frames.plane = plane;
    frames.place_plane();
    mover.frames_changed();
}

void PlaneCodes::check_goes_on(const SortedWords& words) const {
    if (!pending()) return;
    if (words.code_count == 1 && words.code[0]->code10 == code10_ && !words.motion) return;
    raise_alarm(5457, "(another block within a definition)",
                words.code_count != 0 ? words.code_column[0] : 0);
}

void PlaneCodes::define(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover,
                        int code10) {
    check_plane_may_start(modal, frames);
    const bool on_top = code10 == 684;
    const auto& present = frames.plane;
    if (on_top && !present) raise_alarm(5457, "(G68.4 without G68.2)");
    if (!on_top && present) raise_alarm(5456);
    if (on_top && present->nesting >= deepest_nesting) raise_alarm(5456);
    code10_ = code10;
    const auto pose = add_to(definition_, words);
    if (!pose) return;
    TiltedPlaneState plane;
    plane.pose_PF = on_top ? present->pose_PF * *pose : *pose;
    plane.nesting = on_top ? present->nesting + 1 : 1;
    set_plane(plane, modal, frames, mover);
}

void define_plane_by_tool(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    check_plane_may_start(modal, frames);
    if (frames.plane) raise_alarm(5456);
    const positioning::PlaneWords at = plane_words(words);
    Vector3 origin = tip_P(frames);
    if (at.x) origin.x() = *at.x;
    if (at.y) origin.y() = *at.y;
    if (at.z) origin.z() = *at.z;
    TiltedPlaneState plane;
    plane.pose_PF = positioning::plane_of_tool(tool_direction_P(frames), origin, at.r.value_or(0.0),
                                               vertical_axis(frames));
    set_plane(plane, modal, frames, mover);
}

void cancel_tilted_plane(Modal& modal, Frames& frames, Mover& mover) {
    if (frames.tip.in_force) raise_alarm(5421, "(G69 under it)");
    if (!frames.plane->below_PF.empty()) {
        TiltedPlaneState plane = *frames.plane;
        plane.pose_PF = plane.below_PF.back();
        plane.below_PF.pop_back();
        return set_plane(plane, modal, frames, mover);
    }
    Coordinates& stages = frames.stages;
    frames.plane.reset();
    stages.feature_MF.reset();
    offsets::set_xyz(stages.local, offsets::xyz_of(stages.plane_local));
    offsets::set_xyz(stages.plane_local, Vector3::Zero());
    offsets::set_xyz(stages.length, frames.tool.vector_mm);
    modal.codes.set(ModalGroup::rotation, 690);
    mover.frames_changed();
}

namespace {

std::string rotary_text(const offsets::PivotParameters& pivot,
                        const positioning::RotarySolution& s) {
    std::string out;
    const auto add = [&](const offsets::PivotAxis& axis, double angle_rad) {
        if (axis.hypothetical) return;
        out += fmt::format("{}{}{:.4f}", out.empty() ? "" : " ", letter_of(axis.axis),
                           deg_from_rad(angle_rad) + 0.0);
    };
    add(pivot.first, s.first_rad);
    add(pivot.second, s.second_rad);
    return out;
}

std::string solutions_text(const offsets::PivotParameters& pivot,
                           const positioning::RotaryChoice& choice) {
    std::string text = rotary_text(pivot, *choice.chosen);
    for (const positioning::RotarySolution& other : choice.all)
        if (!(other == *choice.chosen)) text += ", other solution " + rotary_text(pivot, other);
    for (const positioning::RotarySolution& other : choice.out_of_travel)
        text += ", other solution " + rotary_text(pivot, other) + " out of travel";
    return text;
}

positioning::Branch branch_of(const SortedWords& words) {
    return static_cast<positioning::Branch>(words.has('P') ? words.whole('P') : 0);
}

/// Rotary positions that align the tool with Z of the feature frame.
positioning::RotaryChoice tool_axis_choice(const SortedWords& words, const Modal& modal,
                                           const Frames& frames) {
    if (const int column = words.column_of_first(SortedWords::axis_letters))
        raise_alarm(5458, "(an axis word in its block)", column);
    if (frames.tip.in_force) raise_alarm(5458, "(tool centre point control is in force)");
    if (!frames.plane) raise_alarm(5458, "(no tilted plane is in force)");
    if (!modal.cutter_is_off()) raise_alarm(5458, "(cutter compensation is in force)");
    const positioning::RotaryTransform& transform = frames.transform(5458);
    positioning::RotaryChoice choice = positioning::choose_rotaries(
        transform, frames.plane->pose_PF.rotation.col(2), transform.rotaries(frames.axes),
        frames.rotary_travel(modal.settings), branch_of(words));
    if (!choice.chosen) raise_alarm(5458, "(no rotary position within travel)");
    return choice;
}

/// Each choice is noted only once, because a program may index thousands of times.
void note_choice(const positioning::RotaryTransform& transform,
                 const positioning::RotaryChoice& choice, const char* code, int line,
                 RunRecord& record) {
    constexpr std::size_t most_notes = 200;
    if (record.notes.size() >= most_notes) return;
    record.note(
        fmt::format("{} line {}: {}", code, line, solutions_text(transform.pivot(), choice)));
}

offsets::ControlPosition with_rotaries(const Frames& frames, const positioning::RotarySolution& s) {
    const positioning::RotaryTransform& transform = *frames.believed.transform;
    const offsets::PivotParameters& pivot = transform.pivot();
    const positioning::RotarySolution present = transform.rotaries(frames.axes);
    offsets::ControlPosition out =
        frames.machine;  // an axis that does not move keeps its position in deg bit by bit
    if (!pivot.first.hypothetical && s.first_rad != present.first_rad)
        out[pivot.first.axis] = deg_from_rad(s.first_rad);
    if (!pivot.second.hypothetical && s.second_rad != present.second_rad)
        out[pivot.second.axis] = deg_from_rad(s.second_rad);
    return out;
}

motion::MotionKind turning_kind(const Modal& modal) {
    return modal.is(ModalGroup::motion, 10) ? motion::MotionKind::linear
                                            : motion::MotionKind::rapid;
}

/// The tool whose tip position G53.6 keeps.
Vector3 tool_to_keep(const SortedWords& words, const Frames& frames) {
    const Vector3& direction = frames.believed.transform->pivot().tool_direction;
    Vector3 out = frames.tool.vector_mm;
    if (words.has('H'))
        out = tool_length_mm(words, frames.stores().tools, words.whole('H')) * direction;
    if (words.has('R')) out += words.length_mm('R') * direction;
    return out;
}

}  // namespace

void turn_tool_axis(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    const positioning::RotaryChoice choice = tool_axis_choice(words, modal, frames);
    note_choice(*frames.believed.transform, choice, "G53.1", modal.block.line, mover.record());
    mover.axes.to_machine(turning_kind(modal), with_rotaries(frames, *choice.chosen));
    frames.place_plane();
    mover.frames_changed();
}

void turn_tool_axis_keeping_tip(const SortedWords& words, Modal& modal, Frames& frames,
                                Mover& mover) {
    const positioning::RotaryChoice choice = tool_axis_choice(words, modal, frames);
    const positioning::RotaryTransform& transform = *frames.believed.transform;
    note_choice(transform, choice, "G53.6", modal.block.line, mover.record());
    const Vector3 tool = tool_to_keep(words, frames);
    const AxisPositions from = frames.axes;
    const motion::ToolCentrePoint keep =
        motion::ToolCentrePoint::start(transform, from, positioning::TcpFrame::start, tool);
    const Vector3 tip_W = transform.tip_W(from, tool);
    MoveTarget target{frames.program, with_rotaries(frames, *choice.chosen), {}};
    target.axes = keep.machine(tip_W, offsets::axis_positions_of(target.machine));
    const AxisPositions& to = target.axes;
    offsets::set_xyz(target.machine, {to[Axis::X], to[Axis::Y], to[Axis::Z]});
    const motion::TipLine line(keep, from, to, tip_W, tip_W);
    CurveMove way;
    way.curve = &line;
    mover.axes.along(turning_kind(modal), target, way);
    frames.place_plane();
    mover.frames_changed();
}

}  // namespace trunnion::controller
