#include "controller/arc_3d.h"

#include <cmath>
#include <utility>

#include "controller/alarms.h"
#include "controller/commanded.h"

namespace trunnion::controller {

std::optional<ProgramArc> arc_through(const Vector3& start, const Vector3& middle,
                                      const Vector3& end) {
    const Vector3 a = start - end, b = middle - end;
    const Vector3 across = a.cross(b);
    if (across.norm() <= 1e-9 * a.norm() * b.norm()) return std::nullopt;
    ProgramArc arc;
    // From the third corner to the centre of the circle through the triangle.
    const Vector3 to_centre =
        (a.squaredNorm() * b - b.squaredNorm() * a).cross(across) / (2.0 * across.squaredNorm());
    arc.centre = end + to_centre;
    // start -> middle -> end is a positive rotation about this normal.
    arc.normal = (middle - start).cross(end - middle).normalized();
    const Vector3 from = start - arc.centre, to = end - arc.centre;
    const double angle = std::atan2(arc.normal.dot(from.cross(to)), from.dot(to));
    arc.sweep_rad = angle > 0.0 ? angle : angle + 2.0 * pi;
    return arc;
}

void Arc3d::check_goes_on(const SortedWords& words) const {
    if (!on_the_way_) return;
    const bool end_point = words.has_axis() && words.code_count == 0 && words.m_count == 0 &&
                           (!words.motion || words.motion->code10 % 10 == 4);
    if (!end_point) raise_alarm(9004);
}

void Arc3d::move(const SortedWords& words, Modal& modal, Frames& frames, Mover& mover) {
    if (words.present & rotary_letters) raise_alarm(9004, "(a rotary word)");
    const offsets::ControlPosition start = frames.program;
    if (!on_the_way_) {
        on_the_way_ = commanded_position(words, modal, frames);
        return;
    }
    const offsets::ControlPosition middle = *std::exchange(on_the_way_, std::nullopt);
    frames.program = middle;  // incremental words (G91) start there
    const offsets::ControlPosition end = commanded_position(words, modal, frames);
    frames.program = start;
    const auto arc =
        arc_through(offsets::xyz_of(start), offsets::xyz_of(middle), offsets::xyz_of(end));
    if (!arc) raise_alarm(9004, "(three points in a line)");
    mover.arc(motion::MotionKind::arc_ccw, end, *arc);
}

}  // namespace trunnion::controller
