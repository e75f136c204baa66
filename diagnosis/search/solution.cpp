#include "diagnosis/search/solution.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/prepare/places.h"
#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

kinematics::ErrorCurve::Harmonic& harmonic_of(kinematics::ErrorCurve& curve, double order) {
    for (kinematics::ErrorCurve::Harmonic& h : curve.harmonics)
        if (h.order == order) return h;
    return curve.harmonics.emplace_back(kinematics::ErrorCurve::Harmonic{order, 0.0, 0.0});
}

/// The table of a curve, without its harmonics and slope.
kinematics::ErrorCurve table_of(const kinematics::ErrorCurve& curve) {
    kinematics::ErrorCurve table;
    table.at = curve.at;
    table.value = curve.value;
    table.interpolation = curve.interpolation;
    return table;
}

/// The sum of two tables has the positions of both.
void add_table(kinematics::ErrorCurve& curve, const std::vector<double>& at,
               const Eigen::VectorXd& value) {
    const kinematics::ErrorCurve old = table_of(curve);
    kinematics::ErrorCurve own;
    own.at = at;
    own.value.assign(value.begin(), value.end());
    std::vector<double> places = at;
    places.insert(places.end(), old.at.begin(), old.at.end());
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    curve.at = places;
    curve.value.clear();
    for (const double q : places) curve.value.push_back(own(q) + (old.at.empty() ? 0.0 : old(q)));
}

/// A table that holds at its positions alone. A curve that holds between its own ones has values at
/// these positions then, too.
void add_places(kinematics::ErrorCurve& curve, const std::vector<double>& at,
                const Eigen::VectorXd& value) {
    constexpr double same = 1e-6;  // of the range
    const double near = same * (at.back() - at.front());
    const kinematics::ErrorCurve old = table_of(curve);
    const bool is_curve =
        !old.at.empty() && old.interpolation != kinematics::ErrorCurve::Interpolation::none;
    std::map<double, double> places;
    if (!is_curve)
        for (std::size_t k = 0; k < old.at.size(); ++k) places[old.at[k]] = old.value[k];
    for (std::size_t k = 0; k < at.size(); ++k) {
        const auto place = places.lower_bound(at[k] - near);
        const bool meets = place != places.end() && place->first <= at[k] + near;
        (meets ? place->second : places[at[k]]) +=
            value(static_cast<Eigen::Index>(k)) + (is_curve ? old(at[k]) : 0.0);
    }
    curve.at.clear();
    curve.value.clear();
    for (const auto& [q, too_far] : places) {
        curve.at.push_back(q);
        curve.value.push_back(too_far);
    }
    curve.interpolation = kinematics::ErrorCurve::Interpolation::none;
}

/// A ripple as its values at the places that were read: its other periods have the
/// same there.
void add_ripple_at_places(setup::Setup& setup, const Prepared& prepared, const ColumnGroup& group,
                          const std::vector<double>& values) {
    const kinematics::AxisGeometry& axis = *setup.machine.chain.find(*group.effect->axis);
    const int along = effects::main_direction(axis);
    const std::vector<double> at = positions_at(telling_places(prepared, axis.axis));
    Eigen::VectorXd too_far(static_cast<Eigen::Index>(at.size()));
    for (std::size_t k = 0; k < at.size(); ++k) {
        AxisSample sample;
        sample.position[axis.axis] = at[k];
        kinematics::Perturbation out;
        group.effect->add(sample, {}, values, out);
        too_far(static_cast<Eigen::Index>(k)) = axis.direction(along) * out.axis[axis.axis];
    }
    const auto motion = static_cast<std::size_t>(along + (axis.rotary ? 3 : 0));
    add_places(setup.machine.errors.axis[index_of(axis.axis)].motion[motion], at, too_far);
}

void add_free_form(setup::Setup& setup, const ColumnGroup& group,
                   const Eigen::VectorXd& coefficients, bool at_places) {
    const auto add_knots = at_places ? add_places : add_table;
    const Eigen::VectorXd value = table_values(group, coefficients);
    const Eigen::Index each = group.table.per_direction();
    auto& motion = setup.machine.errors.axis[index_of(group.table.axis.axis)].motion;
    for (std::size_t k = 0; k < group.table.directions.size(); ++k) {
        kinematics::ErrorCurve& curve =
            group.table.play ? setup.gap[index_of(group.table.axis.axis)]
                             : motion[static_cast<std::size_t>(group.table.directions[k])];
        const Eigen::VectorXd own = value.segment(static_cast<Eigen::Index>(k) * each, each);
        if (!group.table.knots.empty()) {
            add_knots(curve, group.table.knots, own);
            continue;
        }
        for (int n = 0; n < group.table.orders; ++n) {
            kinematics::ErrorCurve::Harmonic& h = harmonic_of(curve, group.table.first_order + n);
            h.cosine += own(2 * n);
            h.sine += own(2 * n + 1);
        }
    }
}

/// Harmonics and slope of the angle of a rotary axis as an error motion, which acts about + axes of
/// M: `values` of the textbook effect, which acts about the direction of the axis.
void add_angle(setup::Setup& setup, const kinematics::AxisGeometry& axis,
               const std::vector<double>& values) {
    const int along = effects::main_direction(axis);
    kinematics::ErrorCurve& curve =
        setup.machine.errors.axis[index_of(axis.axis)].motion[static_cast<std::size_t>(3 + along)];
    const double sign = axis.direction(along) > 0.0 ? 1.0 : -1.0;
    for (std::size_t n = 0; 2 * n + 1 < values.size(); ++n) {
        kinematics::ErrorCurve::Harmonic& h = harmonic_of(curve, static_cast<double>(n + 1));
        h.cosine += sign * values[2 * n];
        h.sine += sign * values[2 * n + 1];
    }
    if (values.size() % 2 == 1) curve.slope += sign * values.back();
}

/// True for the textbook positioning of a rotary axis beside its table. An effect moves the axis,
/// and a table is that of where it stands: in one curve large errors add up, as they were fitted.
bool joins_table(const Design& design, const Model& model, const ColumnGroup& group) {
    if (group.effect->kind != effects::EffectKind::positioning) return false;
    return std::any_of(model.members.begin(), model.members.end(), [&](std::size_t m) {
        const TableForm& table = design.group(m).table;
        return design.group(m).kind == GroupKind::table &&
               table.motion == effects::EffectKind::positioning &&
               table.axis.axis == group.effect->axis &&
               std::abs(table.axis.direction(effects::main_direction(table.axis))) > 1.0 - 1e-12;
    });
}

}  // namespace

Eigen::VectorXd Solution::spread(const Eigen::VectorXd& z) const {
    return factor.triangularView<Eigen::Lower>().transpose().solve(z);
}

Eigen::MatrixXd Solution::covariance() const {
    const Eigen::MatrixXd half = factor.triangularView<Eigen::Lower>().solve(
        Eigen::MatrixXd::Identity(factor.rows(), factor.cols()));
    return half.transpose() * half;
}

namespace {

/// How far the zeros of a laser or an angle sensor may be off beside errors of many times the usual
/// size, which have a mean of their own, and beside zeros of cycles, whose mean is that of the
/// set-up: in their size. Of other devices 1: what they hardly see of a set-up stays.
double enormous_size(const Design& design, const Model& model) {
    double most = 1.0;
    const auto& groups = design.groups();
    if (std::none_of(groups.begin(), groups.end(), [](const auto& g) { return g.group.of_cycles; }))
        return most;
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const double tau = model.variances.tau[k];
        const bool zero = design.group(model.members[k]).kind == GroupKind::offset;
        if (zero || tau > rules::enormous) most = std::max(most, tau);
    }
    return most;
}

}  // namespace

Solution solved(Design& design, const Model& model) {
    Solution s;
    s.known = design.known().cols();
    Design::Normal normal = design.normal(model.members);
    Eigen::VectorXd precision(normal.product.size());
    const double range = rules::set_up_range * enormous_size(design, model);
    precision.head(s.known).setConstant(1.0 / (range * range));
    Eigen::Index count = s.known;
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        s.first.push_back(count);
        s.size.push_back(design.group(model.members[k]).columns());
        const double tau = std::max(1e-9, model.variances.tau[k]);
        precision.segment(count, s.size[k]).setConstant(1.0 / (tau * tau));
        count += s.size[k];
    }
    const double noise = model.variances.nu * model.variances.nu;
    normal.gram /= noise;
    normal.gram.diagonal() += precision;
    const Eigen::LLT<Eigen::MatrixXd> llt(normal.gram);
    s.mean = llt.solve(normal.product / noise);
    s.factor = llt.matrixL();
    return s;
}

Solution without_changes(const Design& design, const Model& model, Solution solution) {
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (design.group(model.members[k]).is_change())
            solution.mean.segment(solution.first[k], solution.size[k]).setZero();
    return solution;
}

Eigen::VectorXd left_mm(const Prepared& prepared, const Design& design, const Model& model,
                        const Solution& solution) {
    Eigen::VectorXd left =
        prepared.base.residual_mm - prepared.base.columns * solution.mean.head(solution.known);
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (const ColumnGroup& group = design.group(model.members[k]); is_cause(group.kind))
            left -= contribution_on(prepared.replay, prepared.base.gradient, group,
                                    solution.mean.segment(solution.first[k], solution.size[k]));
    return left;
}

std::vector<double> values_in(const ColumnGroup& group, const Eigen::VectorXd& coefficients) {
    std::vector<double> values = group.keys;
    const Eigen::VectorXd feature = group.feature_values(coefficients);
    for (std::size_t k = 0; k < group.parameters.size(); ++k)
        values[group.parameters[k]] = feature(static_cast<Eigen::Index>(k)) *
                                      group.effect->parameters[group.parameters[k]].typical;
    return values;
}

Eigen::VectorXd table_values(const ColumnGroup& group, const Eigen::VectorXd& coefficients) {
    Eigen::VectorXd value = group.shape * coefficients;
    const Eigen::Index each = group.table.per_direction();
    for (std::size_t k = 0; k < group.table.directions.size(); ++k)
        value.segment(static_cast<Eigen::Index>(k) * each, each) *=
            table_unit(group.table.directions[k]);
    return value;
}

namespace {

/// 2 for s^2 and 3 for s^3, the lags of higher order: these grow with a power of the time constant.
double power_of_time(const ColumnGroup& group, Eigen::Index feature) {
    const auto j = static_cast<std::size_t>(feature);
    if (!group.effect || j >= group.parameters.size()) return 1.0;
    const std::string& unit = group.effect->parameters[group.parameters[j]].unit;
    return unit == "s^2" ? 2.0 : unit == "s^3" ? 3.0 : 1.0;
}

}  // namespace

std::vector<double> usual_sizes(Design& design, const Model& model) {
    const Fit fit = fit_of(design, model);
    std::vector<double> sizes;
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const ColumnGroup& group = design.group(model.members[k]);
        const Eigen::VectorXd value =
            group.feature_values(fit.mean.segment(fit.first[k], fit.size[k]));
        double size = 0.0;
        for (Eigen::Index j = 0; j < value.size(); ++j)
            size = std::max(size, std::pow(std::abs(value(j)), 1.0 / power_of_time(group, j)));
        sizes.push_back(size);
    }
    return sizes;
}

setup::Setup setup_with(const Prepared& prepared, const Design& design, const Model& model,
                        const Solution& solution, const std::vector<bool>& at_places) {
    setup::Setup setup = prepared.base.setup;
    identification::shift_base(setup, prepared.base, prepared.catalogue,
                               solution.mean.head(solution.known));
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const ColumnGroup& group = design.group(model.members[k]);
        const Eigen::VectorXd own = solution.mean.segment(solution.first[k], solution.size[k]);
        const bool here_only = !at_places.empty() && at_places[k];
        if (group.kind == GroupKind::table)
            add_free_form(setup, group, own, here_only);
        else if (here_only)
            continue;  // after the curves
        else if (group.effect && joins_table(design, model, group))
            add_angle(setup, *setup.machine.chain.find(*group.effect->axis), values_in(group, own));
        else if (group.effect)
            identification::add_effect(setup, *group.effect, values_in(group, own));
    }
    for (std::size_t k = 0; k < at_places.size(); ++k)
        if (const ColumnGroup& group = design.group(model.members[k]);
            at_places[k] && group.kind != GroupKind::table)
            add_ripple_at_places(
                setup, prepared, group,
                values_in(group, solution.mean.segment(solution.first[k], solution.size[k])));
    identification::keep_sessions(setup, prepared.replay);
    return setup;
}

Eigen::VectorXd set_up_left_mm(const Prepared& prepared, Design& design) {
    const Model none{{}, {}, 0.0};
    return left_mm(prepared, design, none, solved(design, none));
}

Model computable(Design& design, const SearchSetting& setting, Model model) {
    const auto sound = [&] {
        const Solution solution = solved(design, model);
        return solution.mean.allFinite() && solution.covariance().allFinite() &&
               std::isfinite(evidence(design, model));
    };
    while (!model.members.empty() && !sound()) model = without(model, model.members.size() - 1);
    return model.members.empty() ? empty_model(design, setting) : model;
}

}  // namespace trunnion::diagnosis
