#include "diagnosis/changes.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "diagnosis/rules/rules.h"
#include "effects/settings.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion::diagnosis {
namespace {

using Values = std::vector<double>;

/// True when the model contains a change of some of the group's parameters from the same session
/// on.
bool told_already(const Outcome& f, const ColumnGroup& group) {
    return std::any_of(f.model.members.begin(), f.model.members.end(), [&](std::size_t m) {
        const ColumnGroup& other = f.design.group(m);
        return other.since == group.since && other.effect == group.effect &&
               std::find_first_of(other.parameters.begin(), other.parameters.end(),
                                  group.parameters.begin(),
                                  group.parameters.end()) != other.parameters.end();
    });
}

/// True for effects of the simulation, and for causes of all sessions.
bool of_interest(const Outcome& f, const effects::Effect& effect) {
    return modelled(f.prepared, effect) || effect.kind == effects::EffectKind::location ||
           std::any_of(f.model.members.begin(), f.model.members.end(), [&](std::size_t m) {
               return f.design.group(m).effect == &effect && !f.design.group(m).is_change();
           });
}

/// Of the forms of a change the whole effect; of the location that of each axis.
bool right_form(const Outcome& f, const ColumnGroup& group) {
    if (group.effect->kind == effects::EffectKind::location) {
        const auto axis_of = [&](std::size_t j) {
            return group.effect->parameters[j].location->axis;
        };
        return std::all_of(group.parameters.begin(), group.parameters.end(), [&](std::size_t j) {
            return axis_of(j) == axis_of(group.parameters.front());
        });
    }
    return std::none_of(
        f.design.groups().begin(), f.design.groups().end(), [&](const Design::Entry& other) {
            return other.group.effect == group.effect && other.group.since == group.since &&
                   other.group.columns() > group.columns();
        });
}

void add(std::vector<SessionChange>& list, const ColumnGroup& group, const Eigen::VectorXd& value,
         const Eigen::VectorXd& sigma, double probability) {
    for (std::size_t k = 0; k < group.parameters.size(); ++k) {
        const effects::EffectParameter& p = group.effect->parameters[group.parameters[k]];
        const auto at = static_cast<Eigen::Index>(k);
        SessionChange change;
        change.parameter = {group.effect->name,   p.name,    p.unit,
                            p.component,          p.typical, p.typical * value(at),
                            p.typical * sigma(at)};
        change.parameter.location = p.location;
        change.since = group.since;
        change.probability = probability;
        change.claimed = probability >= rules::claimed;
        list.push_back(std::move(change));
    }
}

/// The value of the parameter in a setup, in its unit.
double value_in(const setup::Setup& setup, const effects::Catalogue& catalogue,
                const identification::FitParameter& p) {
    if (p.location) return setup.machine.errors.location(*p.location);
    const effects::Effect& effect = *effects::find_effect(catalogue, p.effect);
    for (const setup::EffectSetting& setting : setup.effects) {
        if (setting.name != p.effect) continue;
        const Values values = effects::values_of(effect, setting);
        for (std::size_t j = 0; j < values.size(); ++j)
            if (effect.parameters[j].name == p.name &&
                effect.parameters[j].component == p.component)
                return values[j];
    }
    return 0.0;
}

/// Each change starts from the sum of the model's earlier ones.
void add_befores(const Outcome& f, const Solution& solution, std::vector<SessionChange>& list) {
    const setup::Setup first =
        setup_with(f.prepared, f.design, f.model, without_changes(f.design, f.model, solution));
    const auto& sessions = f.prepared.replay.sessions();
    const auto order = [&](const SessionChange& c) {
        return std::find(sessions.begin(), sessions.end(), c.since);
    };
    for (SessionChange& change : list) {
        change.before = value_in(first, f.prepared.catalogue, change.parameter);
        for (const SessionChange& other : list)
            if (other.probability > 0.0 && order(other) < order(change) &&
                identification::full_name(other.parameter) ==
                    identification::full_name(change.parameter))
                change.before += other.parameter.value;
    }
}

}  // namespace

std::vector<SessionChange> changes_of(const Outcome& f, const Solution& solution,
                                      const std::vector<double>& probability) {
    std::vector<SessionChange> list;
    const Eigen::VectorXd sigma = solution.covariance().diagonal().cwiseSqrt();
    for (std::size_t k = 0; k < f.model.members.size(); ++k) {
        const ColumnGroup& group = f.design.group(f.model.members[k]);
        if (group.is_change())
            add(list, group, solution.mean.segment(solution.first[k], solution.size[k]),
                sigma.segment(solution.first[k], solution.size[k]), probability[k]);
    }
    const estimation::GivenMembers given(f.design.equations(f.model.members), f.model.variances);
    for (std::size_t g = 0; g < f.design.groups().size(); ++g) {
        const Design::Entry& entry = f.design.groups()[g];
        if (!entry.group.is_change() || !of_interest(f, *entry.group.effect) ||
            !right_form(f, entry.group) || told_already(f, entry.group))
            continue;
        const estimation::GroupInformation left =
            given.leave(f.design.cross(f.model.members, {g}), entry.gram, entry.product);
        const estimation::LinearFit fit = estimation::solve_ranked(left.information, left.product);
        add(list, entry.group, fit.value, fit.sigma, 0.0);
    }
    add_befores(f, solution, list);
    return list;
}

std::optional<records::ReadingTable> files_as_sessions(const records::ReadingTable& table) {
    const bool told = std::any_of(table.rows.begin(), table.rows.end(),
                                  [](const records::Reading& row) { return !row.session.empty(); });
    if (told || table.parts.size() < 2) return std::nullopt;
    records::ReadingTable named = table;
    for (records::Reading& row : named.rows)
        row.session =
            std::filesystem::path(named.parts[static_cast<std::size_t>(row.part)]).stem().string();
    named.optional_columns.emplace_back("session");
    return named;
}

std::vector<SessionFit> sessions_of(const Outcome& f, const std::vector<double>& before_um,
                                    const std::vector<double>& after_um) {
    std::vector<SessionFit> list;
    for (const std::string& name : f.prepared.replay.sessions()) list.push_back({name});
    for (std::size_t i = 0; i < before_um.size(); ++i) {
        if (!f.used[i]) continue;
        SessionFit& session = list[f.prepared.replay.session(i)];
        ++session.readings;
        session.rms_before_um += before_um[i] * before_um[i];
        session.rms_after_um += after_um[i] * after_um[i];
    }
    for (SessionFit& session : list) {
        const double rows = std::max(1.0, static_cast<double>(session.readings));
        session.rms_before_um = std::sqrt(session.rms_before_um / rows);
        session.rms_after_um = std::sqrt(session.rms_after_um / rows);
    }
    return list;
}

}  // namespace trunnion::diagnosis
