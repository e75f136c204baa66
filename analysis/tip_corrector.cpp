#include "analysis/tip_corrector.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/alarm.h"
#include "kinematics/jacobian.h"
#include "positioning/rotary_transform.h"

namespace trunnion {
namespace {

bool rotaries_turn(const AxisMove& move) {
    for (const Axis axis : {Axis::A, Axis::B, Axis::C})
        if (move.from[axis] != move.to[axis]) return true;
    return false;
}

/// What to add to an angle corrected by `so_far_rad`: all of the wish while the sum is well within
/// the limit, nothing in all when the sum would be far beyond it (and help little), smooth between.
double within(double so_far_rad, double wish_rad, double limit_rad) {
    const double sum_rad = so_far_rad + wish_rad;
    return sum_rad / (1.0 + std::pow(sum_rad / limit_rad, 4)) - so_far_rad;
}

}  // namespace

double angle_between(const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

TipCorrector::TipCorrector(const Setup& setup, const EffectModels& effects, double largest_turn_rad)
    : nominal_(setup.machine),
      machine_(setup.machine, effects),
      largest_turn_rad_(largest_turn_rad) {
    nominal_.errors = {};
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        if (!nominal_.chain.find(axis))
            throw InputError("compensation needs the axes X, Y and Z", {setup.path, 0, 0});
}

bool TipCorrector::turns_tool(const AxisMove& move) const {
    if (largest_turn_rad_ <= 0.0 || !move.transform) return false;
    const PivotParameters& pivot = move.transform->pivot();
    if (pivot.first.hypothetical || pivot.second.hypothetical) return false;
    return move.mode == PositioningMode::rtcp || rotaries_turn(move);
}

BelievedTool TipCorrector::meant(const AxisMove& move, double s) const {
    return believed_tool(move, move.at(s));
}

BelievedTool TipCorrector::truth(const PathSampler& path, double s, const AxisPositions& q) const {
    AxisSample sample = path.at(s);
    sample.position = q;
    const PhysicalState state = machine_.at(sample, {});
    const Vector3 tool_S =
        path.move.transform ? path.move.transform->pivot().tool_direction : Vector3::UnitZ();
    return {physical_tip_W(state, -path.move.tool_vector_mm),
            state.poses.pose_MW.rotation.transpose() * (state.poses.pose_MS.rotation * tool_S)};
}

/// One step of both rotaries towards the meant direction.
void TipCorrector::turn(const PathSampler& path, double s, const BelievedTool& meant,
                        AxisPositions& q) const {
    const RotaryTransform& belief = *path.move.transform;
    const Vector3 off = truth(path, s, q).direction_W - meant.direction_W;
    const Eigen::Matrix<double, 3, 2> by = belief.derivative(q, path.move.tool_vector_mm).direction;
    const RotarySolution commanded = belief.rotaries(path.move.at(s)), now = belief.rotaries(q);
    const std::array<double, 2> so_far{now.first_rad - commanded.first_rad,
                                       now.second_rad - commanded.second_rad};
    const double a = by.col(0).squaredNorm(), b = by.col(1).squaredNorm(),
                 ab = by.col(0).dot(by.col(1));
    const std::array<double, 2> wish_of{-by.col(0).dot(off), -by.col(1).dot(off)};
    const double determinant = a * b - ab * ab;
    std::array<double, 2> step{};
    if (determinant > 1e-12 * a * b && determinant > 0.0)
        step = {(b * wish_of[0] - ab * wish_of[1]) / determinant,
                (a * wish_of[1] - ab * wish_of[0]) / determinant};
    // The axis that hardly moves the direction gets less than it asks; the other makes the best of
    // it.
    const std::size_t weak = a < b ? 0 : 1, strong = 1 - weak;
    step[weak] = within(so_far[weak], step[weak], largest_turn_rad_);
    const double strong_wish = (wish_of[strong] - ab * step[weak]) / std::max(a, b);
    step[strong] = within(so_far[strong], strong_wish, largest_turn_rad_);
    q = belief.with_rotaries(q, {now.first_rad + step[0], now.second_rad + step[1]});
}

AxisPositions TipCorrector::corrected(const PathSampler& path, double s) const {
    AxisPositions q = path.move.at(s);
    const BelievedTool wanted = meant(path.move, s);
    if (turns_tool(path.move))
        for (int i = 0; i < 3; ++i) turn(path, s, wanted, q);  // each step leaves 1e-4
    // Axes X Y Z are the first three; the nominal machine is near enough here too.
    const Matrix3 by_axis = tip_jacobian(nominal_, q, -path.move.tool_vector_mm).axis.leftCols<3>();
    const Matrix3 solve = by_axis.inverse();
    for (int i = 0; i < 6; ++i) {
        const Vector3 off = truth(path, s, q).tip_W_mm - wanted.tip_W_mm;
        if (off.norm() < 1e-10) break;
        const Vector3 step = solve * off;
        for (std::size_t k = 0; k < 3; ++k) q.value[k] -= step[static_cast<Eigen::Index>(k)];
    }
    return q;
}

}  // namespace trunnion
