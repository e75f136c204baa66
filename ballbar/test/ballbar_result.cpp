#include "ballbar/test/ballbar_result.h"

#include <cmath>

namespace trunnion::ballbar::test {

std::vector<NamedError> lines_at_intersection(const kinematics::Machine& nominal,
                                              const kinematics::Machine& machine) {
    const auto [first, second] = axis_lines(machine);
    return intersection_errors(first, second, nominal);
}

kinematics::Machine machine_of(const kinematics::Machine& nominal, const BallbarFit& fit) {
    kinematics::Machine machine = nominal;
    for (std::size_t k = 0; k < fit.parameters.size(); ++k)
        if (fit.parameters[k].kind == BallbarParameter::Kind::location)
            machine.errors.location(fit.parameters[k].error) +=
                fit.value(static_cast<Eigen::Index>(k));
    return machine;
}

std::vector<ErrorEstimate> chain_estimates(const BallbarFit& fit, double reading_sigma_mm) {
    std::vector<ErrorEstimate> out;
    for (std::size_t i = 0; i < fit.parameters.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        if (fit.parameters[i].kind == BallbarParameter::Kind::location)
            out.push_back({fit.parameters[i].error, fit.value(k),
                           reading_sigma_mm * std::sqrt(fit.cofactor(k, k))});
    }
    return out;
}

std::vector<ErrorEstimate> intersection_estimates(const kinematics::Machine& nominal,
                                                  const BallbarFit& fit, double reading_sigma_mm) {
    const auto lines_of = [&](const BallbarFit& f) {
        return lines_at_intersection(nominal, machine_of(nominal, f));
    };
    const std::vector<NamedError> value = lines_of(fit);
    Eigen::MatrixXd slope =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(value.size()), fit.value.size());
    const double step = 1e-5;  // mm or rad, small enough because the map is smooth
    for (Eigen::Index k = 0; k < fit.value.size(); ++k) {
        BallbarFit up = fit, down = fit;
        up.value(k) += step;
        down.value(k) -= step;
        const auto high = lines_of(up), low = lines_of(down);
        for (std::size_t i = 0; i < value.size(); ++i)
            slope(static_cast<Eigen::Index>(i), k) = (high[i].value - low[i].value) / (2.0 * step);
    }
    const Eigen::MatrixXd cofactor = slope * fit.cofactor * slope.transpose();
    std::vector<ErrorEstimate> out;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const auto k = static_cast<Eigen::Index>(i);
        out.push_back(
            {value[i].name, value[i].value, reading_sigma_mm * std::sqrt(cofactor(k, k))});
    }
    return out;
}

AxisPositions compensated(const AxisPositions& programmed, const kinematics::Machine& nominal,
                          const kinematics::Machine& known, const Vector3& cup_S_mm) {
    const Vector3 wanted_W = nominal.tip_W(programmed, cup_S_mm);
    AxisPositions q = programmed;
    // The linear axes are nearly orthogonal: each iteration reduces the remainder by the factor of
    // their squareness error.
    for (int i = 0; i < 6; ++i) {
        const kinematics::MachinePose pose = known.poses(q);
        const Vector3 missing = pose.pose_MW * wanted_W - pose.pose_MS * cup_S_mm;
        q[Axis::X] += missing.x();
        q[Axis::Y] += missing.y();
        q[Axis::Z] += missing.z();
        if (missing.norm() < 1e-12) break;
    }
    return q;
}

}  // namespace trunnion::ballbar::test
