#include "diagnosis/verdict/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "diagnosis/groups/few_places.h"
#include "diagnosis/groups/ripples.h"
#include "diagnosis/prepare/outliers.h"
#include "diagnosis/prepare/places.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/left_out.h"
#include "diagnosis/verdict/alike_readings.h"
#include "diagnosis/verdict/chance.h"
#include "estimation/distributions.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t most_places = 6;  ///< in the list "where"

GroupKind kind_of(const Design& design, const Model& model, std::size_t position) {
    return design.group(model.members[position]).kind;
}

std::vector<bool> marked(const Design& design, const Model& model,
                         const std::function<bool(GroupKind, std::size_t)>& takes) {
    std::vector<bool> list;
    for (std::size_t k = 0; k < model.members.size(); ++k)
        list.push_back(takes(kind_of(design, model, k), k));
    return list;
}

std::vector<bool> large_zeros(Design& design, const Model& model) {
    const Eigen::MatrixXd parts = contributions(design, model, fit_of(design, model));
    return marked(design, model, [&](GroupKind kind, std::size_t k) {
        const double square = parts.col(static_cast<Eigen::Index>(k)).squaredNorm();
        const double large =
            design.group(model.members[k]).of_cycles ? rules::large_cycle : rules::large_zero;
        return kind == GroupKind::offset && square > large * large * design.rows();
    });
}

/// The model with the line free that a table leaves to the textbook form: a table without slope
/// over all positions would know something of those that are left out.
Model with_free_line(const Design& design, Model model, const ColumnGroup& table) {
    constexpr double any_size = 100.0;
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        const ColumnGroup& line = design.group(k);
        if (!line.is_line || line.name != table.name ||
            line.table.axis.axis != table.table.axis.axis)
            continue;
        model.members.push_back(k);
        model.variances.tau.push_back(any_size);
    }
    return model;
}

/// True where a member saves on left-out positions what it saves at the readings, the others fitted
/// again without it: much of what is left there may be the error of others.
bool saves_elsewhere(Design& design, const Model& model, std::size_t position,
                     const Saving& saving) {
    const double noise = model.variances.nu * model.variances.nu;
    const double here = noise * worth_of_members(design, model)[position].explained();
    return saving.t >= rules::least_t && saving.sum >= rules::between_least * here;
}

/// True when a table predicts left-out positions of its axis, and not by chance: few positions may
/// follow each other by accident.
bool holds_between(Design& design, const Prepared& prepared, const Model& model,
                   std::size_t position, const std::vector<bool>& used) {
    const ColumnGroup& group = design.group(model.members[position]);
    const bool slide = !group.table.knots.empty() && !group.table.axis.rotary;
    if (slide && place_count(prepared, group.table.axis.axis) < rules::table_places) return false;
    const Model free = with_free_line(design, model, group);
    const Folds places =
        of_moved_rows(design, {model.members[position]}, place_folds(prepared.replay, group.table));
    const LeftOut left(design, free, places, used);
    std::vector<bool> all(free.members.size(), true), rest = all;
    rest[position] = false;
    const BlockLoss with = left.loss_beside_set_up(all, all),
                    without = left.loss_beside_set_up(rest, rest);
    const double noise = model.variances.nu * model.variances.nu;
    const Saving saving = saving_of(without, with);
    if (without.mean() - with.mean() <=
            rules::between_least * std::max(1e-12, without.mean() - noise) &&
        !saves_elsewhere(design, free, position, saving))
        return false;
    return saving.blocks >= rules::many_places ||
           estimation::student_probability(saving.t, saving.blocks - 1.0) >= rules::between_sure;
}

/// True for a drift beside what else depends on time: its course is not that of a drift, which
/// would grow or stand still after the last reading.
bool is_other_course(const Design& design, const Model& model, std::size_t position) {
    const ColumnGroup& group = design.group(model.members[position]);
    return group.effect && group.effect->kind == effects::EffectKind::thermal_drift &&
           std::any_of(model.members.begin(), model.members.end(),
                       [&](std::size_t m) { return design.group(m).of_time; });
}

/// True for a member that may be written for positions and times between those of the readings.
bool is_valid_between(Design& design, const Prepared& prepared, const Model& model,
                      std::size_t position, const std::vector<bool>& used) {
    const ColumnGroup& group = design.group(model.members[position]);
    const bool alternates =
        group.kind == GroupKind::periodic && shows_two_phases(prepared, *group.effect, group.keys);
    if (alternates || is_other_course(design, model, position)) return false;
    return group.kind != GroupKind::table ||
           (!is_alias_of_finer(design, prepared, model, position) &&
            holds_between(design, prepared, model, position, used));
}

/// Squares of errors that each place of an axis may have for itself: what is left, and tables that
/// do not hold between their places.
double square_of_places(const Design& design, const Model& model, const Sizes& sizes,
                        const Judgement& j, Axis axis) {
    double square = std::max(0.0, sizes.remainder.squaredNorm() - sizes.floor * design.freedom());
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const ColumnGroup& group = design.group(model.members[k]);
        if (group.kind == GroupKind::table && !j.interpolates[k] && group.table.axis.axis == axis)
            square += sizes.square[k];
    }
    return square;
}

/// Marks ripples that independent errors of the places may imitate as holding at the places alone:
/// some period among many fits a few of them.
void mark_accidents(const Design& design, const Prepared& prepared, const Model& model,
                    const Sizes& sizes, Judgement& j) {
    constexpr double rare = 0.05;
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const ColumnGroup& group = design.group(model.members[k]);
        if (group.kind != GroupKind::periodic || !group.effect->axis) continue;
        const Axis axis = *group.effect->axis;
        const double noise =
            sizes.floor * static_cast<double>(telling_places(prepared, axis).size());
        const double others = noise + square_of_places(design, model, sizes, j, axis);
        const double part = sizes.square[k] / (sizes.square[k] + others);
        if (chance_of_period(prepared, *group.effect, group.keys, part) > rare)
            j.interpolates[k] = false;
    }
}

/// Other periods of a ripple: those with the same values at all places, or those that the
/// likelihood leaves open.
std::vector<double> other_periods_of(const Prepared& prepared, const ColumnGroup& group) {
    if (group.kind != GroupKind::periodic) return {};
    std::vector<double> equal = equal_periods(prepared, *group.effect, group.keys);
    return equal.empty() ? group.open_keys : equal;
}

double share_of_tables(const Sizes& sizes, const std::vector<bool>& those) {
    double sum = 0.0;
    for (std::size_t k = 0; k < those.size(); ++k)
        if (those[k]) sum += sizes.along[k] / std::max(1e-12, sizes.whole);
    return sum;
}

/// Evidence of a model beyond that of the zeros of tests alone, whose scatter is noise. A drift
/// over few tests is such a scatter as well.
double evidence_beside_zeros(Design& design, const Model& model,
                             const estimation::NoisePrior& prior) {
    constexpr double usual_tau = 0.1;
    const SearchSetting setting = search_setting(design, prior);
    std::vector<Model> some{empty_model(design, setting)};
    double best = 0.0;
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        if (design.group(k).kind != GroupKind::offset || !design.groups()[k].visible()) continue;
        const std::size_t without_it = some.size();
        for (std::size_t m = 0; m < without_it; ++m) {
            Model with_it = some[m];
            with_it.members.push_back(k);
            with_it.variances.tau.push_back(usual_tau);
            some.push_back(tuned(design, setting, std::move(with_it), 3));
            best = std::max(best, evidence(design, some.back()));
        }
    }
    return evidence(design, model) - best;
}

/// True where all that was found is a course of time, beside the zeros of several tests: these
/// scatter, and over few tests a scatter is such a course.
bool is_course_of_zeros(const Design& design, const Model& model) {
    const auto is_zero = [](const ColumnGroup& group) { return group.kind == GroupKind::offset; };
    const bool tests = std::any_of(design.groups().begin(), design.groups().end(),
                                   [&](const auto& entry) { return is_zero(entry.group); });
    return tests && std::all_of(model.members.begin(), model.members.end(), [&](std::size_t m) {
               return is_zero(design.group(m)) || is_course_of_time(design.group(m));
           });
}

/// True when there is more than noise. Without a driver the evidence must be confirmed by left-out
/// readings, unless the noise that repeats tell is far too small for what was found, or blocks are
/// few and noise of no size gives it.
bool is_gap(Design& design, const Model& model, const Judgement& j, const Sizes& sizes,
            const Saving& saving) {
    if (std::any_of(j.large.begin(), j.large.end(), [](bool b) { return b; })) return true;
    double driver = 0.0;
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (kind_of(design, model, k) == GroupKind::driver) driver += sizes.square[k];
    // The evidence weighs what a certain cause needs: that there is any may be sure without it.
    const bool unlikely = j.repeated && j.chance < rules::plain_chance;
    const bool confirmed =
        j.evidence > 0.0 &&
        (unlikely ? saving.t >= rules::least_t : is_told_without_noise(design, model, j, saving));
    if (j.evidence < rules::least_evidence && !confirmed) return false;
    if (j.evidence < rules::course_evidence && is_course_of_zeros(design, model)) return false;
    if (driver > rules::least_driver * j.floor * design.rows()) return true;
    if (saving.t < rules::least_t && j.evidence < rules::plain_evidence && !unlikely && !confirmed)
        return false;
    return j.before - j.after >= rules::least_saving * j.floor;
}

/// H where the zeros of tests are known, large ones as well: what the causes explain of the rest.
double part_beside_zeros(const Design& design, const Model& model, const LeftOut& left,
                         double floor) {
    std::vector<bool> zeros, predicting;
    for (const std::size_t m : model.members) {
        zeros.push_back(design.group(m).kind == GroupKind::offset);
        predicting.push_back(zeros.back() || is_cause(design.group(m).kind));
    }
    const double rank = static_cast<double>(design.projection().rank());
    const double before = left.loss(zeros, zeros).mean(),
                 after = left.loss(std::vector<bool>(zeros.size(), true), predicting).mean();
    const double excess = before - floor * (1.0 + rank / std::max(1.0, design.rows()));
    return excess > 0.0 ? (before - after) / excess : 0.0;
}

/// Mean square of left-out readings with the zeros alone, relative to what the other readings leave
/// open of the set-up: few of them may leave very much.
double surprise_of(FoldColumns& rows, const std::vector<bool>& zeros, Model model) {
    for (std::size_t k = zeros.size(); k-- > 0;)
        if (!zeros[k]) model = without(model, k);
    return LeftOut(rows, model).surprise() / std::max(1.0, rows.design().rows());
}

/// Noise that repeats show, relative to what is stated: the largest of the devices; 1 where nothing
/// is stated or nothing repeats.
double scatter_of(const Prepared& p, const NoiseModel& noise) {
    double most = 1.0;
    if (noise.source != NoiseSource::repeats || !p.base.noise_given) return most;
    for (const NoiseBlock& block : p.blocks) most = std::max(most, noise.of(block.device).scale);
    return most;
}

}  // namespace

Judgement judged(FoldColumns& rows, const Prepared& prepared, const Model& model,
                 const NoiseBelief& noise) {
    Design& design = rows.design();
    const std::vector<bool>& used = rows.left_out().used;
    Judgement j;
    const double nu2 = model.variances.nu * model.variances.nu;
    j.floor = noise.model.source == NoiseSource::repeats ? 1.0 : std::min(nu2, noise.most);
    j.large = large_zeros(design, model);
    j.evidence = evidence_beside_zeros(design, model, noise.prior);
    const LeftOut left(rows, model);
    const std::vector<bool> all(model.members.size(), true);
    const auto zeros = marked(design, model, [&](GroupKind kind, std::size_t k) {
        return kind == GroupKind::offset && !j.large[k];
    });
    const auto predicting = marked(
        design, model, [&](GroupKind kind, std::size_t k) { return is_cause(kind) || zeros[k]; });
    const BlockLoss before = left.loss(zeros, zeros), after = left.loss(all, predicting);
    j.left = left.residual(all, predicting);
    j.left_before = left.residual(zeros, zeros);
    j.before = before.mean();
    j.after = after.mean();
    const double unknowns =
        static_cast<double>(design.projection().rank()) / std::max(1.0, design.rows());
    j.part = part_of(j, unknowns);
    j.beside_zeros = part_beside_zeros(design, model, left, j.floor);
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        std::vector<bool> rest = all, rest_predicting = predicting;
        rest[k] = rest_predicting[k] = false;
        j.support.push_back({saving_of(left.loss(rest, rest_predicting), after)});
        j.equal_periods.push_back(other_periods_of(prepared, design.group(model.members[k])));
        j.interpolates.push_back(j.equal_periods.back().empty() &&
                                 is_valid_between(design, prepared, model, k, used));
    }
    const Sizes sizes = sizes_of(design, model, j.floor, j.large);
    mark_accidents(design, prepared, model, sizes, j);
    auto local = j.interpolates;
    local.flip();
    for (std::size_t k = 0; k < local.size(); ++k)
        if (bends_at_few_places(design, prepared, model, k)) local[k] = true;
    j.between_places = share_of_tables(sizes, local) <= rules::between_part;
    // More than noise may be whatever nothing that was found predicts: a wandering machine.
    const bool beyond_noise = nu2 > noise.most || (j.before - j.floor * unknowns > noise.most &&
                                                   surprise_of(rows, zeros, model) > noise.most);
    const bool spoiled = are_spoiled(used, prepared.replay);
    j.chance = chance_of(design, model, noise.model, sizes);
    j.repeated = noise.model.source == NoiseSource::repeats;
    j.gap = spoiled || beyond_noise || is_gap(design, model, j, sizes, saving_of(before, after));
    j.scatter = scatter_of(prepared, noise.model);
    j.only_scatter = !j.gap && j.scatter > rules::most_scatter;
    // Without repeats, scatter may be structure finer than the places as well as noise.
    const bool unstated = noise.model.source == NoiseSource::assumed && !prepared.base.noise_given;
    j.gap = j.gap || j.only_scatter || (unstated && std::sqrt(nu2) > rules::most_unstated);
    if (!j.gap && j.repeated) see_slow_course(prepared, design, model, noise.model, j);
    if (!j.gap && !j.repeated) see_neighbours(prepared, used, sizes.remainder, unknowns, j);
    return j;
}

Verdict verdict_of(const Judgement& j, const std::vector<Claim>& claims) {
    if (!j.gap) return Verdict::no_gap;
    const bool rivalled = std::any_of(claims.begin(), claims.end(), [](const Claim& c) {
        return c.share >= rules::least_share && !c.rivals.empty();
    });
    if (j.part < rules::partly) return Verdict::unexplained;
    if (j.part < rules::explained) return Verdict::partly_explained;
    const bool named = std::any_of(claims.begin(), claims.end(),
                                   [](const Claim& c) { return c.probability >= rules::claimed; });
    return rivalled || !named ? Verdict::ambiguous : Verdict::explained;
}

Model without_idle_members(FoldColumns& rows, const SearchSetting& setting, Model model) {
    constexpr double least_t = 1.0;
    if (model.members.empty()) return model;
    Design& design = rows.design();
    LeftOut left(rows, model);
    const std::vector<std::size_t> first = model.members;
    std::vector<bool> fitted(first.size(), true);
    auto predicting = marked(design, model,
                             [](GroupKind kind, std::size_t) { return kind != GroupKind::driver; });
    for (bool again = true; again && !model.members.empty();) {
        again = false;
        const BlockLoss with = left.loss(fitted, predicting);
        double weakest = least_t;
        std::size_t member = 0;
        for (std::size_t k = 0; k < first.size(); ++k) {
            if (!fitted[k] || !is_cause(design.group(first[k]).kind)) continue;
            std::vector<bool> rest = fitted;
            rest[k] = false;
            const double t = saving_of(left.loss(rest, predicting), with).t;
            if (t >= weakest) continue;
            weakest = t;
            member = k;
            again = true;
        }
        if (!again) break;
        const auto position =
            std::count(fitted.begin(), fitted.begin() + static_cast<std::ptrdiff_t>(member), true);
        model = tuned(design, setting, without(model, static_cast<std::size_t>(position)), 2);
        fitted[member] = false;
        left.retune(fitted, model.variances);
    }
    return model;
}

namespace {

bool tells_where(const ColumnGroup& group) {
    return group.kind == GroupKind::offset || (group.kind == GroupKind::driver && !group.is_whole);
}

}  // namespace

std::vector<DriverShare> where_of(const Design& design, double floor) {
    std::vector<DriverShare> where;
    const Eigen::VectorXd y = design.projection().beside(design.data());
    const double whole = y.squaredNorm(), freedom = design.freedom();
    double tried = 0.0;
    for (const auto& entry : design.groups()) tried += tells_where(entry.group) ? 1.0 : 0.0;
    for (const auto& entry : design.groups()) {
        const ColumnGroup& group = entry.group;
        if (!tells_where(group) || group.is_anything) continue;
        const auto own = static_cast<std::ptrdiff_t>(group.columns());
        const estimation::GroupInformation all =
            design.of({group.features.end() - own, group.features.end()});
        const estimation::LinearFit fit = estimation::solve_ranked(all.information, all.product);
        const double q =
            static_cast<double>(own - static_cast<std::ptrdiff_t>(fit.null_space.size()));
        const double explained = all.product.dot(fit.value);
        if (q < 1.0 || freedom - q < 5.0) continue;
        const double rest = std::max(1e-12, whole - explained) / (freedom - q);
        DriverShare d{group.name, group.component, "", 0.0, 1.0};
        d.p_value = std::min(1.0, tried * estimation::f_tail(explained / q / rest, q, freedom - q));
        d.share =
            std::clamp((explained - q * rest) / std::max(1e-9, whole - freedom * floor), 0.0, 1.0);
        if (d.p_value > rules::driver_p || d.share < rules::driver_share) continue;
        d.text =
            fmt::format("{:.0f} % of the gap {} ({})", 100.0 * d.share, group.text, d.component);
        where.push_back(std::move(d));
    }
    std::stable_sort(where.begin(), where.end(),
                     [](const DriverShare& a, const DriverShare& b) { return a.share > b.share; });
    if (where.size() > most_places) where.resize(most_places);
    return where;
}

}  // namespace trunnion::diagnosis
