// Least-squares circles, spheres and planes.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "geometry/pose.h"

namespace trunnion::inline geometry {

using Vector2 = Eigen::Vector2d;

/// Algebraic circle fits differ in the constraint that excludes the trivial solution, and therefore
/// in their bias on short arcs. kasa is biased towards small radii, pratt and taubin much less;
/// hyper (Al-Sharadqah and Chernov 2009) has no second-order bias. geometric minimises the
/// orthogonal distances (Gauss-Newton from the hyper fit).
enum class CircleMethod : unsigned char { kasa, pratt, taubin, hyper, geometric };

struct CircleFit {
    Vector2 center_mm = Vector2::Zero();
    double radius_mm = 0.0;
    double rms_mm = 0.0;  ///< rms distance to the circle
};

/// Empty for fewer than three points or collinear points. Radius 0 for coincident points.
std::optional<CircleFit> fit_circle(std::span<const Vector2> points,
                                    CircleMethod method = CircleMethod::hyper);

struct SphereFit {
    Vector3 center_mm = Vector3::Zero();
    double radius_mm = 0.0;
    double rms_mm = 0.0;                     ///< rms distance to the sphere
    Matrix3 cofactor = Matrix3::Identity();  ///< covariance of the centre for unit variance of each
                                             ///< point along its radius
};

/// Linear least squares of |p|^2 = 2 p.c + (R^2 - |c|^2). Empty for fewer than four points or
/// coplanar points.
std::optional<SphereFit> fit_sphere_linear(std::span<const Vector3> points);
/// Least squares of the distances to the sphere, radius free (Gauss-Newton from the linear fit).
std::optional<SphereFit> fit_sphere(std::span<const Vector3> points);
/// The same with a known radius. With three unknowns instead of four, nine touches on a cap
/// determine the height better.
std::optional<SphereFit> fit_sphere(std::span<const Vector3> points, double known_radius_mm);

struct PlaneFit {
    Vector3 centroid_mm = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();  ///< unit vector whose largest component is positive
    double rms_mm = 0.0;
};

/// Orthogonal least squares: the normal is the right singular vector of the smallest singular value
/// of the centred points. Empty for fewer than three points or collinear points.
std::optional<PlaneFit> fit_plane(std::span<const Vector3> points);

/// A circle in space: a plane fit, then a circle fit of the points projected into the plane.
struct CircleFit3 {
    Vector3 center_mm = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();
    double radius_mm = 0.0;
    double rms_mm = 0.0;  ///< rms distance to the circle, within the plane
};
std::optional<CircleFit3> fit_circle_3d(std::span<const Vector3> points,
                                        CircleMethod method = CircleMethod::hyper);

}  // namespace trunnion::inline geometry
