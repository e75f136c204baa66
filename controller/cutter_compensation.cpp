// G41, G42, G40: the tool runs beside the programmed path. Start-up types A and B (5003#0), corners
// with straight extensions, interference alarms PS0041, PS0033, PS0034, PS0038.
#include <cmath>

#include "controller/control_state.h"
#include "controller/g_codes.h"
#include "controller/g_handlers.h"
#include "controller/moves.h"
#include "controller/path_queue.h"

namespace trunnion {

namespace {

/// Blocks without way in the plane that the control reads ahead (19625, assumed 3): with more, the
/// move before them ends square to its end.
constexpr std::size_t idle_limit = 3;

PlanePoint plane_point(const ControlState& c, const ControlPosition& p) {
    const PlaneAxes& plane = plane_axes(c.modal);
    return {p[plane.first], p[plane.second]};
}

PlanePoint square_to_end(const PathMove& m) {
    return m.plane.end + m.offset_mm * left_of(tangent_at_end(m.plane));
}
PlanePoint square_to_start(const PathMove& m) {
    return m.plane.start + m.offset_mm * left_of(tangent_at_start(m.plane));
}

void line_to(ControlState& c, const PathMove& m, PlanePoint end) {
    PlaneElement way;
    way.start = plane_point(c, c.path.tool);
    way.end = end;
    send_path(c, m, way, m.to);
}

/// An arc smaller than the cutter has no path beside it.
void check_radius(const PathMove& m) {
    if (!m.plane.arc) return;
    const double radius = offset_radius(m.plane, m.offset_mm);
    if (std::abs(radius) <= 1e-6) raise_alarm(38);
    if (radius < 0.0) raise_alarm(41);
}

/// The tool must not run backwards along the side: the cutter does not fit.
void check_interference(const PathMove& m, const PlaneElement& way) {
    constexpr double slack_mm = 1e-6;
    if (!m.plane.arc) {
        if (dot(way.end - way.start, tangent_at_start(m.plane)) < -slack_mm) raise_alarm(41);
        return;
    }
    check_radius(m);
    if (way.sweep_rad * m.plane.sweep_rad < 0.0) raise_alarm(41);
}

/// The first move up to `end` beside its path (from where the tool stands).
void run_first(ControlState& c, const PathMove& m, PlanePoint end) {
    const bool free = c.path.last_offset_mm == 0.0 && m.offset_mm == 0.0;  // a corner alone
    const bool starts = !free && c.path.last_offset_mm == 0.0, ends = !free && m.offset_mm == 0.0;
    if (m.plane.arc && (starts || ends)) raise_alarm(34);
    PlaneElement way;
    if (m.plane.arc) {
        way = between(m.plane, plane_point(c, c.path.tool), end);
    } else {
        way.start = plane_point(c, c.path.tool);
        way.end = end;
    }
    if (!starts && !ends) check_interference(m, way);
    send_path(c, m, way, m.to);
}

struct Corner {
    bool inside = false;
    bool acute = false;  ///< outside, the path turns by more than 90 degrees
    bool straight = false;
    PlanePoint t1, t2;
};

Corner corner_of(const PathMove& first, const PathMove& second) {
    Corner out;
    out.t1 = tangent_at_end(first.plane);
    out.t2 = tangent_at_start(second.plane);
    const double turn = cross(out.t1, out.t2), along = dot(out.t1, out.t2);
    const double offset = first.offset_mm != 0.0 ? first.offset_mm : second.offset_mm;
    out.straight = std::abs(turn) < 1e-7 && along > 0.0;
    out.inside = turn * offset > 0.0 && !(std::abs(turn) < 1e-7);
    out.acute = !out.inside && along < 0.0;
    return out;
}

/// Inside corner: both offset paths end where they meet.
void inside_corner(ControlState& c, const PathMove& first, const PathMove& second) {
    check_radius(first);
    check_radius(second);
    const auto meeting = offset_meeting(first.plane, first.offset_mm, second.plane,
                                        second.offset_mm, first.plane.end);
    if (!meeting) raise_alarm(33);
    run_first(c, first, *meeting);
}

/// Outside corner: straight pieces round the corner point; an arc ends square to its end first.
void outside_corner(ControlState& c, const PathMove& first, const PathMove& second,
                    const Corner& corner) {
    const PlanePoint p = first.plane.end;
    const PlanePoint n1 = left_of(corner.t1), n2 = left_of(corner.t2);
    const double o = first.offset_mm, r = std::abs(o);
    const PlanePoint end1 = p + o * n1, start2 = p + second.offset_mm * n2;
    const PlanePoint beyond =
        corner.acute ? end1 + r * corner.t1 : p + (o / (1.0 + dot(n1, n2))) * (n1 + n2);
    run_first(c, first, first.plane.arc ? end1 : beyond);
    if (first.plane.arc) line_to(c, first, beyond);
    if (corner.acute) line_to(c, first, start2 - r * corner.t2);
    if (second.plane.arc) line_to(c, first, start2);
}

/// Start-up: type A goes to the point square to the start of the second move; type B as if it had
/// been compensated before, outside corners only.
void start_up(ControlState& c, const PathMove& first, const PathMove& second) {
    const Corner corner = corner_of(first, second);
    if (!c.settings.startup_type_b || corner.inside || corner.straight)
        return run_first(c, first, square_to_start(second));
    outside_corner(c, first, second, corner);
}

/// `first` is finished now that `second` is known.
void finish_first(ControlState& c, const PathMove& first, const PathMove& second) {
    const double before = c.path.last_offset_mm;
    if (first.offset_mm == 0.0) return run_first(c, first, first.plane.end);
    if (second.offset_mm == 0.0) return run_first(c, first, square_to_end(first));
    if (before == 0.0) return start_up(c, first, second);
    if (first.offset_mm != second.offset_mm) {  // other side or other D
        run_first(c, first, square_to_end(first));
        return line_to(c, first, square_to_start(second));
    }
    const Corner corner = corner_of(first, second);
    if (corner.straight)
        run_first(c, first, square_to_end(first));
    else if (corner.inside)
        inside_corner(c, first, second);
    else
        outside_corner(c, first, second, corner);
}

/// Moves of other axes go out where the tool stands in the plane.
void run_idle(ControlState& c) {
    const std::vector<PathMove> idle = std::move(c.path.idle);
    c.path.idle.clear();
    for (const PathMove& m : idle) {
        PlaneElement way;
        way.end = plane_point(c, c.path.tool);
        send_path(c, m, way, m.to);
    }
}

void release_when_done(ControlState& c) {
    const PathQueue& q = c.path;
    if (q.first || q.corner || !q.idle.empty() || q.last_offset_mm != 0.0) return;
    if (!c.modal.is(ModalGroup::cutter, 400)) return;
    c.path.engaged = false;
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

void pause_path(ControlState& c) {
    flush_path(c);
    for (std::size_t i = 0; i < axis_count; ++i)
        c.path.programmed_from_tool.value[i] = c.program.value[i] - c.path.tool.value[i];
    c.program = c.path.tool;
}

void resume_path(ControlState& c, bool axes_moved) {
    c.path.tool = c.program;
    if (axes_moved) {  // G28, G53 and the like: compensation starts anew
        c.path.last_offset_mm = 0.0;
        return;
    }
    for (std::size_t i = 0; i < axis_count; ++i)
        c.program.value[i] += c.path.programmed_from_tool.value[i];
}

void flush_compensation(ControlState& c) {
    PathQueue& q = c.path;
    if (q.first) {
        const PathMove first = *q.first;
        q.first.reset();
        run_first(c, first, first.offset_mm == 0.0 ? first.plane.end : square_to_end(first));
        q.last_offset_mm = first.offset_mm;
    }
    run_idle(c);
    release_when_done(c);
}

void compensate(ControlState& c, const PathMove& move) {
    PathQueue& q = c.path;
    if (!move.plane.moves()) {
        if (!q.first && q.last_offset_mm == 0.0) {  // nothing compensated yet: straight out
            PlaneElement way;
            way.end = plane_point(c, q.tool);
            return send_path(c, move, way, move.to);
        }
        q.idle.push_back(move);
        if (q.idle.size() > idle_limit) flush_compensation(c);
        return;
    }
    if (q.first) {
        const PathMove first = *q.first;
        q.first.reset();
        finish_first(c, first, move);
        q.last_offset_mm = first.offset_mm;
        run_idle(c);
    } else if (q.last_offset_mm != 0.0 && move.offset_mm != 0.0) {
        // After a stop in mid-path the tool stands square to the last side; it goes round the
        // corner to the start of the next one.
        run_idle(c);
        PathMove link = move;
        link.plane.arc = false;
        line_to(c, link, square_to_start(move));
    }
    q.first = move;
    if (move.offset_mm == 0.0) flush_compensation(c);  // the way out needs no look ahead
}

void g_cutter(ControlState& c, const GCode& code) {
    if (c.words.has('D')) c.radius_number = c.whole_word('D');
    if (c.radius_number < 0 || c.radius_number >= static_cast<int>(c.stores.tools.tool.size()))
        raise_alarm(30, c.words.column_of('D'));
    const int motion = c.modal[ModalGroup::motion];
    const bool arc = motion == 20 || motion == 30;
    const bool changes = c.modal.is(ModalGroup::cutter, 400) != (code.code10 == 400);
    if (arc && changes && c.words.has_axis()) raise_alarm(34);
    if (code.code10 == 400) {
        c.modal.set(ModalGroup::cutter, 400);
        return;
    }
    if (!c.path.engaged) {
        c.path = PathQueue{};
        c.path.engaged = true;
        c.path.tool = c.program;
    }
    c.modal.set(ModalGroup::cutter, code.code10);
}

}  // namespace trunnion
