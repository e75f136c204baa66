#include "geometry/fits.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace trunnion::inline geometry {
namespace {

constexpr double singular = 1e-12;  // relative threshold: smaller singular values mean collinear or
                                    // coplanar points

/// Shifts and scales the points to coordinates of the order of 1, for the conditioning of every
/// fit.
template <class Vector>
struct Normalised {
    Vector mean;
    double scale = 0.0;  ///< rms distance from the mean; 0 for coincident points
    std::vector<Vector> points;

    explicit Normalised(std::span<const Vector> raw) : mean(Vector::Zero()) {
        const double count = static_cast<double>(raw.size());
        for (const Vector& p : raw) mean += p / count;
        double square = 0.0;
        for (const Vector& p : raw) square += (p - mean).squaredNorm() / count;
        // Within the rounding of their coordinates the points coincide: no shape can be fitted.
        if (std::sqrt(square) > 1e-15 * mean.norm()) scale = std::sqrt(square);
        for (const Vector& p : raw)
            points.push_back(scale > 0.0 ? Vector((p - mean) / scale) : Vector(Vector::Zero()));
    }
};

template <class Vector>
double rms_distance(std::span<const Vector> points, const Vector& center, double radius) {
    double sum = 0.0;
    for (const Vector& p : points) sum += std::pow((p - center).norm() - radius, 2);
    return std::sqrt(sum / static_cast<double>(points.size()));
}

/// Central moments of the normalised points; z = x^2 + y^2.
struct Moments {
    double xx = 0, yy = 0, xy = 0, xz = 0, yz = 0, zz = 0;

    explicit Moments(const std::vector<Vector2>& points) {
        const double weight = 1.0 / static_cast<double>(points.size());
        for (const Vector2& p : points) {
            const double z = p.squaredNorm();
            xx += weight * p.x() * p.x();
            yy += weight * p.y() * p.y();
            xy += weight * p.x() * p.y();
            xz += weight * p.x() * z;
            yz += weight * p.y() * z;
            zz += weight * z * z;
        }
    }
    double z() const { return xx + yy; }
    double cov_xy() const { return xx * yy - xy * xy; }
};

/// Coefficients, in rising powers of eta, of the characteristic polynomial of M a = eta N a for
/// each constraint N (Chernov). Kasa's fit has eta = 0, so its polynomial is eta itself.
std::array<double, 5> characteristic(const Moments& m, CircleMethod method) {
    const double z = m.z(), cov = m.cov_xy(), var_z = m.zz - z * z;
    const double a1 = var_z * z + 4.0 * cov * z - m.xz * m.xz - m.yz * m.yz;
    const double a0 =
        m.xz * (m.xz * m.yy - m.yz * m.xy) + m.yz * (m.yz * m.xx - m.xz * m.xy) - var_z * cov;
    switch (method) {
        case CircleMethod::kasa: return {0, 1, 0, 0, 0};
        case CircleMethod::taubin: return {a0, a1, -3.0 * z * z - m.zz, 4.0 * z, 0};
        default: return {a0, a1, 4.0 * cov - 3.0 * z * z - m.zz, 0, 4};
    }
}

/// Smallest non-negative root. Newton's method from 0 approaches it monotonically from below and
/// stops at rounding.
double smallest_root(const std::array<double, 5>& a) {
    const auto value = [&](double e) {
        return a[0] + e * (a[1] + e * (a[2] + e * (a[3] + e * a[4])));
    };
    double eta = 0.0, y = value(0.0);
    for (int i = 0; i < 99; ++i) {
        const double slope = a[1] + eta * (2 * a[2] + eta * (3 * a[3] + eta * 4 * a[4]));
        const double next = eta - y / slope;
        if (next == eta || !std::isfinite(next)) break;
        const double y_next = value(next);
        if (std::abs(y_next) >= std::abs(y)) break;
        eta = next;
        y = y_next;
    }
    return eta;
}

/// Factor of eta in R^2 = |c|^2 + z + factor * eta.
double radius_factor(CircleMethod method) {
    switch (method) {
        case CircleMethod::pratt: return 2.0;
        case CircleMethod::hyper: return -2.0;
        default: return 0.0;
    }
}

std::optional<CircleFit> fit_algebraic(const std::vector<Vector2>& points, CircleMethod method) {
    const Moments m(points);
    if (m.cov_xy() < singular * singular) return std::nullopt;
    const double eta = smallest_root(characteristic(m, method));
    const double twice_det = 2.0 * (eta * eta - eta * m.z() + m.cov_xy());
    CircleFit fit;
    fit.center_mm =
        Vector2(m.xz * (m.yy - eta) - m.yz * m.xy, m.yz * (m.xx - eta) - m.xz * m.xy) / twice_det;
    fit.radius_mm =
        std::sqrt(std::max(0.0, fit.center_mm.squaredNorm() + m.z() + radius_factor(method) * eta));
    if (!fit.center_mm.allFinite() || fit.center_mm.norm() > 1.0 / singular) return std::nullopt;
    return fit;
}

/// Gauss-Newton on |p - c| - R. Unknowns: the centre and, unless it is given, the radius. Returns
/// the inverse of the normal matrix.
template <int dim, class Vector>
Eigen::Matrix<double, dim + 1, dim + 1> refine(std::span<const Vector> points, Vector& center,
                                               double& radius, bool radius_known) {
    using Normal = Eigen::Matrix<double, dim + 1, dim + 1>;
    using Unknowns = Eigen::Matrix<double, dim + 1, 1>;
    Normal normal = Normal::Identity();
    for (int i = 0; i < 50; ++i) {
        normal.setZero();
        Unknowns right = Unknowns::Zero();
        for (const Vector& p : points) {
            const Vector arm = p - center;
            const double length = arm.norm();
            if (length == 0.0) continue;
            Unknowns row;
            row << arm / length, radius_known ? 0.0 : 1.0;
            normal += row * row.transpose();
            right += row * (length - radius);
        }
        if (radius_known) normal(dim, dim) = 1.0;
        const Unknowns step = normal.ldlt().solve(right);
        if (!step.allFinite()) break;
        center += step.template head<dim>();
        if (!radius_known) radius += step(dim);
        if (step.norm() <= 1e-15 * (1.0 + radius)) break;
    }
    return normal.ldlt().solve(Normal::Identity());
}

/// Centre and radius in normalised units by linear least squares; empty for coplanar points.
std::optional<SphereFit> linear_sphere(const std::vector<Vector3>& points) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    for (const Vector3& p : points) {
        const Eigen::Vector4d row(2 * p.x(), 2 * p.y(), 2 * p.z(), 1.0);
        normal += row * row.transpose();
        right += row * p.squaredNorm();
    }
    const Eigen::LDLT<Eigen::Matrix4d> solver(normal);
    if (solver.vectorD().minCoeff() < 1e-13 * normal.trace()) return std::nullopt;
    const Eigen::Vector4d x = solver.solve(right);
    SphereFit fit;
    fit.center_mm = x.head<3>();
    fit.radius_mm = std::sqrt(std::max(0.0, x(3) + fit.center_mm.squaredNorm()));
    return fit;
}

std::optional<SphereFit> sphere(std::span<const Vector3> raw, bool iterate, bool known,
                                double known_radius_mm) {
    if (raw.size() < 4) return std::nullopt;
    const Normalised<Vector3> data(raw);
    if (data.scale == 0.0) return std::nullopt;
    std::optional<SphereFit> fit = linear_sphere(data.points);
    if (!fit) return std::nullopt;
    if (known) fit->radius_mm = known_radius_mm / data.scale;
    Vector3 center = fit->center_mm;
    double radius = fit->radius_mm;
    fit->cofactor = refine<3, Vector3>(data.points, center, radius, known).topLeftCorner<3, 3>();
    if (iterate) fit->center_mm = center, fit->radius_mm = radius;
    fit->center_mm = data.mean + data.scale * fit->center_mm;
    fit->radius_mm *= data.scale;
    fit->rms_mm = rms_distance(raw, fit->center_mm, fit->radius_mm);
    return fit;
}

}  // namespace

std::optional<CircleFit> fit_circle(std::span<const Vector2> points, CircleMethod method) {
    if (points.size() < 3) return std::nullopt;
    const Normalised<Vector2> data(points);
    if (data.scale == 0.0) return CircleFit{data.mean, 0.0, 0.0};
    const bool geometric = method == CircleMethod::geometric;
    std::optional<CircleFit> fit =
        fit_algebraic(data.points, geometric ? CircleMethod::hyper : method);
    if (!fit) return std::nullopt;
    if (geometric) refine<2, Vector2>(data.points, fit->center_mm, fit->radius_mm, false);
    fit->center_mm = data.mean + data.scale * fit->center_mm;
    fit->radius_mm *= data.scale;
    fit->rms_mm = rms_distance(points, fit->center_mm, fit->radius_mm);
    return fit;
}

std::optional<SphereFit> fit_sphere_linear(std::span<const Vector3> points) {
    return sphere(points, false, false, 0.0);
}

std::optional<SphereFit> fit_sphere(std::span<const Vector3> points) {
    return sphere(points, true, false, 0.0);
}

std::optional<SphereFit> fit_sphere(std::span<const Vector3> points, double known_radius_mm) {
    return sphere(points, true, true, known_radius_mm);
}

std::optional<PlaneFit> fit_plane(std::span<const Vector3> points) {
    if (points.size() < 3) return std::nullopt;
    const Normalised<Vector3> data(points);
    if (data.scale == 0.0) return std::nullopt;
    Matrix3 scatter = Matrix3::Zero();
    for (const Vector3& p : data.points) scatter += p * p.transpose();
    const Eigen::SelfAdjointEigenSolver<Matrix3> eigen(scatter);
    if (eigen.eigenvalues()(1) < singular * eigen.eigenvalues()(2)) return std::nullopt;
    PlaneFit fit{data.mean, eigen.eigenvectors().col(0), 0.0};
    Eigen::Index largest = 0;
    fit.normal.cwiseAbs().maxCoeff(&largest);
    if (fit.normal(largest) < 0.0) fit.normal = -fit.normal;
    double sum = 0.0;
    for (const Vector3& p : points) sum += std::pow(fit.normal.dot(p - data.mean), 2);
    fit.rms_mm = std::sqrt(sum / static_cast<double>(points.size()));
    return fit;
}

std::optional<CircleFit3> fit_circle_3d(std::span<const Vector3> points, CircleMethod method) {
    const std::optional<PlaneFit> plane = fit_plane(points);
    if (!plane) return std::nullopt;
    const Vector3 u = plane->normal.unitOrthogonal(), v = plane->normal.cross(u);
    std::vector<Vector2> flat;
    for (const Vector3& p : points) {
        const Vector3 arm = p - plane->centroid_mm;
        flat.emplace_back(u.dot(arm), v.dot(arm));
    }
    const std::optional<CircleFit> fit = fit_circle(flat, method);
    if (!fit) return std::nullopt;
    const Vector3 center = plane->centroid_mm + fit->center_mm.x() * u + fit->center_mm.y() * v;
    return CircleFit3{center, plane->normal, fit->radius_mm, fit->rms_mm};
}

}  // namespace trunnion::inline geometry
