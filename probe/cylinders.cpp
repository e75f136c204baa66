#include "probe/cylinders.h"

#include <Eigen/LU>
#include <array>
#include <cmath>

#include "probe/closing_gap.h"

namespace trunnion::probe {

namespace {

constexpr double parallel = 1e-12;  ///< sine of an angle that moves nothing
constexpr double margin_mm = 0.05;  ///< volumes smaller by it give a normal where they meet
constexpr double coarse_mm = 1e-4;  ///< error of the way between those
constexpr double near_mm = 0.02;    ///< from here on the best normal is searched
constexpr double widest = 10.0, narrow = 1e-13;  ///< of that search: tangents of angles
constexpr int most_steps = 100;

/// The point farthest along `d`.
Vector3 farthest(const Cylinder& c, const Vector3& d) {
    const double along = d.dot(c.axis);
    const Vector3 across = d - along * c.axis;
    const double width = across.norm();
    Vector3 p = c.end_mm;
    if (along > 0.0) p += c.length_mm * c.axis;
    if (width > 0.0) p += c.radius_mm / width * across;
    return p;
}

/// Up to four points of the difference of two volumes, and the point of their hull nearest to zero.
class Hull {
  public:
    /// False when the point brings nothing new.
    bool add(const Vector3& p) {
        for (std::size_t k = 0; k < count_; ++k)
            if (point_[k] == p) return false;
        point_[count_++] = p;
        const double before = nearest_.norm();
        reduce();
        return count_ == 1 || nearest_.norm() < before;
    }
    const Vector3& nearest() const { return nearest_; }
    bool holds_zero() const { return count_ == 4; }

  private:
    /// Weights of some points whose combination is nearest to zero; false when one is not positive.
    bool combine(unsigned members, std::array<double, 4>& weight, Vector3& at) const;
    /// Keeps the points whose hull has the nearest point.
    void reduce();

    std::array<Vector3, 4> point_;
    std::size_t count_ = 0;
    Vector3 nearest_ = Vector3::Zero();
};

bool Hull::combine(unsigned members, std::array<double, 4>& weight, Vector3& at) const {
    std::array<std::size_t, 4> index{};
    int n = 0;
    for (std::size_t k = 0; k < count_; ++k)
        if ((members >> k) & 1U) index[static_cast<std::size_t>(n++)] = k;
    const Vector3& base = point_[index[0]];
    Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edge(3, n - 1);
    for (int k = 1; k < n; ++k) edge.col(k - 1) = point_[index[static_cast<std::size_t>(k)]] - base;
    weight.fill(0.0);
    at = base;
    double rest = 1.0;
    if (n > 1) {
        const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram =
            edge.transpose() * edge;
        const Eigen::FullPivLU<Eigen::MatrixXd> lu(gram);
        if (!lu.isInvertible()) return false;
        const Eigen::VectorXd t = lu.solve(Eigen::VectorXd(-edge.transpose() * base));
        for (int k = 1; k < n; ++k) {
            if (!(t(k - 1) > 0.0)) return false;
            weight[index[static_cast<std::size_t>(k)]] = t(k - 1);
            rest -= t(k - 1);
        }
        at += edge * t;
    }
    weight[index[0]] = rest;
    return rest > 0.0;
}

void Hull::reduce() {
    double least = -1.0;
    unsigned best = 0;
    for (unsigned members = 1; members < (1U << count_); ++members) {
        std::array<double, 4> weight{};
        Vector3 at;
        if (!combine(members, weight, at)) continue;
        if (least >= 0.0 && at.norm() >= least) continue;
        least = at.norm(), best = members, nearest_ = at;
    }
    std::size_t kept = 0;
    for (std::size_t k = 0; k < count_; ++k)
        if ((best >> k) & 1U) point_[kept++] = point_[k];
    count_ = kept;
}

/// Parallel axes: a cylinder larger by the other one meets a point.
double parallel_distance_mm(const Cylinder& a, const Cylinder& b) {
    const Vector3 apart = b.end_mm - a.end_mm;
    const double from = apart.dot(a.axis), to = from + b.length_mm * b.axis.dot(a.axis);
    const double across = (apart - from * a.axis).norm() - a.radius_mm - b.radius_mm;
    const double along = std::max(std::min(from, to) - a.length_mm, -std::max(from, to));
    if (across > 0.0 && along > 0.0) return std::hypot(across, along);
    return std::max(across, along);
}

/// Width of the gap between the planes across `n` (any length) that touch both volumes: a concave
/// function, positive for some n when the volumes are apart.
double between_planes(const Cylinder& a, const Cylinder& b, const Vector3& n) {
    return (farthest(b, -n) - farthest(a, n)).dot(n);
}

/// The largest value of a function with one top, by golden sections.
template <class Function>
double largest(const Function& f, double low, double high) {
    constexpr double golden = 0.6180339887498949;
    double x1 = high - golden * (high - low), x2 = low + golden * (high - low);
    double f1 = f(x1), f2 = f(x2);
    while (high - low > narrow) {
        if (f1 > f2) {
            high = x2, x2 = x1, f2 = f1;
            f1 = f(x1 = high - golden * (high - low));
        } else {
            low = x1, x1 = x2, f1 = f2;
            f2 = f(x2 = low + golden * (high - low));
        }
    }
    return std::max(f1, f2);
}

/// The gap along the best normal near `n`: zero exactly at contact, never above the distance.
double fine_gap_mm(const Cylinder& a, const Cylinder& b, const Vector3& n) {
    const Vector3 e1 = n.unitOrthogonal(), e2 = n.cross(e1);
    return largest(
        [&](double x) {
            const Vector3 start = n + x * e1;
            return largest(
                [&](double y) {
                    const Vector3 normal = start + y * e2;
                    const double gap = between_planes(a, b, normal);
                    return gap > 0.0 ? gap / normal.norm() : gap;  // quasi-concave
                },
                -widest, widest);
        },
        -widest, widest);
}

/// Smaller by a margin on all sides.
Cylinder inset(const Cylinder& c) {
    const double by_mm = std::min({margin_mm, 0.5 * c.radius_mm, 0.25 * c.length_mm});
    return {c.end_mm + by_mm * c.axis, c.axis, c.length_mm - 2.0 * by_mm, c.radius_mm - by_mm};
}

/// Gilbert, Johnson and Keerthi: the hull of ever farther points of the difference of both volumes
/// approaches its point nearest to zero; from b to a, zero when they meet.
Vector3 coarse_way(const Cylinder& a, const Cylinder& b) {
    Hull hull;
    Vector3 v = a.end_mm - b.end_mm;
    for (int step = 0; step < most_steps; ++step) {
        const Vector3 p = farthest(a, -v) - farthest(b, v);
        const double distance = v.norm();
        if (step > 0 && distance - v.dot(p) / distance < coarse_mm) break;
        if (!hull.add(p) || hull.holds_zero()) break;
        v = hull.nearest();
    }
    return hull.holds_zero() ? Vector3(Vector3::Zero()) : v;
}

}  // namespace

double clearance_mm(const Cylinder& a, const Cylinder& b) {
    if (a.axis.cross(b.axis).norm() < parallel) return parallel_distance_mm(a, b);
    const Vector3 way = coarse_way(inset(a), inset(b));
    const double far = way.norm();
    if (far == 0.0) return -margin_mm;
    const Vector3 normal = -way / far;
    const double gap = between_planes(a, b, normal);
    return gap > near_mm ? gap : fine_gap_mm(a, b, normal);
}

std::optional<double> first_contact(const Cylinder& still, const CylinderPath& moving) {
    using Points = Eigen::Matrix<double, 6, 1>;
    const double radius_mm = moving(0.0).radius_mm, length_mm = moving(0.0).length_mm;
    // No point of the cylinder moves more than these two together.
    const double reach_mm = length_mm + radius_mm;
    const auto points = [&](double s) {
        const Cylinder c = moving(s);
        Points p;
        p << c.end_mm, c.end_mm + reach_mm * c.axis;
        return p;
    };
    const auto gap_mm = [&](const Points& p) {
        const Vector3 end = p.head<3>(), far = p.tail<3>();
        return probe::clearance_mm(still, {end, (far - end).normalized(), length_mm, radius_mm});
    };
    return first_closing(points, gap_mm);
}

}  // namespace trunnion::probe
