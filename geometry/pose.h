// Rigid transforms and small motions.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/axes.h"

namespace trunnion::inline geometry {

using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// Positions of X, Y and Z, mm.
inline Vector3 xyz_of(const AxisPositions& q) {
    return {q[Axis::X], q[Axis::Y], q[Axis::Z]};
}

/// Cross-product matrix: skew(a) * b == a.cross(b).
inline Matrix3 skew(const Vector3& a) {
    Matrix3 m;
    m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return m;
}

/// Right-handed rotation by `angle_rad` about the unit vector `axis` (Rodrigues).
inline Matrix3 rotation_about(const Vector3& axis, double angle_rad) {
    return Eigen::AngleAxisd(angle_rad, axis).toRotationMatrix();
}

/// exp([tilt]x): the exact rotation of a rotation vector (rad), orthogonal for any size. Below 0.01
/// rad a series is used whose first neglected term is below the rounding of a double.
inline Matrix3 rotation_of(const Vector3& tilt_rad) {
    const double square = tilt_rad.squaredNorm();
    if (square > 1e-4) {
        const double angle = std::sqrt(square);
        return rotation_about(tilt_rad / angle, angle);
    }
    const double s = 1.0 - square / 6.0 * (1.0 - square / 20.0);   // sin(a) / a
    const double k = 0.5 - square / 24.0 * (1.0 - square / 30.0);  // (1 - cos(a)) / a^2
    const Matrix3 x = skew(tilt_rad);
    return Matrix3::Identity() + s * x +
           k * (tilt_rad * tilt_rad.transpose() - square * Matrix3::Identity());
}

/// How a rotation vector turns further when its components grow (left Jacobian of SO(3)):
/// exp([tilt + d]x) = exp([turn_by(tilt) d]x) exp([tilt]x) to first order in d.
inline Matrix3 turn_by(const Vector3& tilt_rad) {
    const double square = tilt_rad.squaredNorm(), angle = std::sqrt(square);
    const bool small = square < 1e-4;
    const double k = small ? 0.5 - square / 24.0 : (1.0 - std::cos(angle)) / square;
    const double m =
        small ? 1.0 / 6.0 - square / 120.0 : (angle - std::sin(angle)) / (square * angle);
    const Matrix3 x = skew(tilt_rad);
    return Matrix3::Identity() + k * x + m * x * x;
}

/// A rigid transform. `pose_AB` is frame B seen from frame A: p_AQ = pose_AB * p_BQ, and pose_AC =
/// pose_AB * pose_BC.
struct Pose {
    Matrix3 rotation = Matrix3::Identity();
    Vector3 translation_mm = Vector3::Zero();

    Vector3 operator*(const Vector3& p) const { return rotation * p + translation_mm; }
    Pose operator*(const Pose& other) const {
        return {rotation * other.rotation, rotation * other.translation_mm + translation_mm};
    }
    Pose inverse() const {
        return {rotation.transpose(), -(rotation.transpose() * translation_mm)};
    }

    static Pose shift(const Vector3& shift_mm) { return {Matrix3::Identity(), shift_mm}; }
    /// Rotation about the line through `point_mm` along the unit vector `axis`.
    static Pose turn(const Vector3& axis, const Vector3& point_mm, double angle_rad) {
        const Matrix3 r = rotation_about(axis, angle_rad);
        return {r, point_mm - r * point_mm};
    }
};

/// Small shift and rotation in a named frame: error = actual - nominal, along and about the + axes
/// of that frame (ISO 230-1).
struct SmallMotion {
    Vector3 shift_mm = Vector3::Zero();
    Vector3 tilt_rad = Vector3::Zero();

    SmallMotion& operator+=(const SmallMotion& other) {
        shift_mm += other.shift_mm;
        tilt_rad += other.tilt_rad;
        return *this;
    }
    bool is_zero() const { return shift_mm.isZero(0.0) && tilt_rad.isZero(0.0); }
};

}  // namespace trunnion::inline geometry
