#include "diagnosis/beyond_command.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/solution.h"
#include "estimation/free_form.h"

namespace trunnion::diagnosis {
namespace {

/// The first place of a turn again at its end, if that is the next one in the row.
void close_turn(BeyondCommand& beyond) {
    constexpr double near = 1e-6;
    const double step =
        (beyond.at.back() - beyond.at.front()) / static_cast<double>(beyond.at.size() - 1);
    const double end = beyond.at.front() + 2.0 * pi;
    if (!beyond.rotary || std::abs(beyond.at.back() + step - end) > near) return;
    beyond.at.push_back(end);
    beyond.too_far.push_back(beyond.too_far.front());
}

bool is_whole_turn(const BeyondCommand& beyond) {
    constexpr double near = 1e-6;
    return beyond.rotary && std::abs(beyond.at.back() - beyond.at.front() - 2.0 * pi) < near;
}

/// The same of a turn within another range.
BeyondCommand within(const BeyondCommand& turn, double least, double most) {
    BeyondCommand part = turn;
    part.at = {least, most};
    for (const double q : turn.at)
        for (double k = std::floor((least - q) / (2.0 * pi)); q + k * 2.0 * pi < most; ++k)
            if (q + k * 2.0 * pi > least) part.at.push_back(q + k * 2.0 * pi);
    std::sort(part.at.begin(), part.at.end());
    part.too_far.clear();
    for (const double q : part.at) {
        const double turns = std::floor((q - turn.at.front()) / (2.0 * pi));
        part.too_far.push_back(turn(q - turns * 2.0 * pi));
    }
    return part;
}

/// Adds another one at the places of both; beside part of a turn, a whole one within that part.
void add(BeyondCommand& beyond, BeyondCommand other) {
    if (is_whole_turn(beyond) && !is_whole_turn(other))
        beyond = within(beyond, other.at.front(), other.at.back());
    else if (is_whole_turn(other) && !is_whole_turn(beyond))
        other = within(other, beyond.at.front(), beyond.at.back());
    std::vector<double> at;
    std::merge(beyond.at.begin(), beyond.at.end(), other.at.begin(), other.at.end(),
               std::back_inserter(at));
    const double near = 1e-9 * (at.back() - at.front());
    at.erase(std::unique(at.begin(), at.end(), [&](double a, double b) { return b - a <= near; }),
             at.end());
    std::vector<double> too_far;
    for (const double q : at) too_far.push_back(beyond(q) + other(q));
    beyond.at = std::move(at);
    beyond.too_far = std::move(too_far);
}

/// Adds the textbook form of the positioning of the axis; false if it is none.
bool add(BeyondCommand& beyond, const effects::Catalogue& catalogue, const Cause& cause) {
    const effects::Effect* effect = effects::find_effect(catalogue, cause.effect);
    if (!effect || !cause.points.empty() || !cause.since.empty() ||
        effect->parameters.size() != cause.parameters.size() ||
        cause.effect.substr(0, cause.effect.find('.')) != beyond.axis ||
        (effect->kind != effects::EffectKind::scale &&
         effect->kind != effects::EffectKind::positioning))
        return false;
    std::vector<double> values;
    for (const identification::FitParameter& p : cause.parameters) values.push_back(p.value);
    for (std::size_t k = 0; k < beyond.at.size(); ++k) {
        AxisSample sample;
        sample.position[*effect->axis] = beyond.at[k];
        kinematics::Perturbation out;
        effect->add(sample, {}, values, out);
        beyond.too_far[k] += out.axis[*effect->axis];
    }
    return true;
}

/// Number of places in a turn between which a control may interpolate linearly: eight in a period
/// of the highest order that counts. Orders that together make a twentieth of the rms do not.
int places_of_turn(const TableForm& table, const Eigen::VectorXd& value) {
    constexpr double uncounted = 0.05 * 0.05;
    const auto squares_from = [&](int n) { return value.tail(value.size() - 2 * n).squaredNorm(); };
    int counted = table.orders;
    while (counted > 1 && squares_from(counted - 1) <= uncounted * squares_from(0)) --counted;
    const int least = 8 * (table.first_order + counted - 1);
    for (const int places : {36, 72, 120, 180, 360})
        if (places >= least) return places;
    return 720;
}

bool tells(const Cause& cause) {
    return !cause.beyond.at.empty() && cause.holds_between;
}

/// True for a line that may be that of the form itself: whichever it is, the axis has it.
bool is_line_of(const Cause& form, const Cause& line) {
    const auto has = [](const Cause& cause, const std::string& rival) {
        return std::find(cause.rivals.begin(), cause.rivals.end(), rival) != cause.rivals.end();
    };
    return form.probability >= rules::claimed && line.points.empty() && has(form, line.effect) &&
           has(line, form.effect);
}

void add_others(const effects::Catalogue& catalogue, std::vector<Cause>& causes, Cause& first) {
    for (Cause& other : causes) {
        if (&other == &first) continue;
        if (other.probability < rules::claimed && !is_line_of(first, other)) continue;
        const bool form = tells(other) && other.beyond.axis == first.beyond.axis &&
                          first.probability >= rules::claimed;
        if (form)
            add(first.beyond, other.beyond);
        else if (!add(first.beyond, catalogue, other))
            continue;
        if (form) other.beyond = {};
        if (first.includes.find(other.effect) == std::string::npos)
            first.includes += (first.includes.empty() ? "" : ", ") + other.effect;
    }
}

}  // namespace

double BeyondCommand::operator()(double q) const {
    const auto [place, weight] = estimation::place_between(at, q);
    const auto k = static_cast<std::size_t>(place);
    return (1.0 - weight) * too_far[k] + weight * too_far[k + 1];
}

BeyondCommand beyond_command(const ColumnGroup& group, const Eigen::VectorXd& coefficients) {
    const TableForm& table = group.table;
    const int main = effects::main_direction(table.axis);
    const int along = table.axis.rotary ? main + 3 : main;
    const auto found = std::find(table.directions.begin(), table.directions.end(), along);
    if (table.play || group.kind != GroupKind::table || found == table.directions.end() ||
        table.motion != effects::EffectKind::positioning)
        return {};
    const Eigen::Index each = table.per_direction();
    const Eigen::VectorXd value =
        table.axis.direction(main) *
        table_values(group, coefficients)
            .segment(each * static_cast<Eigen::Index>(found - table.directions.begin()), each);
    BeyondCommand beyond{table.axis.name, table.axis.rotary, table.knots, {}};
    if (!table.knots.empty()) beyond.too_far.assign(value.begin(), value.end());
    const int places = table.knots.empty() ? places_of_turn(table, value) : 0;
    for (int j = 0; j < places; ++j) {
        const double q = 2.0 * pi * j / places;
        double sum = 0.0;
        for (int n = 0; n < table.orders; ++n)
            sum += value(2 * n) * std::cos((table.first_order + n) * q) +
                   value(2 * n + 1) * std::sin((table.first_order + n) * q);
        beyond.at.push_back(q);
        beyond.too_far.push_back(sum);
    }
    if (beyond.at.size() < 2) return {};
    close_turn(beyond);
    return beyond;
}

void join_of_axis(const effects::Catalogue& catalogue, std::vector<Cause>& causes) {
    for (Cause& cause : causes)
        if (tells(cause)) add_others(catalogue, causes, cause);
}

}  // namespace trunnion::diagnosis
