#include "regression/chords.h"

#include <algorithm>
#include <cmath>

namespace trunnion::regression {

namespace {

Vector3 normal_of(const Segment& s) {
    return Vector3(s.normal[0], s.normal[1], s.normal[2]);
}

/// Start and end of an arc in its plane: radii as vectors, and the rise along the normal.
struct ArcFrame {
    Vector3 centre, normal, radius_start;
    double end_over_start_radius = 1.0;
    double start_height = 0.0, end_height = 0.0;
};

ArcFrame arc_frame(const PathPoint& start, const Segment& segment) {
    ArcFrame f;
    f.centre = Vector3(segment.centre_mm.data());
    f.normal = normal_of(segment).normalized();
    const Vector3 from = start.position_mm - f.centre;
    const Vector3 to = Vector3(segment.end_mm.data()) - f.centre;
    f.start_height = from.dot(f.normal);
    f.end_height = to.dot(f.normal);
    f.radius_start = from - f.start_height * f.normal;
    const double radius_end = (to - f.end_height * f.normal).norm();
    const double radius = f.radius_start.norm();
    f.end_over_start_radius = radius > 0.0 ? radius_end / radius : 1.0;
    return f;
}

Vector3 arc_point(const ArcFrame& f, double sweep_rad, double s) {
    const double angle = sweep_rad * s;
    const double scale = 1.0 + s * (f.end_over_start_radius - 1.0);
    return f.centre +
           scale * (std::cos(angle) * f.radius_start +
                    std::sin(angle) * f.normal.cross(f.radius_start)) +
           (f.start_height + s * (f.end_height - f.start_height)) * f.normal;
}

PathPoint middle(const PathPoint& a, const PathPoint& b, double s) {
    return {a.position_mm + s * (b.position_mm - a.position_mm),
            a.orientation + s * (b.orientation - a.orientation)};
}

bool within_chord(const PathPoint& a, const PathPoint& b, const Tolerances& t) {
    return (a.position_mm - b.position_mm).squaredNorm() <= t.chord_mm() * t.chord_mm() &&
           (a.orientation - b.orientation).squaredNorm() <= t.chord_rad() * t.chord_rad();
}

struct CurveSampler {
    const std::function<PathPoint(double)>& at;
    const Tolerances& tolerances;
    std::vector<PathPoint>& points;

    void cut(double s0, const PathPoint& p0, double s1, const PathPoint& p1, int depth) const {
        const double sm = 0.5 * (s0 + s1);
        const PathPoint pm = at(sm);
        if (depth <= 0 ||
            (within_chord(pm, middle(p0, p1, 0.5), tolerances) &&
             within_chord(at(0.75 * s0 + 0.25 * s1), middle(p0, p1, 0.25), tolerances))) {
            points.push_back(p1);
            return;
        }
        cut(s0, p0, sm, pm, depth - 1);
        cut(sm, pm, s1, p1, depth - 1);
    }
};

}  // namespace

PathPoint point_at(const PathPoint& start, const Segment& segment, double s) {
    PathPoint p = middle(start, segment.end(), s);
    if (segment.is_arc())
        p.position_mm = arc_point(arc_frame(start, segment), segment.sweep_rad, s);
    return p;
}

double length_mm(const PathPoint& start, const Segment& segment) {
    if (!segment.is_arc()) return (Vector3(segment.end_mm.data()) - start.position_mm).norm();
    const ArcFrame f = arc_frame(start, segment);
    const double radius = 0.5 * (1.0 + f.end_over_start_radius) * f.radius_start.norm();
    return std::hypot(radius * segment.sweep_rad, f.end_height - f.start_height);
}

Vector3 centroid(const PathPoint& start, const Segment& segment) {
    const Vector3 end = Vector3(segment.end_mm.data());
    if (!segment.is_arc()) return 0.5 * (start.position_mm + end);
    const ArcFrame f = arc_frame(start, segment);
    const double angle = segment.sweep_rad;
    const double scale = 0.5 * (1.0 + f.end_over_start_radius);
    return f.centre + 0.5 * (f.start_height + f.end_height) * f.normal +
           scale / angle *
               (std::sin(angle) * f.radius_start +
                (1.0 - std::cos(angle)) * f.normal.cross(f.radius_start));
}

void append_chords(const PathPoint& start, const Segment& segment, const Tolerances& tolerances,
                   std::vector<PathPoint>& points) {
    const PathPoint end = segment.end();
    if (segment.is_arc()) {
        const ArcFrame f = arc_frame(start, segment);
        const double radius = f.radius_start.norm() * std::max(1.0, f.end_over_start_radius);
        const double sagitta = std::min(1.0, tolerances.chord_mm() / std::max(radius, 1e-12));
        const double step = 2.0 * std::acos(1.0 - sagitta);
        const int count = static_cast<int>(
            std::clamp(std::ceil(std::abs(segment.sweep_rad) / std::max(step, 1e-5)), 1.0, 1e6));
        for (int k = 1; k < count; ++k) {
            const double s = static_cast<double>(k) / count;
            PathPoint p = middle(start, end, s);
            p.position_mm = arc_point(f, segment.sweep_rad, s);
            points.push_back(p);
        }
    }
    points.push_back(end);
}

void sample_curve(const std::function<PathPoint(double)>& at, int pieces,
                  const Tolerances& tolerances, std::vector<PathPoint>& points) {
    const CurveSampler sampler{at, tolerances, points};
    PathPoint from = at(0.0);
    for (int k = 0; k < pieces; ++k) {
        const double s0 = static_cast<double>(k) / pieces;
        const double s1 = static_cast<double>(k + 1) / pieces;
        const PathPoint to = at(s1);
        sampler.cut(s0, from, s1, to, 14);
        from = to;
    }
}

}  // namespace trunnion::regression
