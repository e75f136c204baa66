#include "regression/closeup.h"

#include <algorithm>
#include <cmath>

#include "regression/arrays.h"
#include "regression/chords.h"

namespace trunnion::regression {

namespace {

using Points = std::vector<PathPoint>;

/// The points of a stretch, including its start.
Points points_of(const PathRecord& record, Stretch stretch, const Tolerances& tolerances) {
    constexpr std::uint64_t longest = 400;
    SegmentWindow path(record.segments());
    Points points;
    const std::uint64_t first = std::max<std::uint64_t>(1, stretch.first);
    const std::uint64_t last = std::min({stretch.last, path.size(), first + longest});
    for (std::uint64_t k = first; k < last; ++k) {
        const PathPoint start = path[k - 1].end();
        const Segment segment = path[k];
        if (segment.kind == SegmentKind::jump) continue;  // no motion
        if (points.empty()) points.push_back(start);
        append_chords(start, segment, tolerances, points);
    }
    return points;
}

Stretch widened(Stretch stretch) {
    constexpr std::uint64_t by = 3;
    return {stretch.first - std::min(stretch.first, by), stretch.last + by};
}

Vector3 nearest_on(const Points& line, const Vector3& place) {
    Vector3 best = line.front().position_mm;
    for (std::size_t k = 1; k < line.size(); ++k) {
        const Vector3 from = line[k - 1].position_mm, way = line[k].position_mm - from;
        const double length2 = way.squaredNorm();
        const double t =
            length2 > 0.0 ? std::clamp((place - from).dot(way) / length2, 0.0, 1.0) : 0.0;
        const Vector3 at = from + t * way;
        if ((at - place).norm() < (best - place).norm()) best = at;
    }
    return best;
}

/// A point of a line, the direction of the line there, and the nearest point of the other line.
struct Farthest {
    Vector3 place = Vector3::Zero(), way = Vector3::Zero(), other = Vector3::Zero();
    Vector3 axis = Vector3::UnitZ();
    double apart_mm = -1.0;
};

Farthest farthest(const Points& line, const Points& other) {
    Farthest best;
    const auto look = [&](const Vector3& place, const Vector3& way, const Vector3& axis) {
        const Vector3 near = nearest_on(other, place);
        const double apart_mm = (near - place).norm();
        if (apart_mm > best.apart_mm + 1e-9) best = {place, way, near, axis, apart_mm};
    };
    for (std::size_t k = 1; k < line.size(); ++k) {
        const Vector3 p = line[k - 1].position_mm, q = line[k].position_mm;
        look(0.5 * (p + q), q - p, line[k].orientation);
        look(q, q - p, line[k].orientation);
    }
    return best;
}

Vector3 across(const Vector3& v, const Vector3& wanted) {
    const Vector3 rest = wanted - wanted.dot(v) * v;
    return rest.norm() > 1e-9 ? rest.normalized() : v.unitOrthogonal();
}

Vector3 axis_near(const Points& line, const Vector3& place) {
    const auto nearer = [&place](const PathPoint& p, const PathPoint& q) {
        return (p.position_mm - place).norm() < (q.position_mm - place).norm();
    };
    return std::min_element(line.begin(), line.end(), nearer)->orientation;
}

ComparePicture::Line line_of(const Points& points) {
    ComparePicture::Line line;
    for (const PathPoint& p : points) line.push_back(array_of(p.position_mm));
    return line;
}

}  // namespace

std::optional<ComparePicture::Closeup> closeup_of(const PathRecord& a, Stretch in_a,
                                                  const PathRecord& b, Stretch in_b,
                                                  const Tolerances& tolerances) {
    const Points around_a = points_of(a, widened(in_a), tolerances),
                 around_b = points_of(b, widened(in_b), tolerances);
    if (around_a.size() < 2 || around_b.size() < 2) return std::nullopt;
    const Points core_a = points_of(a, in_a, tolerances), core_b = points_of(b, in_b, tolerances);
    const Farthest from_a = farthest(core_a, around_b), from_b = farthest(core_b, around_a);
    const Farthest& worst = from_a.apart_mm + 1e-9 >= from_b.apart_mm ? from_a : from_b;
    if (!(worst.apart_mm > tolerances.position_mm) || worst.way.norm() == 0.0) return std::nullopt;
    ComparePicture::Closeup c;
    const Vector3 right = worst.way.normalized();
    c.place_mm = array_of(worst.place);
    c.other_mm = array_of(worst.other);
    c.right = array_of(right);
    c.up = array_of(across(right, worst.other - worst.place));
    c.axis_a = array_of(axis_near(around_a, worst.place));
    c.axis_b = array_of(axis_near(around_b, worst.place));
    c.a = line_of(around_a);
    c.b = line_of(around_b);
    return c;
}

}  // namespace trunnion::regression
