#include "cutter/cutter_path.h"

#include <utility>

#include "cutter/compensated_corner.h"
#include "cutter/corner_piece.h"
#include "cutter/cutter_alarms.h"

namespace trunnion::cutter {

namespace {

/// The alarms of a move belong to its own block, not to the later block that completed it.
template <typename Work>
void at_block(const motion::BlockMarks& marks, Work work) {
    try {
        work();
    } catch (Alarm& alarm) {
        place_alarm(alarm, marks);
        throw;
    }
}

/// An arc that starts or ends at its centre has no direction there.
void check_arc(const PathMove& m) {
    constexpr double tiny_mm = 1e-9;
    if (!m.plane.arc || m.offset_mm == 0.0) return;
    const PlanePoint r0 = m.plane.start - m.plane.centre, r1 = m.plane.end - m.plane.centre;
    if (length_of(r0) < tiny_mm || length_of(r1) < tiny_mm) raise_cutter_alarm(38);
}

}  // namespace

void CutterPath::set(const CutterSettings& settings) {
    path_.settings = settings;
    path_.held.blocks_ahead = settings.blocks_ahead;
}

void CutterPath::reset() {
    engaged_ = paused_ = starts_by_shift_ = false;
    corner_.reset();
    first_.reset();
    idle_.clear();
    path_.last_offset_mm = 0.0;
    path_.held.clear();
    path_.held.block = 0;
}

/// Moves of other axes, dwells and M codes are sent with the tool at its present position in the
/// plane.
void CutterPath::run_idle() {
    const std::vector<PathOutput> idle = std::exchange(idle_, {});
    for (const PathOutput& out : idle) {
        if (out.m_code >= 0 || out.dwell_s >= 0.0) {
            path_.held.add_event(out);
            continue;
        }
        PlaneElement way;
        way.start = way.end = path_.tool_in_plane(out.move);
        path_.send(out.move, way, false);
    }
}

/// Buffered blocks without motion in the plane, except the present one.
int CutterPath::idle_blocks(int line) const {
    int count = 0, last = -1;
    for (const PathOutput& out : idle_) {
        if (out.move.marks.line != last && out.move.marks.line != line) ++count;
        last = out.move.marks.line;
    }
    return count;
}

void CutterPath::release_when_done() {
    if (first_ || corner_ || !idle_.empty() || path_.last_offset_mm != 0.0 || offsets_) return;
    path_.held.release();
    engaged_ = false;
}

/// A straight move from the tool position to the compensated start of `move`.
void CutterPath::link_to(const PathMove& move) {
    PathMove link = move;
    link.plane.arc = false;
    link.to = path_.tool;
    path_.line_to(link, square_to_start(move));
}

void CutterPath::start(const offsets::ControlPosition& program, bool alone) {
    if (!engaged_) {
        reset();
        engaged_ = true;
        path_.tool = program;
    }
    if (alone && path_.settings.startup_type_c && !offsets_) starts_by_shift_ = true;
    offsets_ = true;
}

void CutterPath::end(const std::optional<PathMove>& back) {
    if (back) {
        flush_compensation();
        if (path_.last_offset_mm != 0.0) {
            path_.line_to(*back, back->plane.end);
            path_.last_offset_mm = 0.0;
        }
    }
    offsets_ = false;
    if (engaged_) release_when_done();
}

bool CutterPath::round_next_corner(PlanePoint to) {
    if (!first_) return false;
    first_->corner_arc = true;
    first_->corner_arc_to = to;
    return true;
}

void CutterPath::flush_compensation() {
    if (first_) {
        const PathMove first = *std::exchange(first_, std::nullopt);
        at_block(first.marks, [&] {
            path_.run_beside(first,
                             first.offset_mm == 0.0 ? first.plane.end : square_to_end(first));
        });
        path_.last_offset_mm = first.offset_mm;
    }
    run_idle();
    release_when_done();
}

void CutterPath::compensate(const PathMove& move) {
    check_arc(move);
    if (!move.plane.moves()) {
        PathOutput out;
        out.move = move;
        idle_.push_back(out);
        if (!first_) run_idle();
        return;
    }
    // More blocks without motion than the look-ahead: the move before them ends perpendicular to
    // its end point.
    if (first_ && idle_blocks(move.marks.line) > path_.settings.blocks_ahead) flush_compensation();
    ++path_.held.block;
    if (first_) {
        const PathMove first = *std::exchange(first_, std::nullopt);
        at_block(first.marks, [&] { finish_first(path_, first, move); });
        path_.last_offset_mm = first.offset_mm;
        run_idle();
    } else if (move.offset_mm != 0.0 && (path_.last_offset_mm != 0.0 || starts_by_shift_)) {
        // After an interruption in mid-path the tool is perpendicular to the last move. It moves
        // round the corner to the start of the next move. A start-up of type C begins in the same
        // way.
        run_idle();
        link_to(move);
        path_.last_offset_mm = move.offset_mm;
    }
    starts_by_shift_ = false;
    first_ = move;
    if (move.offset_mm == 0.0) flush_compensation();  // cancelling needs no look-ahead
}

void CutterPath::add(const PathMove& move, const offsets::ControlPosition& program) {
    if (!engaged_) {
        engaged_ = true;
        path_.tool = program;
    }
    PathMove next = move;
    if (corner_) {
        if (!next.plane.moves()) raise_cutter_alarm(51);
        PathMove first = *std::exchange(corner_, std::nullopt);
        const auto piece = take_corner(first, next);
        compensate(first);
        if (piece) compensate(*piece);
    }
    if ((next.chamfer || next.round) && next.corner_mm > 0.0 && next.plane.moves())
        corner_ = next;
    else
        compensate(next);
    engaged_ = engaged_ || corner_.has_value();
}

void CutterPath::add_event(const PathOutput& event) {
    if (corner_) raise_cutter_alarm(51);
    if (first_)
        idle_.push_back(event);
    else
        path_.held.add_event(event);
}

void CutterPath::flush() {
    if (!engaged_) return;
    if (corner_) raise_cutter_alarm(51);
    flush_compensation();
    path_.held.release();
}

offsets::ControlPosition CutterPath::pause(const offsets::ControlPosition& program) {
    flush();
    paused_ = true;
    for (std::size_t i = 0; i < axis_count; ++i)
        programmed_from_tool_.value[i] = program.value[i] - path_.tool.value[i];
    return path_.tool;
}

offsets::ControlPosition CutterPath::resume(const offsets::ControlPosition& program,
                                            bool axes_moved) {
    paused_ = false;
    path_.tool = program;
    offsets::ControlPosition out = program;
    if (axes_moved) {
        path_.last_offset_mm = 0.0;
        return out;
    }
    for (std::size_t i = 0; i < axis_count; ++i) out.value[i] += programmed_from_tool_.value[i];
    return out;
}

}  // namespace trunnion::cutter
