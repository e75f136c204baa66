#include "diagnosis/diagnosis_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "diagnosis/advice/next_measurement.h"
#include "diagnosis/beyond_command.h"
#include "diagnosis/causes.h"
#include "diagnosis/changes.h"
#include "diagnosis/doubted.h"
#include "diagnosis/groups/few_places.h"
#include "diagnosis/reading_sizes.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/offers.h"
#include "diagnosis/search/solution.h"
#include "diagnosis/set_up_report.h"
#include "diagnosis/shrink_interval.h"
#include "diagnosis/unknown_cause.h"
#include "diagnosis/verdict/between_places.h"
#include "diagnosis/wandering_zeros.h"
#include "diagnosis/written_setup.h"
#include "estimation/distributions.h"

namespace trunnion::diagnosis {
namespace {

/// Minimum half width of an interval of the shrink: the draws are linearised, and the comparison
/// uses another fit of the set-up.
constexpr double least_half_width = 0.01;
constexpr double noise_is_off = 0.1;   ///< relative: beyond, the stated noise is wrong
constexpr double least_weight = 1e-4;  ///< of an alternative model
constexpr std::size_t most_truths = 24;

double independent_readings(const Outcome& f) {
    double rows = 0.0;
    for (const NoiseBlock& block : f.prepared.blocks)
        rows += f.noise.model.of(block.device).independent(static_cast<double>(block.rows.size()));
    return rows;
}

/// The chosen model, and alternatives with each member left out or replaced by a rival.
std::vector<PossibleTruth> possible_truths(const Outcome& f) {
    std::vector<PossibleTruth> truths{{f.model, 1.0}};
    const std::vector<Offer> worth = worth_of_members(f.design, f.model);
    OffersBeside beside(f.design, f.model);
    for (std::size_t k = 0; k < f.model.members.size(); ++k) {
        const Model rest = without(f.model, k);
        const double own = worth[k].gain.best + f.design.group(worth[k].group).log_prior;
        if (const double weight = std::exp(-own); weight > least_weight)
            truths.push_back({rest, weight});
        for (const Offer& o : beside.without(k)) {
            const double weight = std::exp(o.gain.best + f.design.group(o.group).log_prior - own);
            if (weight < least_weight || truths.size() > most_truths) break;
            if (o.group == worth[k].group || !is_cause(f.design.group(o.group).kind)) continue;
            Model other = rest;
            other.members.push_back(o.group);
            other.variances.tau.push_back(o.gain.tau);
            truths.push_back({std::move(other), std::min(1.0, weight)});
        }
    }
    return truths;
}

/// Squares of left-out residuals beyond noise and the fit's own error, by stretch.
std::vector<Missed> missed_by(const Outcome& f, const Eigen::VectorXd& left) {
    const Eigen::VectorXd noise = noise_mm(f), scale = noise / std::sqrt(f.judgement.floor);
    const double fitted =
        static_cast<double>(f.design.projection().rank()) / std::max(1.0, f.design.rows());
    std::vector<Missed> list;
    for (const auto& rows : stretches_of(f.prepared.blocks)) {
        Missed m;
        for (const Eigen::Index i : rows) {
            if (!f.used[static_cast<std::size_t>(i)]) continue;
            const double own = noise(i) * noise(i);
            m.square += std::pow(left(i) * scale(i), 2) - own * (1.0 + fitted);
            m.noise += own;
            m.rows += 1.0;
        }
        list.push_back(m);
    }
    return list;
}

/// True for a table that is written to be interpolated.
bool is_interpolated(const Outcome& f, std::size_t group) {
    const auto& members = f.model.members;
    const auto at = std::find(members.begin(), members.end(), group);
    return at == members.end() ||
           f.judgement.interpolates[static_cast<std::size_t>(at - members.begin())];
}

DrawSetting draw_setting(const Outcome& f, const Written& written, std::uint64_t seed) {
    const double rows = independent_readings(f);
    const bool repeated = f.noise.model.source == NoiseSource::repeats;
    return {missed_by(f, f.judgement.left),
            {missed_by(f, written.paths.before), missed_by(f, written.paths.after)},
            1.0 - std::clamp(f.judgement.part, 0.0, 1.0),
            repeated ? f.noise.model.doubt : std::sqrt(2.0 / std::max(1.0, rows)),
            rows,
            noise_mm(f).squaredNorm() / static_cast<double>(noise_mm(f).size()),
            left_between_places(f.design, written.model,
                                [&](std::size_t group) { return is_interpolated(f, group); }),
            seed};
}

void describe_size(const Outcome& f, const Solution& solution, Diagnosis& d) {
    const identification::BaseModel& base = f.prepared.base;
    d.readings = f.prepared.replay.size();
    d.outliers = set_aside(f);
    d.noise = f.noise.model;
    d.added = added_noise(f);
    if (d.noise.source != NoiseSource::repeats) {
        const double chance = 3.0 / std::sqrt(2.0 * std::max(1.0, f.design.freedom()));
        const double nu = f.model.variances.nu;
        // Of an unexplained gap the noise part is unknown.
        const bool unknown = f.judgement.gap && f.judgement.part < rules::partly;
        const bool off = std::abs(std::log(nu)) > std::max(noise_is_off, chance);
        if (off) d.stated_um = other_stated_um(f);
        if (unknown || off || !d.added.empty()) d.noise.source = NoiseSource::assumed;
        for (const records::Device device :
             {records::Device::sphere, records::Device::touch, records::Device::ballbar})
            d.noise.of(device).scale *= nu;
    }
    const Eigen::VectorXd left = left_mm(f.prepared, f.design, f.model, solution);
    const Eigen::VectorXd before = set_up_left_mm(f.prepared, f.design);
    d.rms_um = rms_um(f, before);
    d.noise_um = rms_um(f, noise_mm(f));
    d.excess_um = std::sqrt(std::max(0.0, d.rms_um * d.rms_um - d.noise_um * d.noise_um));
    d.after_rms_um = rms_um(f, left);
    d.angles = records::only_angles(f.prepared.table);
    const double micro = records::micro_per_one(f.prepared.table);
    for (Eigen::Index i = 0; i < left.size(); ++i) {
        d.before_um.push_back(micro * before(i));
        d.after_um.push_back(micro * left(i));
    }
    d.inseparable = base.inseparable;
    d.sides = f.prepared.sides;
    d.notes = base.notes;
    if (d.outliers > 0) d.notes.push_back(set_aside_words(f));
    d.only_scatter = f.judgement.only_scatter;
    if (f.judgement.scatter > rules::told_scatter)
        d.notes.push_back(fmt::format(
            "repeated readings scatter {:.1f} times as much as is stated of the device: "
            "the noise is that of the repeats",
            f.judgement.scatter));
    add_resting(f.prepared, d.unseen);
    for (std::size_t k = 0; k < f.design.groups().size(); ++k) {
        const auto& entry = f.design.groups()[k];
        if (!entry.group.effect || entry.hidden || entry.group.is_change()) continue;
        const effects::EffectIdentity& identity = *entry.group.effect;
        if (!entry.visible() &&
            std::find(d.unseen.begin(), d.unseen.end(), identity.name) == d.unseen.end())
            d.unseen.push_back(identity.name);
        if (entry.visible() && effects::is_pivot(identity.kind) &&
            entry.group.parameters.size() == entry.group.effect->parameters.size())
            for (identification::Inseparable& group : unseen_of(f.design, k))
                d.inseparable.push_back(std::move(group));
    }
}

/// Free forms of one axis without a dominant one: their sum has no textbook name.
void merge_free_forms(const Outcome& f, std::vector<Claim>& claims) {
    for (const Axis axis : all_axes) {
        std::vector<std::size_t> forms;
        double sum = 0.0, most = 0.0;
        for (std::size_t k = 0; k < claims.size(); ++k) {
            const ColumnGroup& group = f.design.group(f.model.members[claims[k].position]);
            if (group.kind != GroupKind::table || group.table.axis.axis != axis || group.table.play)
                continue;
            forms.push_back(k);
            sum += claims[k].share;
            most = std::max(most, claims[k].share);
        }
        if (forms.size() < 2 || most >= rules::main_family * sum) continue;
        for (const std::size_t k : forms)
            claims[k].name = "free form of " + f.prepared.table.names[axis];
    }
}

/// A named rival in all its forms: a measurement must separate the claim from each of them.
const ColumnGroup& fullest_form(const Design& design, std::size_t rival) {
    const ColumnGroup* fullest = &design.group(rival);
    for (const auto& entry : design.groups())
        if (entry.group.kind == GroupKind::textbook && entry.group.effect == fullest->effect &&
            entry.group.since == fullest->since && entry.group.columns() > fullest->columns())
            fullest = &entry.group;
    return *fullest;
}

/// Probability that a claim or one of its rivals, which share alike, is the truth, and that the
/// model is right beside them (assumed: as if its other causes stood or fell with the least certain
/// one). Of a gap that is not explained something else is missing, which new readings will show as
/// well.
double believed(const Outcome& f, const std::vector<Claim>& claims, const Claim& claim) {
    double believed = claim.probability * (1.0 + static_cast<double>(claim.rivals.size()));
    believed = std::min(1.0, believed);
    const double part = std::clamp(f.judgement.part, 0.0, 1.0);
    if (part < rules::explained) believed *= part;
    double beside = 1.0;
    for (const Claim& other : claims)
        if (other.name != claim.name) beside = std::min(beside, other.probability);
    return believed * beside;
}

std::vector<AmbiguousPair> pairs_of(const Outcome& f, const std::vector<Claim>& claims,
                                    const Solution& solution) {
    constexpr std::size_t most = 2;  // of each claim
    std::vector<AmbiguousPair> pairs;
    for (const Claim& claim : claims) {
        const ColumnGroup& own = f.design.group(f.model.members[claim.position]);
        std::size_t count = 0;
        for (const std::size_t rival : claim.rival_groups) {
            const ColumnGroup& other = fullest_form(f.design, rival);
            // A free form without a family has the name of its own form as a rival.
            if (other.name == own.name) continue;
            if (count++ == most) break;
            pairs.push_back({&own,
                             solution.mean.segment(solution.first[claim.position],
                                                   solution.size[claim.position]),
                             &other, believed(f, claims, claim)});
        }
    }
    return pairs;
}

/// The interval of the draws, and the found shrink inside it.
void widen(HeldOut& h, const std::pair<double, double>& draws) {
    h.low = std::min(draws.first, h.shrink.value()) - least_half_width;
    h.high = std::min(1.0, std::max(draws.second, h.shrink.value()) + least_half_width);
}

/// Shrink on the readings themselves: the most that fresh readings at the same places can show.
double fitted_shrink(const Outcome& f, const Model& model) {
    if (model.members.empty()) return 0.0;
    const double noise = std::pow(rms_um(f, noise_mm(f)), 2);
    const double before = std::pow(rms_um(f, set_up_left_mm(f.prepared, f.design)), 2) - noise;
    const Eigen::VectorXd left = left_mm(f.prepared, f.design, model, solved(f.design, model));
    const double after = std::pow(rms_um(f, left), 2) - noise;
    return before > 0.0 ? 1.0 - std::sqrt(std::max(0.0, after) / before) : 0.0;
}

/// Left-out residual with the set-up and a single member.
HeldOut alone(const Outcome& f, std::size_t position, const ShrinkDraws& draws) {
    Model one{{f.model.members[position]},
              {{f.model.variances.tau[position]}, f.model.variances.nu},
              0.0};
    const LeftOut left(f.design, one, f.prepared.folds, f.used);
    HeldOut h = held_out(f, f.judgement.left_before, left.residual({true}, {true}));
    widen(h, draws.interval(one));
    return h;
}

/// H is that of what is written, if that holds everywhere; separate held-out readings are decisive.
Judgement as_written(const Outcome& f, const Written& written,
                     const records::ReadingTable* holdout) {
    Judgement judgement = f.judgement;
    if (!judgement.gap) return judgement;
    // Causes of which nothing is written, because none of them helps elsewhere, hold here only.
    const bool nothing_written = judgement.part > 0.0 && written.part <= 0.0;
    judgement.between_places &= !written.only_here && !nothing_written;
    if (judgement.between_places && written.part > 0.0)
        judgement.part = std::min(judgement.part, written.part);
    judgement.beside_zeros = std::min(judgement.beside_zeros, written.part);
    if (holdout)
        judgement.part = judgement.beside_zeros =
            std::min(judgement.part, confirmed_part(f, written, *holdout));
    return judgement;
}

/// Without a gap, reports only changes that remain after fitting the set-up alone.
void tell_sessions(const Outcome& f, const std::vector<Claim>& claims, Diagnosis& d) {
    d.sessions = sessions_of(f, d.before_um, d.after_um);
    const Model none{{}, {{}, f.model.variances.nu}, 0.0};
    const Outcome told{f.prepared,  f.design, f.setting, f.judgement.gap ? f.model : none,
                       f.judgement, f.noise,  f.used,    f.beside_set_up,
                       f.found};
    std::vector<double> probability(told.model.members.size(), 0.0);
    for (const Claim& claim : claims) probability[claim.position] = claim.probability;
    d.changes = changes_of(told, solved(told.design, told.model), probability);
}

/// True where the error of a group stands in a written model, in the same form or as a part of it.
bool is_written(const Design& design, const Model& written, const ColumnGroup& claimed) {
    return std::any_of(written.members.begin(), written.members.end(), [&](std::size_t m) {
        const ColumnGroup& group = design.group(m);
        return is_cause(group.kind) && group.name == claimed.name && group.since == claimed.since;
    });
}

Outcome with_judgement(const Outcome& found, const Judgement& judgement) {
    return {found.prepared, found.design, found.setting,       found.model, judgement,
            found.noise,    found.used,   found.beside_set_up, found.found};
}

/// Variance of a reading under which models are weighed: what is expected of the noise; where
/// nobody states it (the last digit of a log is no noise of its drive), what the model leaves.
double weighed_variance(const Outcome& f) {
    const bool unstated =
        f.noise.model.source == NoiseSource::assumed && !f.prepared.base.noise_given;
    const double left = f.model.variances.nu * f.model.variances.nu;
    return unstated ? std::max(f.judgement.floor, left) : f.judgement.floor;
}

/// Causes that the zeros of tests take back leave no more than there was.
void take_back_worse(Diagnosis& d) {
    if (d.explained > 0.0 || d.after_rms_um <= d.rms_um) return;
    d.after_rms_um = d.rms_um;
    d.after_um = d.before_um;
}

/// What is written, and what is claimed beside that.
struct Told {
    Written written;
    Judgement judgement;
    std::vector<Claim> claims;
};

Told told_of(const Outcome& found, const records::ReadingTable* holdout) {
    Told told{written_setup(found), {}, {}};
    told.judgement = as_written(found, told.written, holdout);
    const Outcome f = with_judgement(found, told.judgement);
    if (!f.judgement.gap) return told;
    const Sizes sizes = sizes_of(f.design, f.model, f.judgement.floor, f.judgement.large);
    told.claims =
        claims_of({f.design, f.setting}, f.model, sizes,
                  {f.judgement.support, f.found, f.prepared.folds, f.judgement.interpolates,
                   std::max(f.judgement.part, f.judgement.beside_zeros), weighed_variance(f)});
    merge_free_forms(f, told.claims);
    doubt_look_alikes(f, told.claims);
    told.written = without_unlikely(found, std::move(told.written), told.claims);
    return told;
}

}  // namespace

Diagnosis report_of(const Outcome& found, const DiagnosisOptions& options) {
    Told told = told_of(found, options.holdout);
    if (const auto less = doubted(found, told.claims))
        told = told_of(with_judgement(found, *less), options.holdout);
    Written& written = told.written;
    const Outcome f = with_judgement(found, told.judgement);
    const std::vector<Claim>& claims = told.claims;
    Diagnosis d;
    const Solution solution = solved(f.design, f.model);
    describe_size(f, solution, d);
    d.verdict = verdict_of(f.judgement, claims);
    d.p_value = f.judgement.chance;
    d.explained = f.judgement.gap ? std::clamp(f.judgement.part, 0.0, 1.0) : 0.0;
    d.between_places = f.judgement.between_places;
    if (std::max(f.judgement.part, f.judgement.beside_zeros) <= 0.0) written = written_setup(f);
    d.setup = written.setup;
    d.background = written.background;
    d.writes_causes = std::any_of(written.model.members.begin(), written.model.members.end(),
                                  [&](std::size_t m) { return is_cause(f.design.group(m).kind); });
    describe_set_up(f, solution, d);
    if (!f.judgement.gap) {
        d.after_rms_um = d.rms_um;
        d.after_um = d.before_um;
        if (options.over_sessions) tell_sessions(f, claims, d);
        return d;
    }
    d.unexplained_share = 1.0 - d.explained;
    take_back_worse(d);
    if (options.over_sessions) tell_sessions(f, claims, d);
    d.where = where_of(f.design, f.judgement.floor);
    tell_wandering_zeros(f, d);
    const FreshReadings fresh(f.prepared, options.seed);
    const ShrinkDraws draws(f.design, fresh, possible_truths(f),
                            draw_setting(f, written, options.seed));
    const Eigen::MatrixXd covariance = solution.covariance();
    for (const Claim& claim : claims) {
        d.causes.push_back(cause_of({f.design, f.model, f.judgement, solution, covariance}, claim));
        d.causes.back().heldout = alone(f, claim.position, draws);
        d.causes.back().written =
            is_written(f.design, written.model, f.design.group(f.model.members[claim.position]));
    }
    join_of_axis(f.prepared.catalogue, d.causes);
    tell_look_alikes(f, d.causes);
    d.after = held_out(f, written.blocks.before, written.blocks.after);
    widen(d.after, draws.interval_elsewhere(written.model));
    d.after.high = std::max(d.after.high.value(), fitted_shrink(f, written.model));
    if (leaves_something(f, d)) add_unknown(f, d);
    if (options.holdout) {
        d.after = measured_shrink(f, d.setup, *options.holdout, options.seed);
        if (d.after.set_aside > 0)
            d.notes.push_back(fmt::format("{}: {} held-out readings fit nothing and are set aside",
                                          options.holdout->path, d.after.set_aside));
        if (d.causes.size() == 1) d.causes.front().heldout = d.after;
    }
    if (!options.plan_next) return d;
    if (options.watch) options.watch("the next measurement (Ctrl-C: the verdict without it)");
    d.next = plan_next(f.prepared, d.noise, pairs_of(f, claims, solution), options.plan_on);
    return d;
}

}  // namespace trunnion::diagnosis
