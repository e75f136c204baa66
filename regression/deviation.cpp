#include "regression/deviation.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace trunnion::regression {

namespace {

constexpr std::size_t most_points = 400;

std::vector<PathPoint> chord_points(SegmentWindow& path, Stretch s, const Tolerances& tolerances) {
    std::vector<PathPoint> points{path[s.first - 1].end()};
    const std::uint64_t step = 1 + (s.last - s.first) / most_points;
    std::vector<PathPoint> chords;
    for (std::uint64_t k = s.first; k < s.last; k += step) {
        chords.clear();
        append_chords(path[k - 1].end(), path[k], tolerances, chords);
        const std::size_t stride = 1 + chords.size() / 64;
        for (std::size_t c = 0; c + 1 < chords.size(); c += stride) points.push_back(chords[c]);
        points.push_back(chords.back());
    }
    return points;
}

/// Distance of a point from a chord line; the direction is compared at the nearest point.
Deviation from_line(const PathPoint& p, const std::vector<PathPoint>& line) {
    Deviation least{std::numeric_limits<double>::infinity(), 0.0};
    for (std::size_t k = 0; k < line.size(); ++k) {
        const PathPoint& from = line[k];
        const PathPoint& to = line[std::min(k + 1, line.size() - 1)];
        const Vector3 step = to.position_mm - from.position_mm;
        const double along = (p.position_mm - from.position_mm).dot(step);
        const double t = std::clamp(along / std::max(step.squaredNorm(), 1e-30), 0.0, 1.0);
        const double distance = (from.position_mm + t * step - p.position_mm).norm();
        const Vector3 d = from.orientation + t * (to.orientation - from.orientation);
        const double turn = (d - p.orientation).norm();
        if (distance < least.position_mm - 1e-12)
            least = {distance, turn};
        else if (distance < least.position_mm + 1e-12)
            least.direction_rad = std::min(least.direction_rad, turn);
    }
    return least;
}

void widen(Deviation& worst, const std::vector<PathPoint>& points,
           const std::vector<PathPoint>& line) {
    for (const PathPoint& p : points) {
        const Deviation d = from_line(p, line);
        worst.position_mm = std::max(worst.position_mm, d.position_mm);
        worst.direction_rad = std::max(worst.direction_rad, d.direction_rad);
    }
}

/// The stretch of a path longer by blocks that lie on the line of the other path, up to the ends of
/// that: one block there may be many here, of which only some differ. Unchanged where it is not so.
class LongerStretch {
  public:
    LongerStretch(SegmentWindow& path, const std::vector<PathPoint>& other, double tolerance_mm)
        : path_(path), other_(other), near_mm_(2.0 * tolerance_mm) {}

    Stretch of(Stretch s) {
        Stretch longer = s;
        for (std::uint64_t k = s.first - 1; s.first - k <= most; --k) {
            if (is_at(k, other_.front())) {
                longer.first = k + 1;
                break;
            }
            if (k == 0 || (k + 1 < s.first && !is_on(k))) break;
        }
        for (std::uint64_t k = s.last - 1; k < path_.size() && k + 1 - s.last < most; ++k) {
            if (is_at(k, other_.back())) {
                longer.last = k + 1;
                break;
            }
            if (k >= s.last && !is_on(k)) break;
        }
        return longer;
    }

  private:
    static constexpr std::uint64_t most = 1024;
    bool is_at(std::uint64_t k, const PathPoint& place) {
        return (path_[k].end().position_mm - place.position_mm).norm() <= near_mm_;
    }
    bool is_on(std::uint64_t k) {
        return from_line(path_[k].end(), other_).position_mm <= near_mm_;
    }

    SegmentWindow& path_;
    const std::vector<PathPoint>& other_;
    double near_mm_;
};

}  // namespace

Deviation deviation_between(SegmentWindow& a_path, Stretch a, SegmentWindow& b_path, Stretch b,
                            const Tolerances& tolerances) {
    const auto a_points = chord_points(a_path, a, tolerances);
    const auto b_points = chord_points(b_path, b, tolerances);
    Stretch long_a = a, long_b = b;
    if (a.first < a.last && b.first < b.last) {
        long_a = LongerStretch(a_path, b_points, tolerances.position_mm).of(a);
        long_b = LongerStretch(b_path, a_points, tolerances.position_mm).of(b);
    }
    Deviation worst;
    widen(worst, a_points, chord_points(b_path, long_b, tolerances));
    widen(worst, b_points, chord_points(a_path, long_a, tolerances));
    return worst;
}

std::optional<Vector3> common_shift(SegmentWindow& a_path, Stretch a, SegmentWindow& b_path,
                                    Stretch b, const Tolerances& tolerances) {
    if (a.last - a.first != b.last - b.first || a.first == a.last) return std::nullopt;
    const auto shift_at = [&](std::uint64_t k) -> Vector3 {
        return b_path[b.first + k].end().position_mm - a_path[a.first + k].end().position_mm;
    };
    const std::uint64_t count = a.last - a.first;
    const Vector3 shift = shift_at(0);
    if (shift.norm() <= tolerances.position_mm) return std::nullopt;
    for (std::uint64_t k = 0; k < count; ++k) {
        const Segment &sa = a_path[a.first + k], sb = b_path[b.first + k];
        if (sa.kind != sb.kind || sa.is_arc() != sb.is_arc()) return std::nullopt;
        const Vector3 here = shift_at(k);
        const bool back = k + 1 == count && here.norm() <= tolerances.position_mm;
        if (!back && (here - shift).norm() > tolerances.position_mm) return std::nullopt;
        if ((sa.end().orientation - sb.end().orientation).norm() > tolerances.direction_rad)
            return std::nullopt;
    }
    return shift;
}

}  // namespace trunnion::regression
