#include "regression/moved_pivot.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "positioning/rotary_transform.h"

namespace trunnion::regression {

namespace {

/// One shift with the pose where it occurred.
struct SeenShift {
    Vector3 shift_mm, direction;
    Matrix3 turned;  ///< R' - I
};

AxisPositions rotary_at(SpilledWindow<RotaryRow>& rows, std::uint64_t segment) {
    std::uint64_t low = 0, high = rows.size();
    while (low + 1 < high) {
        const std::uint64_t middle = (low + high) / 2;
        (rows[middle].first_segment <= segment ? low : high) = middle;
    }
    const auto deg = rows[low].rotary_deg;
    AxisPositions at;
    at[Axis::A] = rad_from_deg(deg[0]);
    at[Axis::B] = rad_from_deg(deg[1]);
    at[Axis::C] = rad_from_deg(deg[2]);
    return at;
}

std::vector<SeenShift> shifts_of(const std::vector<PathCluster>& clusters,
                                 const MovedPivotInput& in) {
    std::vector<SeenShift> seen;
    if (!in.transform || in.a.rotaries.size() == 0) return seen;
    SpilledWindow<RotaryRow> rows(in.a.rotaries);
    SegmentWindow path(in.a.path.segments());
    for (const PathCluster& c : clusters) {
        if (c.kind != DifferenceKind::moved || c.first.a.first >= path.size()) continue;
        const AxisPositions at = rotary_at(rows, c.first.a.first);
        const Matrix3 turned = in.transform->pose_MW(at).rotation.transpose() - Matrix3::Identity();
        seen.push_back(
            {c.first.shift_mm, Vector3(path[c.first.a.first].end_orientation.data()), turned});
    }
    return seen;
}

/// Rounds to 0.0001 mm, never "-0".
double rounded(double value_mm) {
    return std::round(value_mm * 1e4) / 1e4 + 0.0;
}

bool several_directions(const std::vector<SeenShift>& seen) {
    return std::any_of(seen.begin(), seen.end(), [&](const SeenShift& s) {
        return (s.direction - seen.front().direction).norm() > 1e-3;
    });
}

/// Least squares with minimum norm: unobservable components stay zero.
Vector3 fitted_pivot(const std::vector<SeenShift>& seen) {
    Matrix3 normal = Matrix3::Zero();
    Vector3 right = Vector3::Zero();
    for (const SeenShift& s : seen) {
        normal += s.turned.transpose() * s.turned;
        right += s.turned.transpose() * s.shift_mm;
    }
    Eigen::SelfAdjointEigenSolver<Matrix3> solver;
    solver.computeDirect(normal);
    Vector3 p = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
        if (solver.eigenvalues()[k] > 1e-4 * solver.eigenvalues()[2])
            p += solver.eigenvectors().col(k).dot(right) / solver.eigenvalues()[k] *
                 solver.eigenvectors().col(k);
    return p;
}

}  // namespace

std::optional<MovedPivot> moved_pivot(const std::vector<PathCluster>& clusters,
                                      const MovedPivotInput& in) {
    const std::vector<SeenShift> seen = shifts_of(clusters, in);
    if (seen.size() < 2 || !several_directions(seen)) return std::nullopt;
    const double allowed_mm = 2.0 * in.tolerances.position_mm;
    const auto all = [&](const auto& rest_mm) {
        return std::all_of(seen.begin(), seen.end(),
                           [&](const SeenShift& s) { return rest_mm(s) <= allowed_mm; });
    };
    double length_mm = 0.0;
    for (const SeenShift& s : seen)
        length_mm += s.shift_mm.dot(s.direction) / static_cast<double>(seen.size());
    if (all([&](const SeenShift& s) { return (s.shift_mm - length_mm * s.direction).norm(); }))
        return MovedPivot{fmt::format("the length along the tool differs by {:.4f} mm", length_mm),
                          Vector3::Zero(), length_mm};
    const Vector3 p = fitted_pivot(seen);
    if (all([&](const SeenShift& s) { return (s.shift_mm - s.turned * p).norm(); }))
        return MovedPivot{
            fmt::format("all {} shifts are one pivot moved by ({:.4f}, {:.4f}, {:.4f}) mm",
                        seen.size(), rounded(p.x()), rounded(p.y()), rounded(p.z())),
            p, 0.0};
    return std::nullopt;
}

bool explains(const MovedPivot& moved, const PathCluster& cluster, const MovedPivotInput& in) {
    constexpr std::uint64_t longest = 200;
    const Stretch a = cluster.first.a, b = cluster.first.b;
    if (cluster.count > 1 || std::max(a.last - a.first, b.last - b.first) > longest) return false;
    SpilledWindow<RotaryRow> rows(in.a.rotaries);
    SegmentWindow path_a(in.a.path.segments()), path_b(in.b.path.segments());
    const double allowed_mm = 2.0 * in.tolerances.position_mm;
    const auto in_b = [&](const Vector3& place) {
        for (std::uint64_t j = std::max<std::uint64_t>(b.first, 1) - 1;
             j <= std::min(b.last, path_b.size() - 1); ++j)
            if ((path_b[j].end().position_mm - place).norm() <= allowed_mm) return true;
        return false;
    };
    std::size_t shifted = 0;
    for (std::uint64_t i = a.first; i < a.last; ++i) {
        const Vector3 corner = path_a[i].end().position_mm;
        const Matrix3 turned =
            in.transform->pose_MW(rotary_at(rows, i)).rotation.transpose() - Matrix3::Identity();
        const Vector3 direction(path_a[i].end_orientation.data());
        if (in_b(corner + turned * moved.pivot_mm + moved.length_mm * direction))
            ++shifted;
        else if (!in_b(corner))
            return false;
    }
    return shifted > 0;
}

}  // namespace trunnion::regression
