#include "ballbar/test/ballbar_proof.h"

#include <algorithm>
#include <cmath>

#include "ballbar/test/ballbar_evaluation.h"
#include "base/units.h"
#include "emulator/replay.h"

namespace trunnion::ballbar::test {

namespace {

/// Rotary angles over which compensation is judged: every 30 degrees of the tested ranges.
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
    kinematics::Machine nominal = setup.machine;
    nominal.errors = {};
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

/// Largest found minus expected centre; what was found at home is taken along with the table.
double largest_miss_um(const setup::Setup& setup, const BallbarLayout& layout,
                       const setup::Artefact& sphere, const emulator::EffectModels& effects,
                       const emulator::Compensation& compensate) {
    const records::ReadingTable found =
        emulator::predicted(setup, sphere_rows(setup, layout, sphere, compensate), effects);
    kinematics::Machine nominal = setup.machine;
    nominal.errors = {};
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

double true_tip_um(const setup::Setup& setup, const BallbarLayout& layout,
                   const emulator::Compensation& compensate) {
    kinematics::Machine nominal = setup.machine;
    nominal.errors = {};
    const Vector3 tip = layout.cup_S_mm;
    std::optional<Vector3> home;
    double worst_mm = 0.0;
    for (const AxisPositions& pose : judged_poses(nominal, layout)) {
        const AxisPositions q =
            compensate(aimed(nominal, pose, layout.pivot_W_mm, layout.cup_S_mm));
        const Vector3 off = setup.machine.tip_W(q, tip) - layout.pivot_W_mm;
        if (!home) home = off;
        worst_mm = std::max(worst_mm, (off - *home).norm());
    }
    return um_from_mm(worst_mm);
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
