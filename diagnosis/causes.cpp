#include "diagnosis/causes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/rounded.h"
#include "base/units.h"
#include "diagnosis/beyond_command.h"
#include "diagnosis/rules/rules.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion::diagnosis {
namespace {

constexpr double unseen_part = 0.7;  ///< fraction of the prior sigma: a larger posterior sigma
                                     ///< means undetermined
constexpr std::size_t periods_listed = 4;

/// How the parameters of a group follow from the coefficients of its columns.
Eigen::MatrixXd by_column(const ColumnGroup& group) {
    return group.shape.size() > 0 ? group.shape
                                  : Eigen::MatrixXd::Identity(group.columns(), group.columns());
}

std::vector<identification::FitParameter> parameters_of(const ColumnGroup& group,
                                                        const Eigen::VectorXd& own,
                                                        const Eigen::MatrixXd& covariance,
                                                        double tau) {
    std::vector<identification::FitParameter> list;
    const std::vector<double> values = values_in(group, own);
    const Eigen::MatrixXd by = by_column(group);
    const Eigen::VectorXd sigma =
        (by * covariance * by.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
    const Eigen::VectorXd before = tau * by.rowwise().norm();
    for (std::size_t j = 0; j < group.effect->parameters.size(); ++j) {
        const effects::EffectParameter& p = group.effect->parameters[j];
        identification::FitParameter fit{
            group.effect->name, p.name,       p.unit, p.component, p.typical,
            values[j],          std::nan(""), 0.0,    0.0,         0.0};
        for (std::size_t k = 0; k < group.parameters.size(); ++k) {
            const double s = sigma(static_cast<Eigen::Index>(k));
            if (group.parameters[k] == j && s < unseen_part * before(static_cast<Eigen::Index>(k)))
                fit.sigma = s * p.typical;
        }
        list.push_back(std::move(fit));
    }
    return list;
}

/// True for an error along (of a rotary axis: about) the axis, which counts against + of M.
bool counts_against(const TableForm& table, int direction) {
    const int main = effects::main_direction(table.axis);
    return !table.play && direction == (table.axis.rotary ? main + 3 : main) &&
           table.axis.direction(main) < 0.0;
}

std::vector<TablePoint> points_of(const ColumnGroup& group, const Eigen::VectorXd& own,
                                  const Eigen::MatrixXd& covariance) {
    const TableForm& table = group.table;
    const Eigen::VectorXd value = table_values(group, own);
    const Eigen::VectorXd sigma =
        (group.shape * covariance * group.shape.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
    const Eigen::Index each = table.per_direction();
    std::vector<TablePoint> points;
    for (std::size_t k = 0; k < table.directions.size(); ++k)
        for (Eigen::Index j = 0; j < each && !table.knots.empty(); ++j) {
            const int d = table.directions[k];
            const Eigen::Index at = static_cast<Eigen::Index>(k) * each + j;
            TablePoint point{table.play ? "gap" : effects::motion_name(d, table.axis),
                             table.knots[static_cast<std::size_t>(j)],
                             value(at),
                             sigma(at) * table_unit(d),
                             table.axis.rotary ? "rad" : "mm",
                             d < 3 ? "mm" : "rad",
                             counts_against(table, d)};
            points.push_back(std::move(point));
        }
    // Points of a whole turn, from its harmonics: three a period of the highest order.
    const int places = std::max(36, 3 * (table.first_order + table.orders - 1));
    for (std::size_t k = 0; k < table.directions.size() && table.knots.empty(); ++k)
        for (int j = 0; j < places; ++j) {
            const double q = 2.0 * pi * j / places;
            Eigen::VectorXd wave = Eigen::VectorXd::Zero(value.size());
            for (int n = 0; n < table.orders; ++n) {
                const Eigen::Index at = static_cast<Eigen::Index>(k) * each + 2 * n;
                wave(at) = std::cos((table.first_order + n) * q);
                wave(at + 1) = std::sin((table.first_order + n) * q);
            }
            const int d = table.directions[k];
            const Eigen::VectorXd by = group.shape.transpose() * wave;
            const double own_sigma =
                table_unit(d) * std::sqrt(std::max(0.0, by.dot(covariance * by)));
            points.push_back({table.play ? "gap" : effects::motion_name(d, table.axis), q,
                              wave.dot(value), own_sigma, "rad", d < 3 ? "mm" : "rad",
                              counts_against(table, d)});
        }
    return points;
}

/// The order of an angular error of a rotary axis that is one harmonic of the turn; else empty.
std::optional<int> single_order(const ColumnGroup& group) {
    const TableForm& table = group.table;
    if (table.motion != effects::EffectKind::positioning || !table.knots.empty() ||
        table.directions.size() != 1 || group.shape.cols() != 2)
        return std::nullopt;
    for (int n = 0; n < table.orders; ++n)
        if (!group.shape.middleRows(2 * n, 2).isZero()) return table.first_order + n;
    return std::nullopt;
}

/// One harmonic is an error with a name: its cosine and sine as in R.positioning, its size and
/// where it is largest in words.
void tell_order(const ColumnGroup& group, int order, const Eigen::VectorXd& own,
                const Eigen::MatrixXd& covariance, Cause& cause) {
    const TableForm& table = group.table;
    const int direction = table.directions.front();
    const double sign = counts_against(table, direction) ? -1.0 : 1.0;
    const Eigen::Index at = 2 * (order - table.first_order);
    const Eigen::Vector2d wave = sign * table_values(group, own).segment<2>(at);
    const Eigen::MatrixXd by = group.shape.middleRows(at, 2);
    const Eigen::Vector2d sigma =
        table_unit(direction) * (by * covariance * by.transpose()).diagonal().cwiseSqrt();
    for (const int k : {0, 1})
        cause.parameters.push_back({cause.effect, fmt::format("{}{}_rad", k ? "sin" : "cos", order),
                                    "rad", -1, table_unit(direction), wave(k), sigma(k)});
    const double largest_deg = deg_from_rad(std::atan2(wave(1), wave(0))) / order;
    cause.what = fmt::format(
        "An error of the angle of order {}, {} periods in a turn: amplitude {} µrad, largest at {} "
        "deg and every {} deg from there",
        order, order, three_digits(urad_from_rad(wave.norm())), three_digits(largest_deg),
        three_digits(360.0 / order));
    cause.usual_cause =
        "that many poles, lobes or supports on the turn: poles of a resolver, clamping or bearing "
        "of the encoder";
    cause.remedy = "mount or adjust the encoder anew, or compensate the harmonic";
}

/// The periods that these positions cannot tell from the one that is named.
std::string other_periods(const std::vector<double>& keys) {
    std::string text;
    for (std::size_t k = 0; k < std::min(keys.size(), periods_listed); ++k)
        text += fmt::format("{}{:.4g}", k == 0 ? ". At these positions the same: " : ", ", keys[k]);
    return keys.size() > periods_listed ? text + " and shorter ones" : text;
}

/// True for a parameter of an effect that some form of it contains, and that moves readings.
bool is_seen_in_a_form(const Design& design, const ColumnGroup& group, std::size_t parameter) {
    return std::any_of(design.groups().begin(), design.groups().end(), [&](const auto& entry) {
        const ColumnGroup& form = entry.group;
        if (form.effect != group.effect || form.since != group.since) return false;
        const auto at = std::find(form.parameters.begin(), form.parameters.end(), parameter);
        const auto k = at - form.parameters.begin();
        return at != form.parameters.end() && (form.shape.size() > 0 || entry.gram(k, k) > 0.0);
    });
}

}  // namespace

std::vector<identification::Inseparable> unseen_of(const Design& design, std::size_t member) {
    std::vector<identification::Inseparable> groups;
    const Design::Entry& entry = design.groups()[member];
    const ColumnGroup& group = entry.group;
    const auto& list = group.effect->parameters;
    const auto name = [&](std::size_t j) {
        return identification::full_name(
            {group.effect->name, list[j].name, list[j].unit, list[j].component, 1.0, 0.0});
    };
    for (std::size_t j = 0; j < list.size(); ++j)
        if (!list[j].is_key() && list[j].usual &&
            std::find(group.parameters.begin(), group.parameters.end(), j) ==
                group.parameters.end() &&
            !is_seen_in_a_form(design, group, j))
            groups.push_back({{name(j)}, {1.0}});
    const estimation::LinearFit fit =
        estimation::solve_ranked(entry.gram, Eigen::VectorXd::Zero(entry.gram.rows()));
    for (const Eigen::VectorXd& columns : fit.null_space) {
        const Eigen::VectorXd v = group.feature_values(columns);
        identification::Inseparable unseen;
        for (Eigen::Index k = 0; k < v.size(); ++k)
            if (v(k) != 0.0) {
                unseen.names.push_back(name(group.parameters[static_cast<std::size_t>(k)]));
                unseen.direction.push_back(v(k));
            }
        groups.push_back(std::move(unseen));
    }
    return groups;
}

Cause cause_of(const FoundModel& f, const Claim& claim) {
    const std::size_t member = f.model.members[claim.position];
    const ColumnGroup& group = f.design.group(member);
    const Eigen::Index first = f.solution.first[claim.position];
    const Eigen::Index count = f.solution.size[claim.position];
    const Eigen::VectorXd own = f.solution.mean.segment(first, count);
    const Eigen::MatrixXd spread = f.covariance.block(first, first, count, count);
    Cause cause;
    cause.effect = claim.name;
    cause.probability = claim.probability;
    cause.rivals = claim.rivals;
    cause.share = claim.share;
    cause.rms_sigma = claim.rms;
    if (group.effect) {
        cause.effect = group.effect->name;
        cause.since = group.since;
        cause.parameters = parameters_of(group, own, spread, f.model.variances.tau[claim.position]);
        cause.unseen = unseen_of(f.design, member);
        cause.what = group.effect->what + other_periods(f.judgement.equal_periods[claim.position]);
        cause.holds_between = f.judgement.interpolates[claim.position];
        cause.usual_cause = group.effect->cause;
        cause.remedy = group.effect->remedy;
        return cause;
    }
    cause.holds_between = f.judgement.interpolates[claim.position];
    cause.beyond = beyond_command(group, own);
    if (const auto order = single_order(group)) {
        tell_order(group, *order, own, spread, cause);
        return cause;
    }
    cause.points = points_of(group, own, spread);
    if (group.table.play) {
        const bool turns = group.table.axis.rotary;
        cause.what =
            "The backlash of the axis changes along its travel; beside it, what is the same "
            "everywhere is a cause of its own";
        cause.usual_cause = turns ? "worm wheel off centre, or worn where it works most"
                                  : "screw or rack worn where it works most";
        cause.remedy = fmt::format(
            "inspect the {}; one backlash value of the control is right at one place only, pitch "
            "error tables for both directions are right at all",
            turns ? "drive" : "screw");
        return cause;
    }
    cause.what = "An error of the axis that follows its position in a form of its own";
    cause.usual_cause = "screw, scale, guide or bearing as they are; no single fault";
    cause.remedy = cause.holds_between
                       ? "enter the table as pitch or straightness compensation of the axis"
                       : "measure at places closer to each other before anything is compensated: "
                         "between these the table does not hold";
    return cause;
}

}  // namespace trunnion::diagnosis
