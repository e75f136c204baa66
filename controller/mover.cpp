#include "controller/mover.h"

#include <utility>

namespace trunnion::controller {

Mover::Mover(const SortedWords& words, Modal& modal, Frames& frames, motion::MotionSink& sink)
    : axes(words, modal, frames, sink),
      cutter(*this),
      modal_(modal),
      frames_(frames),
      tip_(words, modal, frames, axes) {}

motion::MoveResult Mover::line(motion::MotionKind kind, const offsets::ControlPosition& target) {
    if (frames_.tip.in_force) return tip_.line(kind, target);
    frames_.follow_fixture(modal_.settings, target);
    return axes.straight(kind, target);
}

void Mover::arc(motion::MotionKind kind, const offsets::ControlPosition& target,
                const ProgramArc& arc) {
    if (frames_.tip.in_force) return tip_.arc(kind, target, arc);
    frames_.follow_fixture(modal_.settings, target);
    axes.arc(kind, target, arc);
}

void Mover::queue(const cutter::PathMove& move) {
    const offsets::ControlPosition from = std::exchange(frames_.program, move.to);
    cutter.add(move, from);
}

void Mover::queue_event(cutter::PathOutput event) {
    event.move.marks = modal_.block;
    cutter.add_event(event);
}

void Mover::dwell(double duration_s) {
    if (!cutter.engaged()) return axes.dwell(duration_s);
    cutter::PathOutput event;
    event.dwell_s = duration_s;
    queue_event(event);
}

void Mover::m_code(int code) {
    if (!cutter.engaged()) return axes.m_code(code);
    cutter::PathOutput event;
    event.m_code = code;
    queue_event(event);
}

void Mover::pause() {
    frames_.program = cutter.pause(frames_.program);
}

void Mover::resume(bool axes_moved) {
    frames_.program = cutter.resume(frames_.program, axes_moved);
}

void Mover::frames_changed() {
    const bool waits = cutter.engaged() && !cutter.paused();
    if (waits) pause();
    frames_.recompute();
    if (waits) resume(false);
}

void Mover::carry(const cutter::PathOutput& out) {
    frames_.program = out.from;
    const PlaneElement& way = out.way;
    if (!way.arc)
        return void(
            line(out.move.rapid ? motion::MotionKind::rapid : motion::MotionKind::linear, out.to));
    const motion::PlaneAxes& plane = out.move.axes;
    const ProgramArc round{in_space(plane, frames_.program, way.centre), unit_along(plane.normal),
                           way.sweep_rad};
    arc(way.sweep_rad < 0.0 ? motion::MotionKind::arc_cw : motion::MotionKind::arc_ccw, out.to,
        round);
}

/// A buffered move is sent with the state of its own block, which precedes the running one.
void Mover::take(const cutter::PathOutput& out) {
    if (out.m_code >= 0) return axes.m_code(out.m_code);
    if (out.dwell_s >= 0.0) return axes.dwell(out.dwell_s);
    const offsets::ControlPosition programmed = frames_.program;
    const motion::BlockMarks now = std::exchange(modal_.block, out.move.marks);
    carry(out);
    modal_.block = now;
    frames_.program = programmed;
}

Vector3 in_space(const motion::PlaneAxes& plane, const offsets::ControlPosition& p,
                 PlanePoint point) {
    Vector3 out = offsets::xyz_of(p);
    out[static_cast<Eigen::Index>(index_of(plane.first))] = point.x;
    out[static_cast<Eigen::Index>(index_of(plane.second))] = point.y;
    return out;
}

}  // namespace trunnion::controller
