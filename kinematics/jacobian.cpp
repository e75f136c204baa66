#include "kinematics/jacobian.h"

#include "kinematics/forward.h"

namespace trunnion::kinematics {
namespace {

/// Left Jacobian J of the rotation vector e (rad): d exp([e]x) = [J de]x exp([e]x). Series up to
/// the third power; the neglected terms are of the order |e|^4 / 120.
Matrix3 left_jacobian(const Vector3& e) {
    const Matrix3 x = skew(e);
    return Matrix3::Identity() + 0.5 * x + x * x / 6.0 + x * x * x / 24.0;
}

/// Rotations caused by three parameters, as the columns of `turn` in M, about the point
/// `centre_mm`.
struct Lever {
    Eigen::Matrix<double, 3, 3> turn = Matrix3::Zero();
    Vector3 centre_mm = Vector3::Zero();
};

struct LinkDerivatives {
    Matrix3 location_shift = Matrix3::Zero(), motion_shift = Matrix3::Zero();
    Matrix3 location_direct = Matrix3::Zero();  ///< tilts of a linear axis: they shift the frame
                                                ///< without turning it
    Lever location_turn, motion_turn;
    Vector3 axis_shift = Vector3::Zero();  ///< d translation / d position
    Vector3 axis_turn = Vector3::Zero();   ///< d rotation / d position, about the centre of the
                                           ///< error motion
};

Vector3 shift_of(const AxisErrors& errors, double q) {
    return {errors.motion[0](q), errors.motion[1](q), errors.motion[2](q)};
}
Vector3 tilt_of(const AxisErrors& errors, double q) {
    return {errors.motion[3](q), errors.motion[4](q), errors.motion[5](q)};
}
Vector3 shift_slope(const AxisErrors& errors, double q) {
    return {errors.motion[0].derivative(q), errors.motion[1].derivative(q),
            errors.motion[2].derivative(q)};
}
Vector3 tilt_slope(const AxisErrors& errors, double q) {
    return {errors.motion[3].derivative(q), errors.motion[4].derivative(q),
            errors.motion[5].derivative(q)};
}
Vector3 location_tilt(const AxisErrors& errors) {
    return {errors.location[3], errors.location[4], errors.location[5]};
}

LinkDerivatives rotary(const AxisGeometry& axis, const AxisErrors& errors, double q,
                       const Pose& before) {
    const Link link = make_link(axis, errors);
    const Vector3 tilt = tilt_of(errors, q), shift = shift_of(errors, q);
    const Matrix3 base = before.rotation, tilted = base * link.tilt;
    LinkDerivatives d;
    d.location_shift = base;
    d.motion_shift = tilted;
    d.location_turn = {base * left_jacobian(location_tilt(errors)), before * link.carried_mm};
    d.motion_turn = {tilted * left_jacobian(tilt),
                     before * Vector3(link.carried_mm + link.tilt * shift)};
    d.axis_shift = tilted * shift_slope(errors, q);
    d.axis_turn =
        tilted * rotation_of(tilt) * axis.direction + d.motion_turn.turn * tilt_slope(errors, q);
    return d;
}

LinkDerivatives linear(const AxisGeometry& axis, const AxisErrors& errors, double q,
                       const Pose& before) {
    const Link link = make_link(axis, errors);
    const Matrix3 base = before.rotation;
    const Vector3 shift_mm = q * link.direction + link.carried_mm + shift_of(errors, q);
    LinkDerivatives d;
    d.location_shift = d.motion_shift = base;
    d.location_direct = -base * skew(q * link.direction) * left_jacobian(location_tilt(errors));
    d.motion_turn = {base * left_jacobian(tilt_of(errors, q)), before * shift_mm};
    d.axis_shift = base * (link.direction + shift_slope(errors, q));
    d.axis_turn = d.motion_turn.turn * tilt_slope(errors, q);
    return d;
}

/// Derivatives of all axes of one side of the chain, and the pose of its end.
struct Side {
    std::vector<LinkDerivatives> links;
    Pose end;
};

Side differentiate(const std::vector<AxisGeometry>& axes, const GeometricErrors& errors,
                   const AxisPositions& q) {
    Side side;
    for (const AxisGeometry& axis : axes) {
        const AxisErrors& own = errors.axis[index_of(axis.axis)];
        const double position = q[axis.axis];
        side.links.push_back((axis.rotary ? rotary : linear)(axis, own, position, side.end));
        carry(make_link(axis, own), {position, position}, nullptr, side.end);
    }
    return side;
}

/// Displacement of the point p by the rotations of a lever, one column each.
Matrix3 swing(const Lever& lever, const Vector3& p) {
    return -skew(p - lever.centre_mm) * lever.turn;
}

void fill(const std::vector<AxisGeometry>& axes, const Side& side, const Vector3& point_M,
          const Matrix3& to_W, TipJacobian& out) {
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const LinkDerivatives& d = side.links[i];
        const std::size_t k = index_of(axes[i].axis);
        out.location[k].leftCols<3>() = to_W * d.location_shift;
        out.location[k].rightCols<3>() =
            to_W * (d.location_direct + swing(d.location_turn, point_M));
        out.motion[k].leftCols<3>() = to_W * d.motion_shift;
        out.motion[k].rightCols<3>() = to_W * swing(d.motion_turn, point_M);
        const Vector3 arm = point_M - d.motion_turn.centre_mm;
        out.axis.col(static_cast<Eigen::Index>(k)) = to_W * (d.axis_shift + d.axis_turn.cross(arm));
    }
}

}  // namespace

TipJacobian tip_jacobian(const Machine& machine, const AxisPositions& commanded,
                         const Vector3& tip_S_mm, SpindleAngle spindle_rad) {
    const Side work = differentiate(machine.chain.work, machine.errors, commanded);
    const Side tool = differentiate(machine.chain.tool, machine.errors, commanded);
    const SmallMotion location = spindle_location(machine.errors.spindle),
                      motion = spindle_motion(machine.errors.spindle, spindle_rad);
    const Matrix3 tilted = rotation_of(location.tilt_rad), turned = rotation_of(motion.tilt_rad);
    const Vector3 moved_mm = turned * tip_S_mm + motion.shift_mm;
    const Vector3 tip_M = tool.end * Vector3(tilted * moved_mm + location.shift_mm);
    const Matrix3 to_W = work.end.rotation.transpose();
    TipJacobian out;
    for (auto* columns : {&out.location, &out.motion})
        for (SixColumns& six : *columns) six.setZero();
    out.tip_W_mm = to_W * (tip_M - work.end.translation_mm);
    fill(machine.chain.tool, tool, tip_M, to_W, out);
    fill(machine.chain.work, work, tip_M, -to_W, out);  // a motion of the table displaces the tip
                                                        // in W the other way
    const Matrix3 spindle_to_W = to_W * tool.end.rotation, tilted_to_W = spindle_to_W * tilted;
    out.spindle_location.leftCols<3>() = spindle_to_W;
    out.spindle_location.rightCols<3>() =
        -spindle_to_W * skew(tilted * moved_mm) * left_jacobian(location.tilt_rad);
    out.spindle_motion.leftCols<3>() = tilted_to_W;
    out.spindle_motion.rightCols<3>() =
        -tilted_to_W * skew(turned * tip_S_mm) * left_jacobian(motion.tilt_rad);
    out.tip = tilted_to_W * turned;
    return out;
}

}  // namespace trunnion::kinematics
