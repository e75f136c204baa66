#include "diagnosis/search/search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/search/offers.h"
#include "diagnosis/search/stand_ins.h"
#include "diagnosis/search/whole_play.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t tried = 4;       ///< number of best offers tuned at each step
constexpr double certain = 30.0;       ///< worth of a member that is not questioned, nats
constexpr std::size_t swap_tried = 3;  ///< offers tried in place of a member
constexpr double impossible = 1e9;     ///< taken from the score of a model with a parameter out of
                                       ///< its range
constexpr double tuning_gain = 10.0;   ///< maximum gain by tuning the variances of a changed model,
                                       ///< nats

/// The zeros of tests, which are always offered.
std::vector<std::size_t> zeros(const Design& design) {
    std::vector<std::size_t> list;
    for (std::size_t k = 0; k < design.groups().size(); ++k)
        if (design.group(k).kind == GroupKind::offset && design.groups()[k].visible())
            list.push_back(k);
    return list;
}

/// Refines the keys of the member added last.
Model refined_last(Design& design, const SearchSetting& setting, Model model) {
    const std::size_t last = model.members.size() - 1;
    if (!setting.refine || design.group(model.members[last]).kind != GroupKind::periodic)
        return model;
    const auto better = setting.refine(model, last);
    if (!better) return model;
    Model trial = model;
    trial.members[last] = *better;
    trial = tuned(design, setting, std::move(trial), 1);
    return trial.score > model.score ? trial : model;
}

/// The score with unchanged variances; tuning adds a few nats at most.
double rough_score(Design& design, const SearchSetting& setting, const Model& model) {
    double score = estimation::restricted_likelihood(design.equations(model.members),
                                                     model.variances, setting.noise) -
                   setting.empty;
    for (const std::size_t m : model.members) score += design.group(m).log_prior;
    return score;
}

/// A member in another textbook form, where that is better by itself than a new member beside: what
/// a form without all its terms leaves is no second cause.
Model in_other_form(Design& design, const SearchSetting& setting, OffersBeside& beside,
                    const Model& model, Model best) {
    for (std::size_t position = 0; position < model.members.size(); ++position) {
        const ColumnGroup& held = design.group(model.members[position]);
        if (held.kind != GroupKind::textbook) continue;
        const double without_it = model.score + beside.gained(position) - held.log_prior;
        for (const Offer& offer : beside.other_forms(position)) {
            const double hoped =
                without_it + offer.gain.best + design.group(offer.group).log_prior + tuning_gain;
            if (hoped < best.score) continue;
            Model trial = model;
            trial.members[position] = offer.group;
            trial.variances.tau[position] = offer.gain.tau;
            trial = tuned(design, setting, std::move(trial), 1);
            if (trial.score > best.score + 1e-6) best = std::move(trial);
        }
    }
    return best;
}

/// The best of a model and of those with one of the best few offers, tuned. `seen`: the same model
/// with the noise under which the offers are weighed.
Model stepped(Design& design, const SearchSetting& setting, const Model& model, const Model& seen,
              bool with_zeros) {
    Model best = model;
    std::size_t count = 0;
    OffersBeside beside(design, seen);
    for (const Offer& offer : beside.all()) {
        if (count == tried || offer.gain.best + design.group(offer.group).log_prior < 0.0) break;
        if (!with_zeros && design.group(offer.group).kind == GroupKind::offset) continue;
        ++count;
        const double hoped = offer.gain.best + design.group(offer.group).log_prior + tuning_gain;
        if (model.score + hoped < best.score) continue;
        Model trial = tuned(design, setting, with(seen, offer), 1);
        if (trial.score > best.score + 1e-6) best = std::move(trial);
    }
    return count > 0 ? in_other_form(design, setting, beside, seen, std::move(best)) : best;
}

/// One step. Of few readings without repeats, noise may take all that an effect would explain:
/// before the search ends the offers are weighed under the noise that is expected, too.
bool grow(Design& design, const SearchSetting& setting, Model& model, bool with_zeros) {
    constexpr double larger = 1.5;
    Model best = stepped(design, setting, model, model, with_zeros);
    const double expected = std::exp(setting.noise.log_mean);
    if (best.members == model.members && model.variances.nu > larger * expected) {
        Model sharp = model;
        sharp.variances.nu = expected;
        best = stepped(design, setting, model, sharp, with_zeros);
        if (best.members == model.members) best = with_whole_play(design, setting, model, sharp);
    }
    if (best.members == model.members) return false;
    if (best.members.size() > model.members.size())
        best = refined_last(design, setting, std::move(best));
    model = tuned(design, setting, std::move(best), 2);
    return true;
}

}  // namespace

Model swapped(Design& design, const SearchSetting& setting, Model model) {
    std::optional<OffersBeside> beside;
    std::vector<Offer> worth;
    for (std::size_t position = 0; position < model.members.size() && !setting.stopped();
         ++position) {
        if (!beside) {
            beside.emplace(design, model);
            worth = worth_of_members(design, model);
        }
        const Offer& held = worth[position];
        const Model rest = without(model, position);
        std::size_t count = 0;
        for (const Offer& offer : beside->without(position)) {
            if (offer.group == held.group) continue;
            if (++count > swap_tried || offer.value < held.value + better) break;
            Model trial = tuned(design, setting, with(rest, offer), 2);
            if (!(trial.score >= model.score + better)) continue;
            model = std::move(trial);
            beside.reset();
            break;
        }
    }
    return model;
}

namespace {

bool named(GroupKind kind) {
    return kind == GroupKind::textbook || kind == GroupKind::periodic;
}

/// Named effects in place of a pair of members: two effects together may imitate a third one. Only
/// where few are named, because the time grows with their square.
Model joined(Design& design, const SearchSetting& setting, Model model) {
    const auto count = std::count_if(model.members.begin(), model.members.end(),
                                     [&](auto m) { return named(design.group(m).kind); });
    if (count > static_cast<std::ptrdiff_t>(pairs_up_to)) return model;
    for (std::size_t second = 1; second < model.members.size() && !setting.stopped(); ++second)
        for (std::size_t first = 0; first < second && second < model.members.size(); ++first) {
            if (!named(design.group(model.members[first]).kind) ||
                !named(design.group(model.members[second]).kind))
                continue;
            const Model rest = without(without(model, second), first);
            const std::vector<Offer> best = offers(design, rest, named);
            for (std::size_t k = 0; k < std::min(swap_tried, best.size()); ++k) {
                if (rough_score(design, setting, with(rest, best[k])) < model.score - tuning_gain)
                    continue;
                Model trial = tuned(design, setting, with(rest, best[k]), 2);
                if (evidence(design, trial) > evidence(design, model)) model = std::move(trial);
            }
        }
    return model;
}

/// Forms in which a free form may stand beside another effect: none, or another length.
std::vector<std::optional<std::size_t>> other_forms(const Design& design, std::size_t held) {
    std::vector<std::optional<std::size_t>> forms{std::nullopt};
    for (std::size_t k = 0; k < design.groups().size(); ++k)
        if (k != held && design.groups()[k].visible() &&
            same_cause(design.group(k), design.group(held)))
            forms.emplace_back(k);
    return forms;
}

/// Replaces a free form by a named effect: the free form is removed or gets another length, and the
/// best named effect is added.
Model paired(Design& design, const SearchSetting& setting, Model model) {
    std::optional<OffersBeside> beside;
    for (std::size_t position = 0; position < model.members.size() && !setting.stopped();
         ++position) {
        const std::size_t held = model.members[position];
        if (design.group(held).kind != GroupKind::table) continue;
        if (!beside) beside.emplace(design, model);
        for (const std::optional<std::size_t> form : other_forms(design, held)) {
            const std::vector<Offer> best = beside->without(position, named, form);
            if (best.empty()) break;
            const double changed = beside->gained(position, form) - design.group(held).log_prior +
                                   (form ? design.group(*form).log_prior : 0.0) +
                                   best.front().gain.best +
                                   design.group(best.front().group).log_prior;
            if (changed < -tuning_gain) continue;
            Model start = form ? model : without(model, position);
            if (form) start.members[position] = *form;
            Model trial = tuned(design, setting, with(std::move(start), best.front()), 2);
            if (!(trial.score >= model.score + better)) continue;
            model = std::move(trial);
            beside.reset();
            break;
        }
    }
    return model;
}

}  // namespace

double Offer::explained() const {
    Eigen::MatrixXd m = left.information;
    m.diagonal().array() += 1.0 / (gain.tau * gain.tau);
    return left.product.dot(m.ldlt().solve(left.product));
}

SearchSetting search_setting(Design& design, const estimation::NoisePrior& noise) {
    SearchSetting setting{noise, 0.0};
    setting.empty = estimation::maximise_likelihood(design.equations({}),
                                                    {{}, std::exp(noise.log_mean)}, noise, 1)
                        .likelihood;
    return setting;
}

Model empty_model(Design& design, const SearchSetting& setting) {
    return tuned(design, setting, {{}, {{}, std::exp(setting.noise.log_mean)}, 0.0}, 1);
}

namespace {

/// True where the fit gives a parameter a size that it cannot have: no control rounds its positions
/// by 500 times the increment, or by a tenth of it, no table rises under its weight, and no axis
/// lags by seconds on a circle, whatever this explains. `mean`: of the members' coefficients.
bool is_impossible(const Design& design, const Model& model, const Eigen::VectorXd& mean) {
    constexpr double beyond = 0.2;      // of the range or the usual size: noise may lead out of it
    constexpr double least_part = 0.4;  // of what is so or is not: a form that resembles it
    Eigen::Index at = 0;
    for (const std::size_t m : model.members) {
        const ColumnGroup& group = design.group(m);
        const auto own = mean.segment(std::exchange(at, at + group.columns()), group.columns());
        if (!group.has_range()) continue;
        const Eigen::VectorXd value = group.feature_values(own);
        for (std::size_t j = 0; j < group.parameters.size(); ++j) {
            const effects::EffectParameter& p = group.effect->parameters[group.parameters[j]];
            const double usual = value(static_cast<Eigen::Index>(j)), part = p.typical * usual;
            if (p.is_part && (part < least_part || part > 1.0 + beyond)) return true;
            if (p.is_positive && usual < -beyond) return true;
            if (std::abs(part) > p.most) return true;
        }
    }
    return false;
}

}  // namespace

Model tuned(Design& design, const SearchSetting& setting, Model model, int sweeps) {
    estimation::BestVariances best = estimation::maximise_likelihood(
        design.equations(model.members), std::move(model.variances), setting.noise, sweeps);
    model.variances = std::move(best.variances);
    model.score = best.likelihood - setting.empty;
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const ColumnGroup& group = design.group(model.members[k]);
        model.score += group.log_prior + log_prior_of_size(group, model.variances.tau[k]);
    }
    if (is_impossible(design, model, best.mean)) model.score -= impossible;
    return model;
}

bool same_cause(const ColumnGroup& a, const ColumnGroup& b) {
    return a.kind == b.kind && a.name == b.name && a.component == b.component &&
           a.unnamed == b.unnamed;
}

Offer offer_of(const Design& design, std::size_t group, const estimation::GroupInformation& left) {
    Offer offer{group, estimation::group_gain(left), 0.0, left};
    offer.value = offer.gain.mean + design.group(group).log_prior +
                  log_prior_of_size(design.group(group), offer.gain.tau);
    return offer;
}

std::vector<Offer> offers(Design& design, const Model& model,
                          const std::function<bool(GroupKind)>& takes) {
    return OffersBeside(design, model).all(takes);
}

Model without(const Model& model, std::size_t position) {
    Model rest = model;
    rest.members.erase(rest.members.begin() + static_cast<long>(position));
    rest.variances.tau.erase(rest.variances.tau.begin() + static_cast<long>(position));
    return rest;
}

Model with(Model model, const Offer& offer) {
    model.members.push_back(offer.group);
    model.variances.tau.push_back(offer.gain.tau);
    return model;
}

std::vector<Offer> worth_of_members(Design& design, const Model& model) {
    const auto held = design.held(model.members, estimation::not_absent(model.variances));
    if (held->each.empty())
        held->each =
            estimation::each_beside_others(held->equations, held->variances.tau, held->given);
    std::vector<Offer> worth;
    for (std::size_t k = 0; k < model.members.size(); ++k)
        worth.push_back(offer_of(design, model.members[k], held->each[k]));
    return worth;
}

double evidence_by(const Model& model, const std::vector<Offer>& worth) {
    double sum = model.score;
    for (const Offer& member : worth) sum -= member.gain.best - member.gain.mean;
    return sum;
}

double evidence(Design& design, const Model& model) {
    return evidence_by(model, worth_of_members(design, model));
}

Model pruned(Design& design, const SearchSetting& setting, Model model) {
    while (!model.members.empty() && !setting.stopped()) {
        const std::vector<Offer> worth = worth_of_members(design, model);
        const auto least =
            std::min_element(worth.begin(), worth.end(),
                             [](const Offer& a, const Offer& b) { return a.value < b.value; });
        const auto position = static_cast<std::size_t>(least - worth.begin());
        const bool zero = design.group(least->group).kind == GroupKind::offset;
        if (least->value >= certain || (zero && least->gain.best > 0.1)) break;
        Model rest = tuned(design, setting, without(model, position), 2);
        // With few readings the noise is larger without the member, and the loss smaller.
        if (least->value >= 0.0 && evidence(design, rest) < evidence_by(model, worth)) break;
        model = std::move(rest);
    }
    return model;
}

Model grown(Design& design, const SearchSetting& setting, Model model) {
    while (model.members.size() < setting.most_members && !setting.stopped()) {
        const double before = model.score;
        if (!grow(design, setting, model, true)) break;
        const auto steps = static_cast<double>(setting.most_members - model.members.size());
        if (model.score + steps * (model.score - before) < setting.worth_growing) break;
    }
    return model;
}

Model settled(Design& design, const SearchSetting& setting, Model model) {
    const Model before = model;
    model = pruned(design, setting, std::move(model));
    model = swapped(design, setting, std::move(model));
    model = paired(design, setting, std::move(model));
    model = joined(design, setting, std::move(model));
    model = without_stand_ins(design, setting, std::move(model));
    if (model.members != before.members) model = grown(design, setting, std::move(model));
    Model rest = pruned(design, setting, model);
    // What nothing was taken from does not grow again.
    if (model.score < before.score + 0.1 || rest.members == model.members) return rest;
    return pruned(design, setting, grown(design, setting, std::move(rest)));
}

Model searched(Design& design, const SearchSetting& setting) {
    Model from_effects = empty_model(design, setting), from_zeros = from_effects;
    const std::vector<std::size_t> zero = zeros(design);
    grow(design, setting, from_effects, false);
    from_effects = grown(design, setting, std::move(from_effects));
    if (zero.empty()) return from_effects;
    for (const std::size_t k : zero) {
        from_zeros.members.push_back(k);
        from_zeros.variances.tau.push_back(1.0);
    }
    from_zeros = grown(design, setting, tuned(design, setting, std::move(from_zeros), 3));
    return from_zeros.score > from_effects.score ? from_zeros : from_effects;
}

Fit fit_of(Design& design, const Model& model) {
    const estimation::GroupEquations e = design.equations(model.members);
    const estimation::GivenMembers given(e, model.variances);
    Fit fit{given.mean(), given.half(), {}, e.size};
    for (std::size_t k = 0; k < model.members.size(); ++k) fit.first.push_back(e.first(k));
    return fit;
}

Eigen::MatrixXd contributions(Design& design, const Model& model, const Fit& fit) {
    Eigen::MatrixXd parts(design.data().size(), static_cast<Eigen::Index>(model.members.size()));
    for (std::size_t k = 0; k < model.members.size(); ++k)
        parts.col(static_cast<Eigen::Index>(k)) =
            design.combined(model.members[k], fit.mean.segment(fit.first[k], fit.size[k]));
    return design.projection().beside(parts);
}

}  // namespace trunnion::diagnosis
