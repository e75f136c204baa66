#include "compensation/tip_corrector.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/alarm.h"
#include "base/units.h"
#include "kinematics/jacobian.h"
#include "kinematics/tool_sense.h"
#include "offsets/axis_numbers.h"
#include "positioning/rotary_transform.h"

namespace trunnion::compensation {
namespace {

/// An axis with a gap that is at rest in the program does not reverse for a correction below this.
constexpr double rest_mm = 1e-5, rest_rad = 2e-8;

bool rotaries_turn(const motion::AxisMove& move) {
    for (const Axis axis : {Axis::A, Axis::B, Axis::C})
        if (move.from[axis] != move.to[axis]) return true;
    return false;
}

/// Additional correction of an angle already corrected by `so_far_rad`: the full wish while the sum
/// is well within the limit; a total of zero when the sum would be far beyond it (and of little
/// use); smooth in between.
double within(double so_far_rad, double wish_rad, double limit_rad) {
    const double sum_rad = so_far_rad + wish_rad;
    return sum_rad / (1.0 + std::pow(sum_rad / limit_rad, 4)) - so_far_rad;
}

/// An axis unknown to the control would be treated as an error of the machine.
void refuse_unknown_axes(const setup::Setup& setup) {
    std::vector<Axis> order;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        order.push_back(axis.axis);
    const ParallelAxes known = offsets::parallel_axes(setup.stores.parameters, order);
    for (std::size_t i = 0; i < 3; ++i)
        if (const Axis axis = all_axes[index_of(Axis::U) + i];
            setup.machine.chain.find(axis) && known.beside[i] < 0)
            throw InputError(std::string("compensation needs to know how ") + letter_of(axis) +
                                 " runs: parameter 1022 = 5, 6 or 7, parallel to X, Y or Z",
                             {setup.path, 0, 0});
}

/// The coordinates of a program are those of the tool on the work; an axis that counts the other
/// way mirrors them, and nobody states how.
void refuse_mirrored_axes(const setup::Setup& setup) {
    const Vector3 senses = kinematics::tool_senses(setup.machine.chain);
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        if (senses(static_cast<Eigen::Index>(index_of(axis))) < 0.0)
            throw InputError(
                fmt::format("compensation needs axes that count as ISO 841 says: a + command of {} "
                            "moves the tool against + of M relative to the work",
                            letter_of(axis)),
                {setup.path, 0, 0});
}

}  // namespace

double angle_between(const Vector3& a, const Vector3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

TipCorrector::TipCorrector(const setup::Setup& setup, const emulator::EffectModels& effects,
                           double largest_turn_rad, int decimals)
    : setup_(setup),
      nominal_(setup.machine),
      machine_(setup, effects),
      largest_turn_rad_(largest_turn_rad),
      digit_mm_(std::pow(10.0, -decimals)) {
    nominal_.errors = {};
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        if (!nominal_.chain.find(axis))
            throw InputError("compensation needs the axes X, Y and Z", {setup.path, 0, 0});
    refuse_unknown_axes(setup);
    refuse_mirrored_axes(setup);
}

bool TipCorrector::turns_tool(const motion::AxisMove& move) const {
    if (largest_turn_rad_ <= 0.0 || !move.transform) return false;
    const offsets::PivotParameters& pivot = move.transform->pivot();
    if (pivot.first.hypothetical || pivot.second.hypothetical) return false;
    return move.mode == PositioningMode::rtcp || rotaries_turn(move);
}

emulator::BelievedTool TipCorrector::meant(const motion::AxisMove& move, double s) const {
    return emulator::believed_tool(move, move.at(s));
}

namespace {

/// Without an active length the gauge point is meant, on which no tool effect acts.
emulator::Contact contact(const setup::Setup& setup, const motion::AxisMove& move) {
    return move.tool_vector_mm.isZero(0.0) ? emulator::Contact{}
                                           : emulator::tip_contact(setup, move);
}

emulator::BelievedTool tool_at(const emulator::PhysicalState& state, const motion::AxisMove& move) {
    const Vector3 tool_S =
        move.transform ? move.transform->pivot().tool_direction : Vector3::UnitZ();
    return {emulator::physical_tip_W(state, -move.tool_vector_mm),
            state.poses.pose_MW.rotation.transpose() * (state.poses.pose_MS.rotation * tool_S)};
}

}  // namespace

emulator::BelievedTool TipCorrector::truth(const emulator::PathSampler& path, double s) const {
    return tool_at(machine_.at(path.at(s), contact(setup_, path.move)), path.move);
}

emulator::BelievedTool TipCorrector::truth(const emulator::PathSampler& path, double s,
                                           const AxisPositions& q, const Travel& travel) const {
    AxisSample sample = path.at(s);
    sample.position = q;
    sample.travel = travel;
    return tool_at(machine_.at(sample, contact(setup_, path.move)), path.move);
}

/// One step of both rotary axes towards the intended direction.
void TipCorrector::turn(const Arrival& arrives, const emulator::BelievedTool& meant,
                        AxisPositions& q) const {
    const auto& [path, s, travel, held] = arrives;
    const positioning::RotaryTransform& belief = *path.move.transform;
    const Vector3 off = truth(path, s, q, travel).direction_W - meant.direction_W;
    const Eigen::Matrix<double, 3, 2> by = belief.derivative(q, path.move.tool_vector_mm).direction;
    const positioning::RotarySolution commanded = belief.rotaries(path.move.at(s)),
                                      now = belief.rotaries(q);
    const std::array<double, 2> so_far{now.first_rad - commanded.first_rad,
                                       now.second_rad - commanded.second_rad};
    const std::array<std::optional<double>, 2> stay{held[index_of(belief.pivot().first.axis)],
                                                    held[index_of(belief.pivot().second.axis)]};
    const double a = by.col(0).squaredNorm(), b = by.col(1).squaredNorm(),
                 ab = by.col(0).dot(by.col(1));
    const std::array<double, 2> wish_of{-by.col(0).dot(off), -by.col(1).dot(off)};
    const double determinant = a * b - ab * ab;
    std::array<double, 2> step{};
    if (determinant > 1e-12 * a * b && determinant > 0.0)
        step = {(b * wish_of[0] - ab * wish_of[1]) / determinant,
                (a * wish_of[1] - ab * wish_of[0]) / determinant};
    // The axis with little influence on the direction, or a held axis, gets less than requested;
    // the other one minimises the remaining error.
    const std::size_t weak = stay[0] ? 0 : stay[1] ? 1 : a < b ? 0 : 1, strong = 1 - weak;
    const std::array<double, 2> at{now.first_rad, now.second_rad};
    step[weak] =
        stay[weak] ? *stay[weak] - at[weak] : within(so_far[weak], step[weak], largest_turn_rad_);
    const double strong_square = strong == 0 ? a : b;
    const double strong_wish =
        strong_square > 0.0 ? (wish_of[strong] - ab * step[weak]) / strong_square : 0.0;
    step[strong] = stay[strong] ? *stay[strong] - at[strong]
                                : within(so_far[strong], strong_wish, largest_turn_rad_);
    q = belief.with_rotaries(q, {at[0] + step[0], at[1] + step[1]});
}

AxisPositions TipCorrector::solved(const Arrival& at) const {
    const auto& [path, s, travel, held] = at;
    AxisPositions q = path.move.at(s);
    const emulator::BelievedTool wanted = meant(path.move, s);
    if (turns_tool(path.move))
        for (int i = 0; i < 3; ++i) turn(at, wanted, q);  // each step leaves a remainder of 1e-4
    // X Y Z are the first three axes; the nominal machine is accurate enough here.
    const Matrix3 by_axis =
        kinematics::tip_jacobian(nominal_, q, -path.move.tool_vector_mm).axis.leftCols<3>();
    const Matrix3 solve = by_axis.inverse();
    for (int i = 0; i < 6; ++i) {
        const Vector3 off = truth(path, s, q, travel).tip_W_mm - wanted.tip_W_mm;
        if (off.norm() < 1e-10) break;
        const Vector3 step = solve * off;
        for (std::size_t k = 0; k < 3; ++k) q.value[k] -= step[static_cast<Eigen::Index>(k)];
    }
    return q;
}

double TipCorrector::digit(std::size_t axis) const {
    return is_rotary(all_axes[axis]) ? rad_from_deg(digit_mm_) : digit_mm_;
}

/// Travel of the axes on arrival at q; a change below the written digits is no motion.
Travel TipCorrector::arrival(const AxisPositions& q, const records::TravelHistory& written) const {
    Travel travel = written.travel();
    for (std::size_t i = 0; i < axis_count; ++i)
        if (const double way = q.value[i] - written.position().value[i];
            std::abs(way) > 0.5 * digit(i))
            travel[i] = way > 0.0 ? 1 : -1;
    return travel;
}

Correction TipCorrector::corrected(const emulator::PathSampler& path, const PathStretch& stretch,
                                   double s, const records::TravelHistory& written) const {
    // Rotary axes first, because they move the linear axes.
    constexpr std::array<std::size_t, axis_count> order{3, 4, 5, 0, 1, 2, 6, 7, 8};
    constexpr int most_rounds = 16;
    const AxisPositions& from = written.position();
    Correction c;
    for (std::size_t i = 0; i < axis_count; ++i)
        c.travel[i] = stretch.travel[i] != 0 ? stretch.travel[i] : written.travel()[i];
    Held held;
    AxisPositions beyond;  // held axes: their wanted position
    c.wanted = solved({path, s, c.travel, held});
    for (int round = 0; round < most_rounds; ++round) {
        const Travel arrives = arrival(c.wanted, written);
        const auto asks = std::find_if(order.begin(), order.end(), [&](std::size_t i) {
            return !c.held[i] && arrives[i] != c.travel[i];
        });
        if (asks == order.end()) break;
        const std::size_t i = *asks;
        Travel other = c.travel;
        other[i] = arrives[i];
        const AxisPositions turned = solved({path, s, other, held});
        const double now_off = std::abs(c.wanted.value[i] - from.value[i]),
                     then_off = std::abs(turned.value[i] - from.value[i]),
                     jump = std::abs(turned.value[i] - c.wanted.value[i]);
        const double rest = std::max(digit(i), is_rotary(all_axes[i]) ? rest_rad : rest_mm);
        const bool idle = stretch.travel[i] == 0 && now_off < rest && jump > rest;
        c.held[i] = idle || arrival(turned, written)[i] != other[i];
        beyond.value[i] = (then_off < now_off ? turned : c.wanted).value[i];
        if (!c.held[i] || then_off < now_off) c.travel = other;
        // At the present side of the gap, or just on the other side.
        if (c.held[i])
            held[i] =
                from.value[i] + (c.travel[i] == written.travel()[i] ? 0.0 : c.travel[i] * digit(i));
        c.wanted = solved({path, s, c.travel, held});
    }
    c.to = c.wanted;
    for (std::size_t i = 0; i < axis_count; ++i)
        if (held[i]) {
            c.to.value[i] = *held[i];
            c.wanted.value[i] = beyond.value[i];
        }
    return c;
}

}  // namespace trunnion::compensation
