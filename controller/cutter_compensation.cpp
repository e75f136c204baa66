// G41, G42, G40, G39: the tool runs beside the programmed path. Start-up and cancel types A, B, C
// (5003#0, #1), outside corners by lines or arcs (19607#2), look-ahead (19625).
#include <fmt/format.h>

#include <cmath>

#include "controller/compensated_corner.h"
#include "controller/control_state.h"
#include "controller/g_codes.h"
#include "controller/g_handlers.h"

namespace trunnion {

namespace {

/// The alarms of a side belong to its block, not to the one that made it known.
template <typename Work>
void at_block(const BlockMarks& marks, Work work) {
    try {
        work();
    } catch (Alarm& alarm) {
        place_alarm(alarm, marks);
        throw;
    }
}

/// Moves of other axes, dwells and M codes go out where the tool stands in the plane.
void run_idle(ControlState& c) {
    const std::vector<PathOutput> idle = std::move(c.path.idle);
    c.path.idle.clear();
    for (const PathOutput& out : idle) {
        if (out.m_code >= 0 || out.dwell_s >= 0.0) {
            send_event(c, out);
            continue;
        }
        PlaneElement way;
        way.start = way.end = tool_in_plane(c);
        send_path(c, out.move, way, out.move.to, false);
    }
}

/// Blocks without way in the plane that wait, the present one left out.
int idle_blocks(const ControlState& c) {
    int count = 0, last = -1;
    for (const PathOutput& out : c.path.idle) {
        const int line = out.move.marks.line;
        if (line != last && line != c.words.line) ++count;
        last = line;
    }
    return count;
}

void release_when_done(ControlState& c) {
    const PathQueue& q = c.path;
    if (q.first || q.corner || !q.idle.empty() || q.last_offset_mm != 0.0) return;
    if (!c.modal.is(ModalGroup::cutter, 400)) return;
    release_path(c);
    c.path.engaged = false;
}

/// From where the tool stands straight to the start of `move` beside it.
void link_to(ControlState& c, const PathMove& move) {
    PathMove link = move;
    link.plane.arc = false;
    link.to = c.path.tool;
    line_to(c, link, square_to_start(move));
}

/// Type C: G40 stood alone, the tool shifts back to the programmed point.
void end_by_shift(ControlState& c) {
    flush_compensation(c);
    if (c.path.last_offset_mm == 0.0) return;
    const PlaneAxes& plane = plane_axes(c.modal);
    PathMove back = path_move_of(c, c.program, false, false);
    back.offset_mm = 0.0;
    line_to(c, back, {c.program[plane.first], c.program[plane.second]});
    c.path.last_offset_mm = 0.0;
    release_when_done(c);
}

void start(ControlState& c, const GCode& code, bool alone) {
    if (!c.path.engaged) {
        c.path = PathQueue{};
        c.path.engaged = true;
        c.path.tool = c.program;
    }
    if (alone && c.settings.startup_type_c && c.modal.is(ModalGroup::cutter, 400))
        c.path.starts_by_shift = true;
    c.modal.set(ModalGroup::cutter, code.code10);
}

}  // namespace

double ControlState::cutter_offset_mm() const {
    if (modal.is(ModalGroup::cutter, 400)) return 0.0;
    const double radius = stores.tools.tool[static_cast<std::size_t>(radius_number)].radius_mm();
    const double value = settings.radius_is_diameter ? 0.5 * radius : radius;
    const double scale =
        coordinates.scaling ? coordinates.scaling->factor[plane_axes(modal).first] : 1.0;
    return (modal.is(ModalGroup::cutter, 410) ? value : -value) / scale;
}

void flush_compensation(ControlState& c) {
    PathQueue& q = c.path;
    if (q.first) {
        const PathMove first = *q.first;
        q.first.reset();
        at_block(first.marks, [&] {
            run_beside(c, first, first.offset_mm == 0.0 ? first.plane.end : square_to_end(first));
        });
        q.last_offset_mm = first.offset_mm;
    }
    run_idle(c);
    release_when_done(c);
}

void compensate(ControlState& c, const PathMove& move) {
    PathQueue& q = c.path;
    if (!move.plane.moves()) {
        PathOutput out;
        out.move = move;
        q.idle.push_back(out);
        if (!q.first) run_idle(c);
        return;
    }
    // More idle blocks than the control reads ahead: the side before them has ended square.
    if (q.first && idle_blocks(c) > c.settings.blocks_ahead) flush_compensation(c);
    ++q.block;
    if (q.first) {
        const PathMove first = *q.first;
        q.first.reset();
        at_block(first.marks, [&] { finish_first(c, first, move); });
        q.last_offset_mm = first.offset_mm;
        run_idle(c);
    } else if (move.offset_mm != 0.0 && (q.last_offset_mm != 0.0 || q.starts_by_shift)) {
        // After a stop in mid-path the tool stands square to the last side and goes round the
        // corner to the start of the next one; a start-up of type C begins so.
        run_idle(c);
        link_to(c, move);
        q.last_offset_mm = move.offset_mm;
    }
    q.starts_by_shift = false;
    q.first = move;
    if (move.offset_mm == 0.0) flush_compensation(c);  // the way out needs no look ahead
}

void g_cutter(ControlState& c, const GCode& code) {
    if (c.words.has('D')) c.radius_number = c.whole_word('D');
    if (c.radius_number < 0 || c.radius_number >= static_cast<int>(c.stores.tools.tool.size()))
        raise_alarm(30, c.words.column_of('D'));
    if (code.code10 != 400 && (c.polar || c.cylinder)) raise_alarm(9002);
    const int motion = c.modal[ModalGroup::motion];
    const bool arc = motion == 20 || motion == 30;
    const bool alone = !c.words.has_axis();
    const bool changes = c.modal.is(ModalGroup::cutter, 400) != (code.code10 == 400);
    if (arc && changes && !alone) raise_alarm(34);
    if (code.code10 != 400) return start(c, code, alone);
    if (alone && changes && c.settings.startup_type_c) end_by_shift(c);
    c.modal.set(ModalGroup::cutter, 400);
    if (c.path.engaged) release_when_done(c);
}

void g_corner_arc(ControlState& c, const GCode& code) {
    if (c.modal.is(ModalGroup::cutter, 400) || c.words.has_axis()) raise_alarm(10);
    const PlaneAxes& plane = plane_axes(c.modal);
    if (!c.path.first) return c.note(g_code_text(code.code10) + " without a side before it");
    PathMove& first = *c.path.first;
    first.corner_arc = true;
    if (c.words.has(plane.centre_first)) first.corner_arc_to.x = c.length_word(plane.centre_first);
    if (c.words.has(plane.centre_second))
        first.corner_arc_to.y = c.length_word(plane.centre_second);
}

/// The tool side offset across a turning tool is not emulated: better an alarm than a wrong part.
void g_five_axis_cutter(ControlState&, const GCode& code) {
    raise_alarm(5460, fmt::format("G{}.{}", code.code10 / 10, code.code10 % 10));
}

}  // namespace trunnion
