#include "diagnosis/search/column_group.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/free_form.h"

namespace trunnion::diagnosis {

double table_unit(int direction) {
    return direction < 3 ? 5e-3 : 40e-6;
}

bool are_kindred(const TableForm& a, const TableForm& b) {
    return a.axis.axis == b.axis.axis && (a.play == nullptr) == (b.play == nullptr);
}

bool ColumnGroup::has_range() const {
    return std::any_of(parameters.begin(), parameters.end(), [&](std::size_t j) {
        const effects::EffectParameter& p = effect->parameters[j];
        return p.is_part || p.is_positive || std::isfinite(p.most);
    });
}

bool has_keys(const effects::Effect& effect) {
    return std::any_of(effect.parameters.begin(), effect.parameters.end(),
                       [](const effects::EffectParameter& p) { return p.is_key(); });
}

bool is_course_of_time(const ColumnGroup& group) {
    using enum effects::EffectKind;
    if (!group.effect) return group.of_time;
    const effects::EffectKind kind = group.effect->kind;
    return kind == thermal_drift || kind == thermal_expansion || kind == artefact_moved;
}

double log_prior_of_size(const ColumnGroup& group, double tau) {
    constexpr double usual = 1.0, usual_s = 1800.0;  // size and time constant, assumed
    if (!group.effect || group.effect->kind != effects::EffectKind::thermal_drift) return 0.0;
    double grown = 1.0;
    for (std::size_t k = 0; k < group.keys.size(); ++k) {
        const effects::EffectParameter& p = group.effect->parameters[k];
        if (p.name != "tau_s") continue;
        const double readings_s = p.grid.back() / 3.0;  // thermal_drift() looks up to there
        grown = std::max(
            grown, std::expm1(-readings_s / group.keys[k]) / std::expm1(-readings_s / usual_s));
    }
    return -std::log1p(std::pow(grown * tau / usual, 2));
}

Eigen::VectorXd ColumnGroup::feature_values(const Eigen::VectorXd& coefficients) const {
    if (shape.size() == 0) return coefficients;
    return shape * coefficients;
}

void drop_sessions(Eigen::MatrixXd& columns, const emulator::Replay& replay,
                   const std::vector<std::string>& before) {
    for (std::size_t i = 0; i < replay.size() && !before.empty(); ++i)
        if (std::find(before.begin(), before.end(), replay.sessions()[replay.session(i)]) !=
            before.end())
            columns.row(static_cast<Eigen::Index>(i)).setZero();
}

namespace {

/// What each feature of one direction has of the error at a position, those that have none left
/// out: the two places beside it, or the harmonics.
void shares_at(const TableForm& table, double q,
               std::vector<std::pair<Eigen::Index, double>>& shares) {
    shares.clear();
    if (!table.knots.empty()) {
        const auto [knot, weight] = estimation::place_between(table.knots, q);
        shares.emplace_back(knot, 1.0 - weight);
        shares.emplace_back(knot + 1, weight);
        return;
    }
    for (int n = 0; n < table.orders; ++n) {
        shares.emplace_back(2 * n, std::cos((table.first_order + n) * q));
        shares.emplace_back(2 * n + 1, std::sin((table.first_order + n) * q));
    }
}

}  // namespace

Eigen::MatrixXd table_features(const emulator::Replay& replay,
                               const std::vector<kinematics::Perturbation>& gradient,
                               const TableForm& table) {
    const Eigen::Index each = table.per_direction();
    Eigen::MatrixXd features =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(replay.size()),
                              each * static_cast<Eigen::Index>(table.directions.size()));
    Eigen::VectorXd play;
    if (table.play)
        play =
            identification::effect_column(replay, gradient, {*table.play, table.play->zeros(), 0}) *
            (table_unit(table.directions[0]) / table.play->parameters[0].typical);
    std::vector<std::pair<Eigen::Index, double>> shares;
    for (std::size_t i = 0; i < replay.size(); ++i) {
        shares_at(table, replay.sample(i).position[table.axis.axis], shares);
        const SmallMotion& motion = gradient[i].motion[index_of(table.axis.axis)];
        const auto row = static_cast<Eigen::Index>(i);
        for (std::size_t k = 0; k < table.directions.size(); ++k) {
            const int d = table.directions[k];
            const double by =
                table.play ? play(row)
                           : table_unit(d) * (d < 3 ? motion.shift_mm(d) : motion.tilt_rad(d - 3));
            const Eigen::Index at = each * static_cast<Eigen::Index>(k);
            for (const auto& [feature, share] : shares) features(row, at + feature) = by * share;
        }
    }
    return features;
}

Eigen::MatrixXd columns_on(const emulator::Replay& replay,
                           const std::vector<kinematics::Perturbation>& gradient,
                           const ColumnGroup& group) {
    if (group.kind == GroupKind::table)
        return table_features(replay, gradient, group.table) * group.shape;
    Eigen::MatrixXd columns =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(replay.size()),
                              static_cast<Eigen::Index>(group.parameters.size()));
    for (std::size_t k = 0; k < group.parameters.size(); ++k)
        columns.col(static_cast<Eigen::Index>(k)) = identification::effect_column(
            replay, gradient, {*group.effect, group.keys, group.parameters[k]});
    drop_sessions(columns, replay, group.before);
    if (group.shape.size() > 0) return columns * group.shape;
    return columns;
}

Eigen::VectorXd contribution_on(const emulator::Replay& replay,
                                const std::vector<kinematics::Perturbation>& gradient,
                                const ColumnGroup& group, const Eigen::VectorXd& coefficients) {
    if (group.kind == GroupKind::table)
        return table_features(replay, gradient, group.table) * (group.shape * coefficients);
    return columns_on(replay, gradient, group) * coefficients;
}

}  // namespace trunnion::diagnosis
