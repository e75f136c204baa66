// Effects of the control on the path: rounding, chords, wrong pivot stores.
#include <cmath>

#include "base/units.h"
#include "effects/models.h"

namespace trunnion::effects {
namespace {

double rounding_error(double value, double increment) {
    return increment > 0.0 ? std::round(value / increment) * increment - value : 0.0;
}

/// Acceleration and speed of the commanded path of the linear axes, mm and s.
struct PathTurn {
    Vector3 acceleration = Vector3::Zero();
    double speed = 0.0;
};

PathTurn turn_of(const AxisSample& sample) {
    PathTurn turn;
    Vector3 velocity;
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z}) {
        turn.acceleration(static_cast<int>(index_of(axis))) = sample.acceleration[axis];
        velocity(static_cast<int>(index_of(axis))) = sample.velocity[axis];
    }
    turn.speed = velocity.norm();
    return turn;
}

EffectParameter fraction() {
    EffectParameter part{"fraction", "1", 1.0};
    part.is_part = true;
    return part;
}

std::vector<double> block_lengths() {
    std::vector<double> grid;
    for (int k = 4; k <= 120; ++k) grid.push_back(0.05 * k);
    for (int k = 61; k <= 160; ++k) grid.push_back(0.1 * k);
    return grid;
}

/// Nominal rotations of the rotary table axes, from the bed: first, and first times second.
struct TableRotation {
    Matrix3 first = Matrix3::Identity(), both = Matrix3::Identity();
};

TableRotation table_rotation(const std::vector<kinematics::AxisGeometry>& rotary,
                             const AxisSample& sample) {
    TableRotation result;
    for (std::size_t k = 0; k < rotary.size(); ++k) {
        const Matrix3 turn = rotation_about(rotary[k].direction, sample.position[rotary[k].axis]);
        result.both = result.both * turn;
        if (k == 0) result.first = turn;
    }
    return result;
}

std::vector<kinematics::AxisGeometry> rotary_of(const kinematics::Chain& chain) {
    std::vector<kinematics::AxisGeometry> rotary;
    for (const kinematics::AxisGeometry& axis : chain.work)
        if (axis.rotary) rotary.push_back(axis);
    return rotary;
}

void move_axes(const Vector3& shift_mm, kinematics::Perturbation& out) {
    out.axis[Axis::X] += shift_mm.x();
    out.axis[Axis::Y] += shift_mm.y();
    out.axis[Axis::Z] += shift_mm.z();
}

Vector3 three(std::span<const double> value) {
    return {value[0], value[1], value[2]};
}

}  // namespace

Effect control_rounding(const kinematics::Chain& chain) {
    return {identity_of(EffectKind::control_rounding),
            "Commanded positions are rounded to a coarse increment on their way to the drive",
            "post-processor digits, least input increment, encoder resolution",
            "more decimals in the program, finer increment system (IS-C)",
            "position + fraction (round to increment - position); fraction 1 when it is so",
            {fraction(),
             {"increment_deg",
              "deg",
              0.001,
              -1,
              {0.0, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05, 0.1},
              false},
             {"increment_mm", "mm", 0.0, -1, {0.0, 0.001, 0.002, 0.005, 0.01, 0.02, 0.05}, false}},
            [axes = chain.axes()](const AxisSample& sample, const emulator::Contact&,
                                  std::span<const double> value, kinematics::Perturbation& out) {
                for (const kinematics::AxisGeometry& axis : axes) {
                    const double step = axis.rotary ? rad_from_deg(value[1]) : value[2];
                    out.axis[axis.axis] +=
                        value[0] * rounding_error(sample.position[axis.axis], step);
                }
            },
            SeenBy::any_encoder};
}

Effect control_chord(const kinematics::Chain&) {
    return {identity_of(EffectKind::control_chord),
            "A curve is cut into straight pieces that pass inside it",
            "coarse tolerance of the post-processor, rotary moves without tool-centre control",
            "finer segments, or let the control interpolate (G02, G43.4)",
            "linear axes inwards by fraction s (block_mm - s) / (2 r), s along the straight block",
            {fraction(), {"block_mm", "mm", 2.0, -1, block_lengths(), false}},
            [](const AxisSample& sample, const emulator::Contact& contact,
               std::span<const double> value, kinematics::Perturbation& out) {
                if (contact.device != records::Device::ballbar) return;
                const PathTurn turn = turn_of(sample);
                if (turn.speed < 1e-6) return;
                const double s = std::fmod(sample.path_mm, value[1]);
                const double time2 = s * (value[1] - s) / (turn.speed * turn.speed);
                move_axes(value[0] * 0.5 * time2 * turn.acceleration, out);
            }};
}

Effect pivot_g54(const kinematics::Chain& chain) {
    Effect effect{identity_of(EffectKind::pivot_g54),
                  "The work offset G54 does not hold the true pivot point",
                  "work zero set again without correcting it, post-processor with old pivot",
                  "make G54 agree with parameters 19700-19705 and with the machine",
                  "modes dpp, rtdfo: axes move by -(R1 R2 - 1) dg_mm",
                  {},
                  {}};
    for (int d = 0; d < 3; ++d) effect.parameters.push_back({"dg_mm", "mm", 30e-3, d, {}, true});
    effect.add = [rotary = rotary_of(chain)](const AxisSample& sample, const emulator::Contact&,
                                             std::span<const double> value,
                                             kinematics::Perturbation& out) {
        if (sample.mode != PositioningMode::dpp && sample.mode != PositioningMode::rtdfo) return;
        const Vector3 dg = three(value);
        move_axes(dg - table_rotation(rotary, sample).both * dg, out);
    };
    return effect;
}

Effect pivot_p1970x(const kinematics::Chain& chain) {
    Effect effect{identity_of(EffectKind::pivot_p1970x),
                  "Parameters 19700-19705 do not hold the true pivot point",
                  "parameters from another machine, not updated after service",
                  "calibrate the rotary axes and enter 19700-19705 anew",
                  "modes rtcp, tw: axes move by -((R1 R2 - 1)(dp + dd) - (R1 - 1) dd)",
                  {},
                  {}};
    for (const char* name : {"dp_mm", "dd_mm"})
        for (int d = 0; d < 3; ++d) effect.parameters.push_back({name, "mm", 30e-3, d, {}, true});
    effect.add = [rotary = rotary_of(chain)](const AxisSample& sample, const emulator::Contact&,
                                             std::span<const double> value,
                                             kinematics::Perturbation& out) {
        if (sample.mode != PositioningMode::rtcp && sample.mode != PositioningMode::tw) return;
        const Vector3 dd = three(value.subspan(3)), sum = three(value) + dd;
        const TableRotation turn = table_rotation(rotary, sample);
        move_axes(sum - turn.both * sum + turn.first * dd - dd, out);
    };
    return effect;
}

}  // namespace trunnion::effects
