// Least-squares circles, spheres and planes.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>

#include "geometry/pose.h"

namespace trunnion::inline geometry {

using Vector2 = Eigen::Vector2d;

/// Algebraic circle fits differ in the constraint that keeps the trivial solution out, and so in
/// their bias on short arcs: kasa is pulled towards a small circle, pratt and taubin much less,
/// hyper (Al-Sharadqah and Chernov 2009) has no bias of second order. geometric minimises the true
/// distances (Gauss-Newton from the hyper fit).
enum class CircleMethod : unsigned char { kasa, pratt, taubin, hyper, geometric };

struct CircleFit {
    Vector2 center_mm = Vector2::Zero();
    double radius_mm = 0.0;
    double rms_mm = 0.0;  ///< of the distances to the circle
};

/// Nothing for fewer than three points or points on a line. Coincident points: radius 0.
std::optional<CircleFit> fit_circle(std::span<const Vector2> points,
                                    CircleMethod method = CircleMethod::hyper);

struct SphereFit {
    Vector3 center_mm = Vector3::Zero();
    double radius_mm = 0.0;
    double rms_mm = 0.0;                     ///< of the distances to the sphere
    Matrix3 cofactor = Matrix3::Identity();  ///< covariance of the centre for points of unit
                                             ///< variance along their radius
};

/// Linear least squares of |p|^2 = 2 p.c + (R^2 - |c|^2). Nothing for fewer than four points or
/// points in a plane.
std::optional<SphereFit> fit_sphere_linear(std::span<const Vector3> points);
/// True distances, radius free (Gauss-Newton from the linear fit).
std::optional<SphereFit> fit_sphere(std::span<const Vector3> points);
/// True distances, radius known: three unknowns, so a cap of nine touches gives a better height.
std::optional<SphereFit> fit_sphere(std::span<const Vector3> points, double known_radius_mm);

struct PlaneFit {
    Vector3 centroid_mm = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();  ///< unit; its largest component is positive
    double rms_mm = 0.0;
};

/// Orthogonal distances: the normal is the right singular vector of the smallest singular value of
/// the centred points. Nothing for fewer than three points or points on a line.
std::optional<PlaneFit> fit_plane(std::span<const Vector3> points);

/// A circle in space: plane, then the circle of the points projected into it.
struct CircleFit3 {
    Vector3 center_mm = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();
    double radius_mm = 0.0;
    double rms_mm = 0.0;  ///< of the distances in the plane
};
std::optional<CircleFit3> fit_circle_3d(std::span<const Vector3> points,
                                        CircleMethod method = CircleMethod::hyper);

}  // namespace trunnion::inline geometry
