#include "kinematics/forward.h"

#include <algorithm>
#include <cmath>

namespace trunnion::kinematics {
namespace {

Vector3 first_three(const std::array<double, 6>& v) {
    return {v[0], v[1], v[2]};
}
Vector3 last_three(const std::array<double, 6>& v) {
    return {v[3], v[4], v[5]};
}

/// Rodrigues' formula with one sine and one cosine; `u` is a unit vector.
Matrix3 turn(const Vector3& u, double angle_rad) {
    const double c = std::cos(angle_rad), s = std::sin(angle_rad), k = 1.0 - c;
    const double kx = k * u.x(), ky = k * u.y(), kz = k * u.z();
    Matrix3 r;
    r << c + kx * u.x(), kx * u.y() - s * u.z(), kx * u.z() + s * u.y(),  //
        ky * u.x() + s * u.z(), c + ky * u.y(), ky * u.z() - s * u.x(),   //
        kz * u.x() - s * u.y(), kz * u.y() + s * u.x(), c + kz * u.z();
    return r;
}

SmallMotion motion_of(const Link& link, const LinkPosition& at, const SmallMotion* extra) {
    std::array<double, 6> value{};
    for (std::size_t k = 0; k < 6; ++k)
        if (link.motions >> k & 1) value[k] = (*link.curves)[k](at.actual, at.commanded);
    SmallMotion motion{first_three(value), last_three(value)};
    if (extra) motion += *extra;
    return motion;
}

Pose pose_of(const SmallMotion& motion) {
    return {rotation_of(motion.tilt_rad), motion.shift_mm};
}

bool is_zero(const AxisErrors& spindle) {
    return spindle_location(spindle).is_zero() &&
           std::all_of(spindle.motion.begin(), spindle.motion.end(),
                       [](const ErrorCurve& curve) { return curve.is_zero(); });
}

void add_spindle(const AxisErrors& spindle, SpindleAngle spindle_rad, MachinePose& poses) {
    poses.pose_MS = poses.pose_MS * (pose_of(spindle_location(spindle)) *
                                     pose_of(spindle_motion(spindle, spindle_rad)));
}

const SmallMotion* extra_of(const Perturbation* extra, Axis axis) {
    if (!extra) return nullptr;
    const SmallMotion& motion = extra->motion[index_of(axis)];
    return motion.is_zero() ? nullptr : &motion;
}

LinkPosition position_of(const AxisPositions& commanded, const Perturbation* extra, Axis axis) {
    const double at = commanded[axis];
    return {at, extra ? at + extra->axis[axis] : at};
}

Pose walk(const std::vector<Link>& links, const AxisPositions& q, const Perturbation* extra) {
    Pose pose;
    for (const Link& link : links)
        carry(link, position_of(q, extra, link.axis), extra_of(extra, link.axis), pose);
    return pose;
}

Pose walk(const std::vector<AxisGeometry>& side, const GeometricErrors& errors,
          const AxisPositions& q, const Perturbation* extra) {
    Pose pose;
    for (const AxisGeometry& geometry : side) {
        const Link link = make_link(geometry, errors.axis[index_of(geometry.axis)]);
        carry(link, position_of(q, extra, link.axis), extra_of(extra, link.axis), pose);
    }
    return pose;
}

MachinePose poses_of(const Machine& machine, const AxisPositions& q, const Perturbation* extra,
                     SpindleAngle spindle_rad) {
    MachinePose poses{walk(machine.chain.work, machine.errors, q, extra),
                      walk(machine.chain.tool, machine.errors, q, extra)};
    if (!is_zero(machine.errors.spindle)) add_spindle(machine.errors.spindle, spindle_rad, poses);
    return poses;
}

/// Moves the frame along the direction of travel. The error motion turns the carriage about the
/// origin of its own frame, which travels with it.
void carry_linear(const Link& link, double q, const SmallMotion* motion, Pose& pose) {
    Vector3 shift_mm = q * link.direction + link.carried_mm;
    if (motion) shift_mm += motion->shift_mm;
    pose.translation_mm += pose.rotation * shift_mm;
    if (motion && !motion->tilt_rad.isZero(0.0))
        pose.rotation = pose.rotation * rotation_of(motion->tilt_rad);
}

/// Turns the frame about the axis line. Errors act along and about the axes of the carrier, which
/// coincide with M at home.
void carry_rotary(const Link& link, double q, const SmallMotion* motion, Pose& pose) {
    Matrix3 r = turn(link.direction, q);
    Vector3 shift_mm = link.carried_mm;
    if (motion) {
        r = rotation_of(motion->tilt_rad) * r;
        shift_mm += link.tilt * motion->shift_mm;
    }
    if (link.tilted) r = link.tilt * r;
    pose.translation_mm += pose.rotation * (shift_mm - r * link.point_mm);
    pose.rotation = pose.rotation * r;
}

Vector3 tip_seen_from_W(const MachinePose& poses, const Vector3& tip_S_mm) {
    return poses.pose_MW.rotation.transpose() *
           (poses.pose_MS * tip_S_mm - poses.pose_MW.translation_mm);
}

}  // namespace

SmallMotion spindle_location(const AxisErrors& spindle) {
    return {first_three(spindle.location), last_three(spindle.location)};
}

SmallMotion spindle_motion(const AxisErrors& spindle, SpindleAngle spindle_rad) {
    std::array<double, 6> value{};
    for (std::size_t k = 0; k < 6; ++k)
        value[k] = spindle_rad ? spindle.motion[k](*spindle_rad) : spindle.motion[k].constant;
    return {first_three(value), last_three(value)};
}

Link make_link(const AxisGeometry& geometry, const AxisErrors& errors) {
    Link link;
    link.axis = geometry.axis;
    link.rotary = geometry.rotary;
    link.direction = geometry.direction;
    link.point_mm = geometry.point_mm;
    link.carried_mm = first_three(errors.location);
    if (link.rotary) link.carried_mm += geometry.point_mm;
    const Vector3 tilt_rad = last_three(errors.location);
    link.tilted = !tilt_rad.isZero(0.0);
    if (link.tilted) link.tilt = rotation_of(tilt_rad);
    if (link.tilted && !link.rotary) link.direction = link.tilt * geometry.direction;
    link.curves = &errors.motion;
    for (std::size_t k = 0; k < 6; ++k)
        if (!errors.motion[k].is_zero()) link.motions |= static_cast<std::uint8_t>(1u << k);
    return link;
}

void carry(const Link& link, const LinkPosition& at, const SmallMotion* extra, Pose& pose) {
    const auto over = link.rotary ? carry_rotary : carry_linear;
    if (link.motions == 0 && !extra) return over(link, at.actual, nullptr, pose);
    const SmallMotion motion = motion_of(link, at, extra);
    over(link, at.actual, &motion, pose);
}

ForwardModel::ForwardModel(const Machine& machine)
    : errors_(machine.errors), has_spindle_(!is_zero(errors_.spindle)) {
    for (const AxisGeometry& geometry : machine.chain.work)
        work_.push_back(make_link(geometry, errors_.axis[index_of(geometry.axis)]));
    for (const AxisGeometry& geometry : machine.chain.tool)
        tool_.push_back(make_link(geometry, errors_.axis[index_of(geometry.axis)]));
}

MachinePose ForwardModel::poses(const AxisPositions& commanded, SpindleAngle spindle_rad) const {
    MachinePose poses{walk(work_, commanded, nullptr), walk(tool_, commanded, nullptr)};
    if (has_spindle_) add_spindle(errors_.spindle, spindle_rad, poses);
    return poses;
}

MachinePose ForwardModel::poses(const AxisPositions& commanded, const Perturbation& extra,
                                SpindleAngle spindle_rad) const {
    MachinePose poses{walk(work_, commanded, &extra), walk(tool_, commanded, &extra)};
    if (has_spindle_) add_spindle(errors_.spindle, spindle_rad, poses);
    return poses;
}

Vector3 ForwardModel::tip_W(const AxisPositions& commanded, const Vector3& tip_S_mm,
                            SpindleAngle spindle_rad) const {
    return tip_seen_from_W(poses(commanded, spindle_rad), tip_S_mm);
}

MachinePose Machine::poses(const AxisPositions& commanded, SpindleAngle spindle_rad) const {
    return poses_of(*this, commanded, nullptr, spindle_rad);
}

MachinePose Machine::poses(const AxisPositions& commanded, const Perturbation& extra,
                           SpindleAngle spindle_rad) const {
    return poses_of(*this, commanded, &extra, spindle_rad);
}

Vector3 Machine::tip_W(const AxisPositions& commanded, const Vector3& tip_S_mm,
                       SpindleAngle spindle_rad) const {
    return tip_seen_from_W(poses(commanded, spindle_rad), tip_S_mm);
}

}  // namespace trunnion::kinematics
