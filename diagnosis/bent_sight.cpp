#include "diagnosis/bent_sight.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/rules/rules.h"
#include "diagnosis/same_work.h"
#include "estimation/distributions.h"

namespace trunnion::diagnosis {
namespace {

using effects::EffectKind;

constexpr double least_sine = 0.0523;  ///< of the elevation: 3 deg, below there is no cotangent

/// True for a mount: nothing but rotary axes, and the targets, which stand for the line of sight,
/// on the last of them.
bool is_telescope(const setup::Setup& setup) {
    constexpr double on_axis_mm = 1e-6;
    if (!setup::is_arm(setup.machine.chain)) return false;
    const Vector3 last_mm = setup.machine.chain.tool.back().point_mm;
    return std::all_of(setup.artefacts.begin(), setup.artefacts.end(), [&](const auto& target) {
        return target.tool_S_mm && (setup.target_S_mm(target) - last_mm).norm() <= on_axis_mm;
    });
}

std::optional<std::size_t> droop_of(const Outcome& f) {
    for (std::size_t k = 0; k < f.design.groups().size(); ++k) {
        const ColumnGroup& group = f.design.group(k);
        if (group.kind == GroupKind::textbook && group.effect->kind == EffectKind::chain_flexure &&
            !group.is_change())
            return k;
    }
    return {};
}

/// Sine of the elevation of the line of sight at a device row: the droop tilts it by the cosine.
double sine_of_elevation(const Outcome& f, const effects::Effect& droop, std::size_t row) {
    kinematics::Perturbation tilt;
    const double one[] = {1.0};
    droop.add(f.prepared.replay.sample(row), f.prepared.replay.contact(row), one, tilt);
    double cosine = 0.0;
    for (const auto& motion : tilt.motion) cosine = std::max(cosine, motion.tilt_rad.norm());
    return std::sqrt(std::max(least_sine * least_sine, 1.0 - cosine * cosine));
}

/// Droop (the first column) and refraction, whitened.
Eigen::MatrixXd bendings(const Outcome& f, std::size_t droop) {
    const effects::Effect* effect =
        effects::find_effect(f.prepared.catalogue, f.design.group(droop).name);
    const Eigen::MatrixXd& own = f.design.columns(droop);
    Eigen::MatrixXd both(own.rows(), 2);
    both.col(0) = both.col(1) = own.col(0);
    for (std::size_t i = 0; i < f.used.size(); ++i)
        both(static_cast<Eigen::Index>(i), 1) /= sine_of_elevation(f, *effect, i);
    return both;
}

/// True for the error of the axis that carries the line of sight.
bool is_of_last_axis(const Prepared& p, const ColumnGroup& group) {
    std::optional<Axis> last;
    for (const kinematics::AxisGeometry& axis : p.base.setup.machine.chain.tool)
        if (axis.rotary) last = axis.axis;
    if (!is_cause(group.kind) || group.is_change()) return false;
    const std::optional<Axis> own = group.effect ? group.effect->axis : group.table.axis.axis;
    return motion_of(group) == EffectKind::positioning && own == last;
}

/// Squares that columns, fitted freely, leave of the readings.
double left_of_readings(const Outcome& f, const Eigen::MatrixXd& columns) {
    const Eigen::VectorXd y = f.design.projection().beside(f.design.data());
    return (y - columns * Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(columns).solve(y))
        .squaredNorm();
}

/// True where the readings are explained as well by the air as by the droop, or better.
bool may_be_air(const Outcome& f, std::size_t position, const Eigen::MatrixXd& bent) {
    const double nu = f.model.variances.nu;
    const double lost = left_of_readings(f, named_beside(f, position, bent.rightCols(1))) -
                        left_of_readings(f, named_beside(f, position, bent.leftCols(1)));
    return lost < 0.0 ||
           estimation::chi_squared_tail(lost / (nu * nu), 1.0) > rules::chance_of_difference;
}

bool has_air(const std::vector<std::string>& rivals) {
    return std::find(rivals.begin(), rivals.end(), refraction) != rivals.end();
}

}  // namespace

void doubt_bent_sight(const Outcome& f, std::vector<Claim>& claims) {
    const std::optional<std::size_t> droop = droop_of(f);
    if (!droop || claims.empty() || !is_telescope(f.prepared.base.setup) ||
        !records::only_angles(f.prepared.table))
        return;
    const Eigen::MatrixXd bent = bendings(f, *droop);
    const Eigen::MatrixXd parts = contributions(f.design, f.model, fit_of(f.design, f.model));
    for (Claim& claim : claims) {
        const ColumnGroup& group = f.design.group(f.model.members[claim.position]);
        const bool droops = group.effect && group.effect->kind == EffectKind::chain_flexure;
        if (!droops && !is_of_last_axis(f.prepared, group)) continue;
        const Eigen::MatrixXd beside =
            named_beside(f, claim.position, droops ? bent.rightCols(1) : bent);
        const bool same = do_the_same(f, parts.col(static_cast<Eigen::Index>(claim.position)),
                                      beside, static_cast<double>(group.columns()));
        if (!same && !(droops && may_be_air(f, claim.position, bent))) continue;
        claim.probability = std::min(claim.probability, rules::claimed);
        if (!droops) add_rival(f.design.group(*droop).name, claim);
        add_rival(refraction, claim);
    }
}

void tell_bent_sight(std::vector<Cause>& causes) {
    for (Cause& cause : causes)
        if (has_air(cause.rivals))
            cause.what +=
                ". Or the line of sight bends: refraction that was not taken off the readings goes "
                "with the cotangent of the elevation, the droop of a tube with its cosine. These "
                "places cannot tell them apart: the axis against a reference of its own "
                "(autocollimator, level) would";
}

}  // namespace trunnion::diagnosis
