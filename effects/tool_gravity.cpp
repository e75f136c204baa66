// Effects of chains with a rotary tool side: heads, arms, telescopes.
#include <cmath>

#include "effects/models.h"

namespace trunnion::effects {
namespace {

/// A tool-side axis at the commanded positions.
struct CarriedAxis {
    kinematics::AxisGeometry axis;
    Matrix3 carrier_M;  ///< rotation of its carrier
    Vector3 direction_M, point_M_mm;
};

/// All tool-side axes, from the bed outwards, and finally what the last one carries.
std::vector<CarriedAxis> carried(const kinematics::Chain& chain, const CarriedTool& tool,
                                 const AxisSample& sample) {
    std::vector<CarriedAxis> list;
    Pose pose;
    for (const kinematics::AxisGeometry& axis : chain.tool) {
        list.push_back({axis, pose.rotation, pose.rotation * axis.direction, pose * axis.point_mm});
        const double q = sample.position[axis.axis];
        pose = pose * (axis.rotary ? Pose::turn(axis.direction, axis.point_mm, q)
                                   : Pose::shift(q * axis.direction));
    }
    list.push_back({{}, pose.rotation, pose.rotation * tool.along_S, pose * tool.centre_S_mm});
    return list;
}

std::vector<kinematics::AxisGeometry> rotary_of(const std::vector<kinematics::AxisGeometry>& side) {
    std::vector<kinematics::AxisGeometry> list;
    for (const kinematics::AxisGeometry& axis : side)
        if (axis.rotary) list.push_back(axis);
    return list;
}

/// Mean horizontal lever (m) of the carried parts, with the sign of the rotation caused by their
/// weight. The masses are represented by points of the following rotary axes; for the last axis by
/// the tool.
double lever_m(const std::vector<CarriedAxis>& list, std::size_t k) {
    double sum = 0.0, count = 0.0;
    const auto add = [&](const Vector3& mass_M_mm) {
        const Vector3 arm_m = 1e-3 * (mass_M_mm - list[k].point_M_mm);
        sum += list[k].direction_M.dot(arm_m.cross(-Vector3::UnitZ()));
        count += 1.0;
    };
    for (std::size_t j = k + 1; j + 1 < list.size(); ++j)
        if (list[j].axis.rotary) add(list[j].point_M_mm);
    if (count == 0.0) add(list.back().point_M_mm);
    return sum / count;
}

/// Two unit vectors perpendicular to an axis.
std::pair<Vector3, Vector3> across(const Vector3& direction) {
    const Vector3 first = direction.unitOrthogonal();
    return {first, direction.cross(first)};
}

}  // namespace

Effect gravity_tool(const kinematics::Chain& chain, const CarriedTool& tool) {
    const auto rotary = rotary_of(chain.tool);
    Effect effect{identity_of(EffectKind::gravity_tool),
                  "Joints of the tool side give way under the weight that they carry",
                  "elastic gears and links of a head or an arm, heavy tool",
                  "compensate by the posture; counterbalance, or stiffen the joint",
                  "angle of R + twist_R_rad * lever (m): mean horizontal lever of the rotary axes "
                  "behind R (of the last one: of the spindle, or of an arm's target)",
                  {},
                  {}};
    for (const kinematics::AxisGeometry& axis : rotary)
        effect.parameters.push_back(
            {axis_parameter("twist_", axis, "_rad"), "rad", 100e-6, -1, {}, true});
    effect.add = [chain, tool](const AxisSample& sample, const emulator::Contact&,
                               std::span<const double> value, kinematics::Perturbation& out) {
        const std::vector<CarriedAxis> list = carried(chain, tool, sample);
        std::size_t j = 0;
        for (std::size_t k = 0; k + 1 < list.size(); ++k) {
            if (!list[k].axis.rotary) continue;
            if (value[j] != 0.0) out.axis[list[k].axis.axis] += value[j] * lever_m(list, k);
            ++j;
        }
    };
    return effect;
}

Effect chain_collimation(const kinematics::Chain& chain) {
    const kinematics::AxisGeometry last = rotary_of(chain.tool).back();
    return {identity_of(EffectKind::chain_collimation),
            "The tool or the line of sight does not stand on the last axis as declared",
            "seat of the tool, collimation of a telescope or of a measuring head",
            "reverse the axis (turn by half, point again) and set half the difference",
            "what the last rotary axis of the tool side carries is tilted by first_rad and "
            "second_rad about two lines across that axis, which turn with it",
            {{"first_rad", "rad", 50e-6, -1, {}, true}, {"second_rad", "rad", 50e-6, -1, {}, true}},
            [last](const AxisSample& sample, const emulator::Contact&,
                   std::span<const double> value, kinematics::Perturbation& out) {
                const auto [first, second] = across(last.direction);
                out.motion[index_of(last.axis)].tilt_rad +=
                    rotation_about(last.direction, sample.position[last.axis]) *
                    (value[0] * first + value[1] * second);
            }};
}

Effect chain_flexure(const kinematics::Chain& chain, const CarriedTool& tool) {
    return {
        identity_of(EffectKind::chain_flexure),
        "The head bows towards the ground where it reaches out",
        "weight of head, tube or spindle beyond its last axis",
        "compensate by the angle to the plumb line; balance or stiffen the head",
        "what the last rotary axis of the tool side carries tilts by droop_rad * n x g; n: "
        "from the spindle to the tool, of an arm from its last axis to the target, of a telescope "
        "(target on its last axis) the line of sight; g: downwards, unit vectors",
        {{"droop_rad", "rad", 50e-6, -1, {}, true}},
        [chain, tool](const AxisSample& sample, const emulator::Contact&,
                      std::span<const double> value, kinematics::Perturbation& out) {
            const std::vector<CarriedAxis> list = carried(chain, tool, sample);
            const Vector3& tool_M = list.back().direction_M;
            for (std::size_t k = list.size() - 1; k-- > 0;) {
                if (!list[k].axis.rotary) continue;
                out.motion[index_of(list[k].axis.axis)].tilt_rad +=
                    value[0] * list[k].carrier_M.transpose() * tool_M.cross(-Vector3::UnitZ());
                return;
            }
        }};
}

}  // namespace trunnion::effects
