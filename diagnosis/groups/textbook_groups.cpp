// Catalogue effects as groups of columns.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "base/units.h"
#include "diagnosis/groups/angles_by_an_arm.h"
#include "diagnosis/groups/candidate_groups.h"
#include "diagnosis/groups/few_places.h"
#include "diagnosis/groups/mean_line.h"
#include "diagnosis/prepare/places.h"
#include "diagnosis/rules/rules.h"

namespace trunnion::diagnosis {
namespace {

/// Columns that move every reading by less than this number of sigma for a typical change are
/// omitted.
constexpr double dead_column = 1e-6;

using Takes = std::function<bool(const effects::EffectParameter&)>;

struct Material {
    std::vector<std::size_t> parameters;
    Eigen::MatrixXd columns;  ///< mm
};

bool is_usual(const effects::EffectParameter& parameter) {
    return parameter.usual;
}

/// Columns of the linear parameters in textbook form (or those that `takes` accepts) that move any
/// reading; zero in the sessions `before`.
Material material_of(const Prepared& p, const effects::Effect& effect,
                     const std::vector<double>& keys, const std::vector<std::string>& before = {},
                     const Takes& takes = is_usual) {
    Material m;
    std::vector<Eigen::VectorXd> list;
    for (std::size_t j = 0; j < effect.parameters.size(); ++j) {
        if (effect.parameters[j].is_key() || !takes(effect.parameters[j])) continue;
        Eigen::MatrixXd column =
            identification::effect_column(p.replay, p.base.gradient, {effect, keys, j});
        drop_sessions(column, p.replay, before);
        list.emplace_back(column);
        if (list.back().cwiseQuotient(p.base.sigma_mm).norm() < dead_column)
            list.pop_back();
        else
            m.parameters.push_back(j);
    }
    m.columns.resize(p.base.residual_mm.size(), static_cast<Eigen::Index>(list.size()));
    for (std::size_t c = 0; c < list.size(); ++c)
        m.columns.col(static_cast<Eigen::Index>(c)) = list[c];
    return m;
}

ColumnGroup group_of(const effects::Effect& effect, std::vector<double> keys,
                     const Material& material, Eigen::Index first, const Takes& takes) {
    ColumnGroup group;
    group.kind = has_keys(effect) ? GroupKind::periodic : GroupKind::textbook;
    group.name = effect.name;
    group.effect = &effect;
    group.keys = std::move(keys);
    for (std::size_t c = 0; c < material.parameters.size(); ++c) {
        if (takes && !takes(effect.parameters[material.parameters[c]])) continue;
        group.parameters.push_back(material.parameters[c]);
        group.features.push_back(first + static_cast<Eigen::Index>(c));
    }
    return group;
}

/// Prior of key values: uniform over their grids, but uniform in the logarithm for numbers of
/// periods. A period and its alias fit equally well, and machines have the coarse one.
double log_prior_of_keys(const effects::Effect& effect, const std::vector<double>& keys) {
    double sum = 0.0;
    for (std::size_t j = 0; j < keys.size(); ++j) {
        const effects::EffectParameter& p = effect.parameters[j];
        if (!p.is_key()) continue;
        double all = 0.0;
        for (const double g : p.grid) all += p.counts_periods ? 1.0 / g : 1.0;
        sum += std::log((p.counts_periods ? 1.0 / keys[j] : 1.0) / all);
    }
    return sum;
}

/// Each of several instruments is wrong by itself: all of them alike are no form of the effect.
bool has_own_gains(const effects::Effect& effect) {
    return effect.kind == effects::EffectKind::sensor_gain && effect.parameters.size() > 1;
}

/// Forms of one parameter each.
std::vector<Takes> each_alone(const effects::Effect& effect) {
    std::vector<Takes> forms;
    for (const effects::EffectParameter& one : effect.parameters)
        forms.push_back(
            [name = one.name](const effects::EffectParameter& p) { return p.name == name; });
    return forms;
}

}  // namespace

std::vector<std::function<bool(const effects::EffectParameter&)>> simpler_forms(
    const effects::Effect& effect) {
    // The offsets of a stylus, its radius and its delay are set one by one, so that one of them may
    // be wrong alone.
    if (has_own_gains(effect) || effect.kind == effects::EffectKind::probe_runout ||
        effect.kind == effects::EffectKind::probe_radius)
        return each_alone(effect);
    std::vector<Takes> forms;
    std::set<std::string> vectors;
    for (const effects::EffectParameter& p : effect.parameters) {
        if (p.component >= 0 && !p.is_key()) vectors.insert(p.name);
    }
    const auto slope = [](const effects::EffectParameter& p) { return p.mean_line; };
    if (std::any_of(effect.parameters.begin(), effect.parameters.end(), slope))
        forms.push_back(std::not_fn(slope));
    if (vectors.size() > 1)
        for (const std::string& name : vectors)
            forms.push_back([name](const effects::EffectParameter& p) { return p.name == name; });
    if (effect.kind == effects::EffectKind::location) {
        std::set<Axis> axes;
        for (const effects::EffectParameter& p : effect.parameters) axes.insert(p.location->axis);
        for (const Axis axis : axes)
            if (axes.size() > 1)
                forms.push_back(
                    [axis](const effects::EffectParameter& p) { return p.location->axis == axis; });
    }
    return forms;
}

namespace {

/// A change between sessions, without effect before it. No sessions before: not a change.
struct Since {
    std::string session;
    std::vector<std::string> before;
};

struct EffectColumns {
    const effects::Effect* effect;
    Material material;
    Eigen::Index first;
};

/// Number of linear axes that the readings were taken along.
std::ptrdiff_t moving_linear_axes(const Prepared& p) {
    const auto moves = [&](const kinematics::AxisGeometry& axis) {
        const double first = p.replay.sample(0).position[axis.axis];
        for (std::size_t i = 1; i < p.replay.size(); ++i)
            if (p.replay.sample(i).position[axis.axis] != first) return !axis.rotary;
        return false;
    };
    const auto axes = p.base.setup.machine.chain.axes();
    return std::count_if(axes.begin(), axes.end(), moves);
}

/// Log prior probability that a textbook form is present.
double prior_of(const effects::Effect& effect) {
    const bool of_scales = effect.kind == effects::EffectKind::sensor_gain ||
                           effect.kind == effects::EffectKind::machine_expansion;
    return of_scales ? rules::gain_prior : rules::effect_prior;
}

/// True where the first rotary axis that carries the work, whose load gravity_sag() is about, turns
/// about Z of M, along which gravity acts.
bool carries_upright(const kinematics::Chain& chain) {
    const auto first =
        std::find_if(chain.work.begin(), chain.work.end(),
                     [](const kinematics::AxisGeometry& axis) { return axis.rotary; });
    return first != chain.work.end() && first->direction.cross(Vector3::UnitZ()).norm() < 1e-3;
}

/// A change may concern an effect that the simulation already contains.
bool offered(const Prepared& p, const effects::Effect& effect, const Since& since) {
    if (effect.parameters.empty() || has_keys(effect)) return false;
    if (since.before.empty() && is_of_resting_axis(p, effect)) return false;
    // Through two places there is no bow, only a slope.
    if (effect.kind == effects::EffectKind::straightness && is_at_two_places(p, *effect.axis))
        return false;
    if (effect.kind == effects::EffectKind::gravity_sag &&
        carries_upright(p.base.setup.machine.chain))
        return false;
    // Of one axis that moves, the stretch is its scale.
    if (effect.kind == effects::EffectKind::machine_expansion && moving_linear_axes(p) < 2)
        return false;
    return !since.before.empty() || !modelled(p, effect);
}

/// True when a rotary axis was read over less than half a turn, where harmonics look alike.
bool is_part_of_turn(const Prepared& p, const effects::Effect& effect) {
    if (!effect.axis) return false;
    return range_of(p, *effect.axis).span() < pi;
}

/// Forms of an error of a rotary axis with few of its harmonics: over part of a turn, where they
/// look alike, the first; else any single one. An eccentric encoder has the first order alone, an
/// oval bearing the second, and each further harmonic costs evidence.
std::vector<Takes> forms_by_order(const Prepared& prepared, const effects::Effect& effect) {
    std::set<int> orders;
    for (const effects::EffectParameter& p : effect.parameters)
        if (p.order > 0) orders.insert(p.order);
    if (orders.size() < 2) return {};
    if (is_part_of_turn(prepared, effect))
        return {[](const effects::EffectParameter& p) { return p.order <= 1; }};
    std::vector<Takes> forms;
    for (const int order : orders)
        forms.push_back([order](const effects::EffectParameter& p) { return p.order == order; });
    return forms;
}

/// Adds all forms of an effect whose columns are in the design.
void add_forms(Design& design, const Prepared& prepared, const EffectColumns& ready,
               const Since& since, double log_prior) {
    const bool by_direction = is_squareness_here(prepared, *ready.effect);
    std::vector<Takes> forms =
        by_direction ? each_alone(*ready.effect) : simpler_forms(*ready.effect);
    for (Takes& form : forms_by_order(prepared, *ready.effect)) forms.push_back(std::move(form));
    const auto& parameters = ready.effect->parameters;
    const bool has_mean_line =
        since.before.empty() &&
        std::any_of(parameters.begin(), parameters.end(),
                    [](const effects::EffectParameter& q) { return q.mean_line; });
    // The forms of an effect share its prior; instruments are wrong one by one.
    const bool own_gains = has_own_gains(*ready.effect);
    const bool is_form = is_side_of_places(prepared, *ready.effect);
    const double shared = own_gains ? 0.0 : std::log(1.0 + static_cast<double>(forms.size()));
    const auto add = [&](const Takes& takes) {
        ColumnGroup group =
            group_of(*ready.effect, ready.effect->zeros(), ready.material, ready.first, takes);
        if (has_mean_line && !takes) take_bow_from_mean_line(prepared, group);
        group.log_prior = log_prior - shared;
        if (has_mean_line && takes && is_bow_to_one_side(prepared, group))
            group.log_prior += rules::unnamed_form;
        group.since = since.session;
        group.before = since.before;
        if (group.is_change()) group.name += " since " + since.session;
        if (group.columns() == 0) return;
        const std::size_t added = design.add(std::move(group));
        if (is_form && design.groups()[added].moves_readings()) design.keep_as_rival(added);
    };
    if (!own_gains && !by_direction) add({});
    for (const Takes& takes : forms) add(takes);
}

/// Adds effects without keys, in all forms. Returns the number of features.
Eigen::Index add_effects(Design& design, const Prepared& prepared, const Whitener& whitener,
                         const Since& since) {
    std::vector<EffectColumns> list;
    Eigen::Index all = 0;
    for (const effects::Effect& effect : prepared.catalogue) {
        if (!offered(prepared, effect, since)) continue;
        list.push_back({&effect, material_of(prepared, effect, effect.zeros(), since.before), all});
        all += list.back().material.columns.cols();
    }
    Eigen::MatrixXd white(prepared.base.residual_mm.size(), all);
    for (const EffectColumns& r : list)
        white.middleCols(r.first, r.material.columns.cols()) = r.material.columns;
    whitener.apply(white);
    const Eigen::Index first = design.add_features(white);
    double sessions = 0.0;
    if (!since.before.empty())
        sessions = std::log(static_cast<double>(prepared.replay.sessions().size() - 1));
    for (EffectColumns& r : list) {
        r.first += first;
        add_forms(design, prepared, r, since, prior_of(*r.effect) - sessions);
    }
    return all;
}

}  // namespace

namespace {

/// The angles of an axis with a bow about its zero beside the slope (E.. = p1 u + p2 u^2): few
/// numbers in place of a table, whose mean would be a squareness or the zero of a rotary axis.
void add_bowed_angles(Design& design, const Prepared& prepared, const Whitener& whitener) {
    constexpr double less_usual = -0.7;  // ln 0.5 (assumed)
    for (std::size_t k = 0, count = design.groups().size(); k < count; ++k) {
        const ColumnGroup sloped = design.group(k);
        if (sloped.kind != GroupKind::textbook || design.groups()[k].hidden ||
            sloped.effect->kind != effects::EffectKind::angular || sloped.shape.size() > 0 ||
            !are_told_by_themselves(design, sloped))
            continue;
        std::set<char> turns;
        for (const std::size_t j : sloped.parameters)
            turns.insert(sloped.effect->parameters[j].name[1]);
        const Material material = material_of(
            prepared, *sloped.effect, sloped.effect->zeros(), {},
            [&](const effects::EffectParameter& q) { return turns.contains(q.name[1]); });
        if (material.parameters.size() <= sloped.parameters.size()) continue;
        Eigen::MatrixXd white = material.columns;
        whitener.apply(white);
        ColumnGroup bowed = group_of(*sloped.effect, sloped.effect->zeros(), material,
                                     design.add_features(white), {});
        bowed.log_prior = sloped.log_prior + less_usual;
        design.keep_as_form(design.add(std::move(bowed)));
    }
}

}  // namespace

Eigen::Index add_textbook_groups(Design& design, const Prepared& prepared,
                                 const Whitener& whitener) {
    const Eigen::Index added = add_effects(design, prepared, whitener, {});
    favour_motions_over_angles(design);
    add_bowed_angles(design, prepared, whitener);
    return added;
}

Eigen::Index add_change_groups(Design& design, const Prepared& prepared, const Whitener& whitener) {
    Eigen::Index added = 0;
    std::vector<std::string> before;
    for (const std::string& session : prepared.replay.sessions()) {
        if (!before.empty()) added += add_effects(design, prepared, whitener, {session, before});
        before.push_back(session);
    }
    return added;
}

namespace {

/// An effect at given keys, its features added to the design; empty where it moves nothing.
std::optional<ColumnGroup> keyed_group(Design& design, const Prepared& prepared,
                                       const Whitener& whitener, const effects::Effect& effect,
                                       std::vector<double> keys) {
    Material material = material_of(prepared, effect, keys);
    if (material.parameters.empty()) return std::nullopt;
    whitener.apply(material.columns);
    const double prior = rules::effect_prior + log_prior_of_keys(effect, keys);
    ColumnGroup group =
        group_of(effect, std::move(keys), material, design.add_features(material.columns), {});
    group.log_prior = prior;
    return group;
}

}  // namespace

namespace {

/// Some parameters of an effect, their features added to the design; empty where none of them moves
/// a reading.
std::optional<ColumnGroup> one_direction(Design& design, const Prepared& prepared,
                                         const Whitener& whitener, const effects::Effect& effect,
                                         const Takes& takes) {
    Material material = material_of(prepared, effect, effect.zeros(), {}, takes);
    if (material.parameters.empty()) return std::nullopt;
    whitener.apply(material.columns);
    ColumnGroup group =
        group_of(effect, effect.zeros(), material, design.add_features(material.columns), {});
    group.log_prior = rules::effect_prior + rules::unnamed_form;
    group.unnamed = true;
    return group;
}

}  // namespace

void add_unnamed_forms(Design& design, const Prepared& prepared, const Whitener& whitener) {
    for (const effects::Effect& effect : prepared.catalogue) {
        const bool angular = effect.kind == effects::EffectKind::angular;
        if ((!angular && effect.kind != effects::EffectKind::straightness) ||
            !offered(prepared, effect, {}))
            continue;
        for (const char direction : {'A', 'B', 'C', 'X', 'Y', 'Z'}) {
            const Takes takes = [&](const effects::EffectParameter& q) {
                return q.name[1] == direction && (angular || q.usual);
            };
            auto group = one_direction(design, prepared, whitener, effect, takes);
            if (!group || group->parameters.size() < 2) continue;
            ColumnGroup simple = *group;
            if (angular)
                simple.shape = bow_about_mean_line(prepared, effect, group->parameters[1]);
            else
                simple.shape = Eigen::Vector2d::UnitX();
            design.keep_as_rival(design.add(std::move(simple)));
            design.keep_as_rival(design.add(std::move(*group)));
        }
    }
}

void add_machine_jump(Design& design, const Prepared& prepared, const Whitener& whitener,
                      const effects::Effect& jump, std::vector<double> keys) {
    auto group = keyed_group(design, prepared, whitener, jump, std::move(keys));
    if (!group) return;
    group->machine_jump = true;
    design.keep_as_rival(design.add(std::move(*group)));
}

std::optional<std::size_t> add_keyed_group(Design& design, const Prepared& prepared,
                                           const Whitener& whitener, const effects::Effect& effect,
                                           std::vector<double> keys) {
    if (effect.kind == effects::EffectKind::artefact_moved)
        for (const effects::Effect& jump : prepared.only_rivals)
            add_machine_jump(design, prepared, whitener, jump, keys);
    auto group = keyed_group(design, prepared, whitener, effect, std::move(keys));
    if (!group) return std::nullopt;
    return design.add(std::move(*group));
}

}  // namespace trunnion::diagnosis
