#include "positioning/rotation_pair.h"

#include <cmath>

#include "base/units.h"

namespace trunnion::positioning {

namespace {

constexpr double on_line = 1e-11;     ///< a direction with a smaller sine to an axis line counts as
                                      ///< on the line
constexpr double reach_slack = 1e-9;  ///< tolerance for directions at the limit of reach

/// Angle in (-pi, pi] about `axis` from `from` to `to`; empty when `from` lies on the axis line.
std::optional<double> angle_about(const Vector3& axis, const Vector3& from, const Vector3& to) {
    const Vector3 lever = axis.cross(from);
    if (lever.norm() < on_line) return std::nullopt;
    const double angle_rad = std::atan2(lever.dot(to), lever.dot(axis.cross(to)));
    return angle_rad <= -pi ? pi : angle_rad;
}

struct Cone {
    Vector3 axis, start;
    double height = 1.0, radius = 0.0;
    Cone(const Vector3& axis, const Vector3& start)
        : axis(axis), start(start), height(axis.dot(start)), radius(axis.cross(start).norm()) {}
};

struct CommonVectors {
    int count = 0;
    Vector3 at[2];
};

/// Unit vectors that lie on both cones. They are computed on `base`, the narrower cone: near its
/// axis the height on the other cone would lose half of its digits.
CommonVectors common_vectors(const Cone& base, const Cone& other) {
    CommonVectors common;
    const Vector3 cross = base.axis.cross(other.axis);
    const double sine = cross.norm();
    if (sine < on_line) return common;
    const double excess = other.height - base.axis.dot(other.axis) * base.height;
    if (base.radius < on_line) {
        if (std::abs(excess) > reach_slack) return common;
        common.at[common.count++] = base.start;
        return common;
    }
    double cosine = excess / (sine * base.radius);
    if (std::abs(cosine) > 1.0 + reach_slack / base.radius) return common;
    cosine = std::fmin(1.0, std::fmax(-1.0, cosine));
    const double height = std::sqrt((1.0 - cosine) * (1.0 + cosine));
    const Vector3 normal = cross / sine;
    const Vector3 inside = base.height * base.axis + base.radius * cosine * normal.cross(base.axis);
    common.at[common.count++] = inside + base.radius * height * normal;
    if (height > on_line) common.at[common.count++] = inside - base.radius * height * normal;
    return common;
}

}  // namespace

PairSolutions solve_rotation_pair(const Vector3& a, const Vector3& x, const Vector3& b,
                                  const Vector3& y) {
    const Cone cone_a(a, x), cone_b(b, y);
    const CommonVectors common = cone_a.radius < cone_b.radius ? common_vectors(cone_a, cone_b)
                                                               : common_vectors(cone_b, cone_a);
    PairSolutions solutions;
    for (int i = 0; i < common.count; ++i) {
        const Vector3& z = common.at[i];
        solutions.at[solutions.count++] = {angle_about(a, x, z), angle_about(b, y, z)};
    }
    return solutions;
}

}  // namespace trunnion::positioning
