#include "analysis/tip_corrector.h"

#include "emulator/trace.h"
#include "geometry/alarm.h"
#include "kinematics/jacobian.h"

namespace trunnion {

TipCorrector::TipCorrector(const Setup& setup, const EffectModels& effects)
    : nominal_(setup.machine), machine_(setup.machine, effects) {
    nominal_.errors = {};
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
        if (!nominal_.chain.find(axis))
            throw InputError("compensation needs the axes X, Y and Z", {setup.path, 0, 0});
}

Vector3 TipCorrector::meant_W(const AxisMove& move, double s) const {
    return believed_tool(move, move.at(s)).tip_W_mm;
}

Vector3 TipCorrector::true_W(const PathSampler& path, double s, const AxisPositions& q) const {
    AxisSample sample = path.at(s);
    sample.position = q;
    return physical_tip_W(machine_.at(sample, {}), -path.move.tool_vector_mm);
}

AxisPositions TipCorrector::corrected(const PathSampler& path, double s) const {
    AxisPositions q = path.move.at(s);
    const Vector3 meant = meant_W(path.move, s);
    // Axes X Y Z are the first three; the nominal machine is near enough: each step leaves 1e-4.
    const Matrix3 by_axis = tip_jacobian(nominal_, q, -path.move.tool_vector_mm).axis.leftCols<3>();
    const Matrix3 solve = by_axis.inverse();
    for (int i = 0; i < 6; ++i) {
        const Vector3 off = true_W(path, s, q) - meant;
        if (off.norm() < 1e-10) break;
        const Vector3 step = solve * off;
        for (std::size_t k = 0; k < 3; ++k) q.value[k] -= step[static_cast<Eigen::Index>(k)];
    }
    return q;
}

}  // namespace trunnion
