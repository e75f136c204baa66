#include "diagnosis/search/offers.h"

#include <algorithm>
#include <cmath>

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t looked_at = 20;  ///< number of offers whose exact gain is computed

/// Visible groups that no member contains in another form.
std::vector<std::size_t> possible(const Design& design, const std::vector<std::size_t>& members,
                                  const OffersBeside::Takes& takes) {
    std::vector<std::size_t> list;
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        const auto& entry = design.groups()[k];
        if (!entry.visible() || entry.only_form || (takes && !takes(entry.group.kind))) continue;
        const auto is_it = [&](std::size_t m) {
            return m == k || same_cause(design.group(m), entry.group);
        };
        if (std::none_of(members.begin(), members.end(), is_it)) list.push_back(k);
    }
    return list;
}

}  // namespace

double unusual_size(const Design& design, const Offer& offer) {
    constexpr double usual = 2.0;  // of the typical size
    const Design::Entry& entry = design.groups()[offer.group];
    if (!entry.only_rival || entry.group.machine_jump || entry.group.kind != GroupKind::periodic)
        return 0.0;
    return std::log1p(std::pow(offer.gain.tau / usual, 2));
}

OffersBeside::OffersBeside(Design& design, const Model& model)
    : design_(design), model_(model), held_(design.held(model.members, model.variances)) {
    Eigen::Index first = 0;
    for (const std::size_t m : model.members) {
        first_.push_back(first);
        first += design.group(m).columns();
    }
}

/// What the members take and leave of groups, as far as it is not known.
void OffersBeside::see(const std::vector<std::size_t>& groups) {
    std::vector<std::size_t> missing;
    for (const std::size_t k : groups)
        if (!held_->seen.contains(k)) missing.push_back(k);
    if (missing.empty()) return;
    const Eigen::MatrixXd taken = held_->given.taken(design_.cross(model_.members, missing));
    Eigen::Index at = 0;
    for (const std::size_t k : missing) {
        const auto& entry = design_.groups()[k];
        const auto own = taken.middleCols(at, entry.group.columns());
        held_->seen.emplace(
            k, HeldMembers::Seen{own, held_->given.leave_beside(own, entry.gram, entry.product)});
        at += own.cols();
    }
}

estimation::GivenOthers OffersBeside::others(std::size_t position,
                                             std::optional<std::size_t> instead) {
    const double tau = model_.variances.tau[position];
    estimation::GivenOthers rest(held_->given, first_[position],
                                 design_.group(model_.members[position]).columns(), tau);
    if (!instead) return rest;
    see({*instead});
    const HeldMembers::Seen& own = held_->seen.at(*instead);
    rest.replace(own.taken, own.left, tau);
    return rest;
}

const OffersBeside::Beside& OffersBeside::changed(std::size_t position,
                                                  std::optional<std::size_t> instead) {
    if (last_ && last_->position == position && last_->instead == instead) return *last_;
    Beside& beside =
        last_.emplace(Beside{model_.members, {}, others(position, instead), instead, position});
    const Eigen::VectorXd mean = beside.others->mean(), own = beside.others->mean_in_place();
    const Eigen::Index first = first_[position],
                       after = first + design_.group(model_.members[position]).columns();
    beside.mean.resize(mean.size() - (after - first) + own.size());
    beside.mean << mean.head(first), own, mean.tail(mean.size() - after);
    const auto at = beside.members.begin() + static_cast<std::ptrdiff_t>(position);
    if (instead)
        *at = *instead;
    else
        beside.members.erase(at);
    return beside;
}

/// Of many groups, keeps the few with the largest lower bound of their gain.
void OffersBeside::keep_best(std::vector<std::size_t>& groups, const Beside& beside) const {
    if (groups.size() <= looked_at || beside.members.empty()) return;
    const double factor = 1.0 / (model_.variances.nu * model_.variances.nu);
    const Eigen::VectorXd left = factor * design_.left(beside.members, beside.mean, groups);
    std::vector<std::pair<double, std::size_t>> least;
    for (const std::size_t k : groups) {
        const auto& entry = design_.groups()[k];
        const double gain =
            estimation::mean_gain(*entry.reduced, design_.of_group(k, left), factor);
        least.emplace_back(-gain - entry.group.log_prior, k);
    }
    std::nth_element(least.begin(), least.begin() + static_cast<long>(looked_at), least.end());
    groups.clear();
    for (std::size_t k = 0; k < looked_at; ++k) groups.push_back(least[k].second);
    std::sort(groups.begin(), groups.end());
}

/// Exact offers of given groups, best first.
std::vector<Offer> OffersBeside::exact(const Beside& beside,
                                       const std::vector<std::size_t>& groups) {
    see(groups);
    std::vector<Offer> list;
    for (const std::size_t k : groups) {
        const HeldMembers::Seen& own = held_->seen.at(k);
        if (!beside.others)
            list.push_back(offer_of(design_, k, own.left));
        else if (!beside.instead)
            list.push_back(offer_of(design_, k, beside.others->leave(own.taken, own.left)));
        else
            list.push_back(offer_of(
                design_, k,
                beside.others->leave(own.taken, own.left, design_.cross({*beside.instead}, {k}))));
    }
    std::stable_sort(list.begin(), list.end(),
                     [](const Offer& a, const Offer& b) { return a.value > b.value; });
    return list;
}

std::vector<Offer> OffersBeside::offered(const Beside& beside, const Takes& takes) {
    std::vector<std::size_t> groups = possible(design_, beside.members, takes);
    keep_best(groups, beside);
    return exact(beside, groups);
}

std::vector<Offer> OffersBeside::all(const Takes& takes) {
    return offered({model_.members, held_->given.mean(), {}, {}, {}}, takes);
}

std::vector<Offer> OffersBeside::without(std::size_t position, const Takes& takes,
                                         std::optional<std::size_t> instead) {
    return offered(changed(position, instead), takes);
}

double OffersBeside::gained(std::size_t position, std::optional<std::size_t> instead) {
    return changed(position, instead).others->gained();
}

std::vector<Offer> OffersBeside::other_forms(std::size_t position) {
    const std::size_t held = model_.members[position];
    std::vector<std::size_t> forms;
    for (std::size_t k = 0; k < design_.groups().size(); ++k)
        if (k != held && design_.groups()[k].visible() &&
            same_cause(design_.group(k), design_.group(held)))
            forms.push_back(k);
    if (forms.empty()) return {};
    return exact(changed(position, std::nullopt), forms);
}

std::vector<Offer> OffersBeside::only_rivals(std::size_t position) {
    std::vector<std::size_t> kept;
    for (std::size_t k = 0; k < design_.groups().size(); ++k)
        // What the set-up takes up wholly leaves rounding: it would explain anything.
        if (design_.groups()[k].only_rival && design_.groups()[k].moves_readings())
            kept.push_back(k);
    return exact(changed(position, std::nullopt), kept);
}

std::vector<Offer> OffersBeside::spoiled_visits() {
    std::vector<std::size_t> visits;
    for (std::size_t k = 0; k < design_.groups().size(); ++k)
        if (design_.group(k).kind == GroupKind::spoiled && design_.groups()[k].moves_readings())
            visits.push_back(k);
    return exact({model_.members, held_->given.mean(), {}, {}, {}}, visits);
}

}  // namespace trunnion::diagnosis
