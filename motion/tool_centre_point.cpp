#include "motion/tool_centre_point.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/units.h"

namespace trunnion::motion {

ToolCentrePoint ToolCentrePoint::start(const positioning::RotaryTransform& transform,
                                       const AxisPositions& present, positioning::TcpFrame frame,
                                       const Vector3& tool_vector_mm) {
    ToolCentrePoint tcp;
    tcp.transform = &transform;
    tcp.follows_work = transform.pivot().frame_follows_work;
    tcp.tool_vector_mm = tool_vector_mm;
    if (frame == positioning::TcpFrame::start) tcp.pose_WM0 = transform.pose_MW(present).inverse();
    return tcp;
}

Vector3 ToolCentrePoint::tip_W(const Vector3& programmed_M_mm,
                               const AxisPositions& rotaries) const {
    if (follows_work) return transform->pose_MW(rotaries).inverse() * programmed_M_mm;
    return pose_WM0 * programmed_M_mm;
}

Vector3 ToolCentrePoint::programmed_tip_M(const AxisPositions& machine) const {
    const Vector3 tip = transform->tip_W(machine, tool_vector_mm);
    return follows_work ? transform->pose_MW(machine) * tip : pose_WM0.inverse() * tip;
}

namespace {

AxisPositions between(const AxisPositions& from, const AxisPositions& to, double s) {
    AxisPositions q;
    for (std::size_t i = 0; i < axis_count; ++i)
        q.value[i] = from.value[i] + s * (to.value[i] - from.value[i]);
    return q;
}

}  // namespace

AxisPositions TipLine::at(double s) const {
    if (s <= 0.0) return from_;
    if (s >= 1.0) return to_;
    return tcp_.machine(start_W_ + s * (end_W_ - start_W_), between(from_, to_, s));
}

AxisPositions TipArc::at(double s) const {
    if (s <= 0.0) return from_;
    if (s >= 1.0) return to_;
    return tcp_.machine(point_on_arc(way_.arc_W, way_.start_W, way_.end_W, s),
                        between(from_, to_, s));
}

Vector3 leaned(const Vector3& n_W, const Vector3& travel_W, double lean_rad) {
    const Vector3 across = travel_W - travel_W.dot(n_W) * n_W;
    const double size = across.norm();
    if (size < 1e-9 || lean_rad == 0.0) return n_W;
    return std::cos(lean_rad) * n_W + std::sin(lean_rad) * (across / size);
}

namespace {

double chord_error_mm(const AxisPositions& a, const AxisPositions& b, const AxisPositions& between,
                      double part) {
    double square = 0.0;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
        const double d = a[axis] + part * (b[axis] - a[axis]) - between[axis];
        square += d * d;
    }
    return std::sqrt(square);
}

constexpr int deepest_split = 16;

struct Span {
    double s0, s1;
    AxisPositions q0, q1;
    int depth;
};

bool straight_enough(const PathCurve& curve, const Span& span, double tolerance_mm) {
    for (const double part : {0.5, 0.25, 0.75}) {
        const AxisPositions q = curve.at(span.s0 + part * (span.s1 - span.s0));
        if (chord_error_mm(span.q0, span.q1, q, part) > tolerance_mm) return false;
    }
    return true;
}

void split(const PathCurve& curve, const Span& span, double tolerance_mm,
           std::vector<double>& steps) {
    if (span.depth < deepest_split && !straight_enough(curve, span, tolerance_mm)) {
        const double middle = 0.5 * (span.s0 + span.s1);
        const AxisPositions q = curve.at(middle);
        split(curve, {span.s0, middle, span.q0, q, span.depth + 1}, tolerance_mm, steps);
        split(curve, {middle, span.s1, q, span.q1, span.depth + 1}, tolerance_mm, steps);
        return;
    }
    steps.push_back(span.s1);
}

}  // namespace

std::vector<double> chord_steps(const PathCurve& curve, double tolerance_mm) {
    std::vector<double> steps{0.0};
    // Start with four intervals: a curve may cross its own chord in the middle.
    for (int i = 0; i < 4; ++i) {
        const double s0 = 0.25 * i, s1 = 0.25 * (i + 1);
        split(curve, {s0, s1, curve.at(s0), curve.at(s1), 2}, tolerance_mm, steps);
    }
    return steps;
}

int curve_parts(const AxisPositions& from, const AxisPositions& to) {
    double turn_rad = 0.0;
    for (const Axis axis : {Axis::A, Axis::B, Axis::C})
        turn_rad = std::max(turn_rad, std::abs(to[axis] - from[axis]));
    return std::clamp(static_cast<int>(turn_rad / rad_from_deg(5.0)) + 1, 1, 256);
}

}  // namespace trunnion::motion
