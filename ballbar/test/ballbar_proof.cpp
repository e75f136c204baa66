#include "ballbar/test/ballbar_proof.h"

#include <algorithm>
#include <cmath>

#include "ballbar/test/ballbar_evaluation.h"
#include "base/units.h"
#include "emulator/replay.h"
#include "emulator/tool_tip.h"

namespace trunnion::ballbar::test {

namespace {

/// Rotary positions for judging the compensation: every 30 degrees of the tested ranges.
std::vector<AxisPositions> judged_poses(const kinematics::Machine& nominal,
                                        const BallbarLayout& layout) {
    const auto [first, second] = table_axes(nominal.chain);
    std::vector<AxisPositions> poses(1);
    const double step = rad_from_deg(30.0);
    for (double a = layout.first_rad.first; a < layout.first_rad.second + 1e-9; a += step)
        for (double c = layout.second_rad.first; c < layout.second_rad.second - 1e-9; c += step) {
            AxisPositions q;
            q[first.axis] = a;
            q[second.axis] = c;
            poses.push_back(q);
        }
    return poses;
}

AxisPositions aimed(const kinematics::Machine& nominal, AxisPositions q, const Vector3& point_W_mm,
                    const Vector3& tip_S_mm) {
    const Vector3 at = nominal.poses(q).pose_MW * point_W_mm - tip_S_mm;
    for (int i = 0; i < 3; ++i) q.value[static_cast<std::size_t>(i)] = at[i];
    return q;
}

const setup::Artefact* sphere_of(const setup::Setup& setup) {
    for (const setup::Artefact& artefact : setup.artefacts)
        if (artefact.kind == setup::Artefact::Kind::sphere) return &artefact;
    return nullptr;
}

/// Sphere rows at the poses, three components each, home first.
records::ReadingTable sphere_rows(const setup::Setup& setup, const BallbarLayout& layout,
                                  const setup::Artefact& sphere,
                                  const emulator::Compensation& compensate) {
    const kinematics::Machine nominal = nominal_of(setup);
    records::ReadingTable table;
    for (const kinematics::AxisGeometry& axis : nominal.chain.axes())
        table.axes.push_back(axis.axis);
    for (const AxisPositions& pose : judged_poses(nominal, layout)) {
        records::Reading row;
        row.test = "sphere";
        row.device = records::Device::sphere;
        row.feature = sphere.name;
        row.mode = PositioningMode::rtcp;
        row.time_s = 10.0 * static_cast<double>(table.rows.size());
        row.commanded = compensate(aimed(nominal, pose, sphere.center_W_mm, setup.probe->tip_S_mm));
        for (int d = 0; d < 3; ++d) {
            row.direction_M = Vector3::Unit(d);
            table.rows.push_back(row);
        }
    }
    return table;
}

/// Largest measured minus expected centre; the position measured at home moves with the table.
double largest_miss_um(const setup::Setup& setup, const BallbarLayout& layout,
                       const setup::Artefact& sphere, const emulator::EffectModels& effects,
                       const emulator::Compensation& compensate) {
    const records::ReadingTable found =
        emulator::predicted(setup, sphere_rows(setup, layout, sphere, compensate), effects);
    const kinematics::Machine nominal = nominal_of(setup);
    std::optional<Vector3> home_W;
    double worst_mm = 0.0;
    for (std::size_t i = 0; i + 2 < found.rows.size(); i += 3) {
        const Vector3 miss(*found.rows[i].value_mm, *found.rows[i + 1].value_mm,
                           *found.rows[i + 2].value_mm);
        const Matrix3 table = nominal.poses(found.rows[i].commanded).pose_MW.rotation;
        if (!home_W) home_W = table.transpose() * miss;
        worst_mm = std::max(worst_mm, (miss - table * *home_W).norm());
    }
    return um_from_mm(worst_mm);
}

}  // namespace

TrueTip true_tip(const setup::Setup& setup, const BallbarLayout& layout,
                 const emulator::EffectModels& effects, const emulator::Compensation& compensate) {
    const emulator::Observer observer(setup, effects);
    const kinematics::Machine nominal = nominal_of(setup);
    const auto largest_um = [&](const Vector3& tip_S_mm, const emulator::Contact& contact) {
        std::optional<Vector3> home_W;
        double worst_mm = 0.0;
        for (const AxisPositions& pose : judged_poses(nominal, layout)) {
            AxisSample sample;
            sample.position = compensate(aimed(nominal, pose, layout.pivot_W_mm, layout.cup_S_mm));
            sample.travel.fill(1);
            const Vector3 at_W = emulator::physical_tip_W(observer.at(sample, contact), tip_S_mm);
            if (!home_W) home_W = at_W;
            worst_mm = std::max(worst_mm, (at_W - *home_W).norm());
        }
        return um_from_mm(worst_mm);
    };
    emulator::Contact cup;  // effects of the tool length act on it
    cup.tip = true;
    return {largest_um(layout.cup_S_mm, {}), largest_um(setup.ballbar->cup_S_mm, cup)};
}

std::optional<SphereCheck> check_by_sphere(const setup::Setup& setup, const BallbarLayout& layout,
                                           const emulator::EffectModels& effects,
                                           const emulator::Compensation& compensate) {
    const setup::Artefact* sphere = sphere_of(setup);
    if (!sphere || !setup.probe) return std::nullopt;
    const emulator::Compensation none = [](const AxisPositions& q) { return q; };
    SphereCheck check;
    check.poses = static_cast<int>(judged_poses(setup.machine, layout).size());
    check.before_um = largest_miss_um(setup, layout, *sphere, effects, none);
    check.after_um = largest_miss_um(setup, layout, *sphere, effects, compensate);
    return check;
}

}  // namespace trunnion::ballbar::test
