#include "diagnosis/verdict/claims.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "diagnosis/rules/rules.h"
#include "diagnosis/search/offers.h"
#include "diagnosis/search/solution.h"
#include "diagnosis/verdict/block_evidence.h"
#include "diagnosis/verdict/cause_evidence.h"
#include "diagnosis/verdict/contenders.h"
#include "diagnosis/verdict/line_of_form.h"
#include "diagnosis/verdict/order.h"
#include "diagnosis/verdict/reply.h"
#include "diagnosis/verdict/shares.h"
#include "estimation/distributions.h"

namespace trunnion::diagnosis {

effects::EffectKind motion_of(const ColumnGroup& group) {
    return group.effect ? group.effect->kind : group.table.motion;
}

namespace {

constexpr double doubtful = 0.4;  ///< probability at most of causes that cancel each other
/// Probability at most where the search was ended before a contender was looked for.
constexpr double unchallenged_most = 0.8;

/// A jump of the machine stands against a move of an artefact and against a drift, which are
/// courses of time, too: beside any other effect it is one more time that was picked to fit. A
/// form without a name stands against those that it imitates.
bool may_be_instead(const ColumnGroup& own, const ColumnGroup& other) {
    using enum effects::EffectKind;
    if (other.by_definition) return false;  // of share_with_angles()
    if (!is_cause(own.kind)) return !other.machine_jump && !other.unnamed;
    const effects::EffectKind motion = motion_of(own);
    if (other.machine_jump) return motion == artefact_moved || motion == thermal_drift;
    if (!other.unnamed) return true;
    return motion_of(other) == angular ? motion == straightness || motion == scale
                                       : motion == angular;
}

void name_rival(const Design& design, std::size_t group, Claim& claim) {
    const std::string& name = design.group(group).name;
    if (name == claim.name ||
        std::find(claim.rivals.begin(), claim.rivals.end(), name) != claim.rivals.end())
        return;
    claim.rivals.push_back(name);
    claim.rival_groups.push_back(group);
}

/// Other causes that explain nearly as much in place of the member.
void name_rivals(const Design& design, const Offer& held, const std::vector<Offer>& others,
                 Claim& claim) {
    const double most =
        std::min(rules::rival_limit(held.explained()), rules::rival_left * design.rows());
    const ColumnGroup& own = design.group(held.group);
    std::vector<std::pair<double, std::size_t>> found;
    for (const Offer& o : others) {
        const ColumnGroup& group = design.group(o.group);
        const bool alike =
            group.kind == GroupKind::table ? own.kind == GroupKind::table : is_cause(group.kind);
        if (!alike || group.name == own.name || !may_be_instead(own, group) ||
            held.explained() - o.explained() > most)
            continue;
        found.emplace_back(held.gain.best + own.log_prior - o.gain.best - group.log_prior, o.group);
    }
    std::sort(found.begin(), found.end());
    for (const auto& [worse, k] : found) name_rival(design, k, claim);
}

/// The best pair of effects that explains nearly as much: of angles that are seen through one arm
/// the scale and the squareness.
void name_pair(const Searching& search, const Model& model, const std::vector<TwoInstead>& pairs,
               Claim& claim) {
    if (pairs.empty()) return;
    const TwoInstead& best = pairs.front();
    if (evidence(search.design, best.model) + best.known <
        evidence(search.design, model) - rules::least_evidence)
        return;
    for (const std::size_t group : {best.first, best.second})
        name_rival(search.design, group, claim);
}

/// What the best model without the member has in its place, where that leaves the member unsure.
void name_contender(Design& design, const Model& model, const Contender& contender,
                    const Eigen::VectorXd& part, Claim& claim) {
    if (probability_against(contender) >= rules::sure) return;
    for (const std::size_t k : in_place_of(design, model, contender.model, part))
        name_rival(design, k, claim);
    for (const std::size_t k : contender.model.members) {
        const ColumnGroup& group = design.group(k);
        // A spoiled visit, a jump, a ripple that the places do not resolve.
        if (design.groups()[k].only_rival) name_rival(design, k, claim);
        const bool held = std::any_of(model.members.begin(), model.members.end(),
                                      [&](auto m) { return same_cause(design.group(m), group); });
        if (group.is_whole && group.of_time && !held) add_rival(machine_drift, claim);
    }
}

/// Positioning along the only line that was read may be made by an angle of the axis: that needs no
/// evidence of its own, and is a rival with half the prior.
void share_with_angles(const Design& design, const ColumnGroup& own, Claim& claim) {
    const effects::EffectKind motion = motion_of(own);
    if (own.kind == GroupKind::periodic ||
        (motion != effects::EffectKind::scale && motion != effects::EffectKind::positioning))
        return;
    const Axis axis = own.effect ? *own.effect->axis : own.table.axis.axis;
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        const ColumnGroup& angles = design.group(k);
        if (!angles.by_definition || angles.unnamed || angles.kind != own.kind ||
            !design.groups()[k].moves_readings() ||
            (angles.effect ? *angles.effect->axis : angles.table.axis.axis) != axis)
            continue;
        name_rival(design, k, claim);
        claim.probability *= rules::of_line;
        return;
    }
}

/// A cause far beyond its usual size is less probable than a table that is not what it says.
void doubt_size(double sizes, bool to_the_noise, Claim& claim) {
    const double most = rules::most_at_size(sizes, to_the_noise);
    claim.probability = std::min(claim.probability, most);
    if (most < rules::sure) claim.rivals.push_back(mistaken_readings);
}

/// A free form of which the readings do not tell the family (seen through one tool length, an
/// angular error is a straightness) has the name of what its rivals have in common. `axis`:
/// probability of any free form of its axis by the evidence and by left-out readings.
void name_axis(const Design& design, const Challenged& found, double axis, Claim& claim) {
    const ColumnGroup& own = design.group(found.model.members[claim.position]);
    if (std::none_of(claim.rival_groups.begin(), claim.rival_groups.end(), [&](std::size_t k) {
            return !design.group(k).by_definition && are_forms_of_one_axis(design.group(k), own);
        }))
        return;
    // Where no model without the axis was looked for, the best one without the family is sure to be
    // no better.
    const Contender& without_axis = found.of_axis[claim.position];
    const double any = std::min(axis, probability_against(without_axis.model.members.empty()
                                                              ? found.contenders[claim.position]
                                                              : without_axis));
    if (claim.probability >= rules::sure * any) return;
    claim.rivals.insert(claim.rivals.begin(), claim.name);
    claim.rival_groups.insert(claim.rival_groups.begin(), found.model.members[claim.position]);
    claim.name = "free form of " + own.table.axis.name;
    claim.probability = any;
}

}  // namespace

Instead instead_of(Design& design, const Model& model, std::size_t position, double blocks) {
    const Offer held = worth_of_members(design, model)[position];
    OffersBeside beside(design, model);
    std::vector<Offer> others = beside.without(position, is_cause);
    for (Offer& o : beside.only_rivals(position)) others.push_back(std::move(o));
    Claim claim;
    name_rivals(design, held, others, claim);
    std::vector<double> scores{0.0, -held.value};
    for (const std::size_t group : claim.rival_groups) {
        const auto is_it = [&](const Offer& o) { return o.group == group; };
        const Offer& o = *std::find_if(others.begin(), others.end(), is_it);
        scores.push_back(o.gain.best + design.group(group).log_prior - held.gain.best -
                         design.group(held.group).log_prior);
    }
    return {std::move(claim.rivals), std::min(seen_by(blocks), std::exp(-log_sum(scores)))};
}

Sizes sizes_of(Design& design, const Model& model, double floor, const std::vector<bool>& large) {
    Sizes sizes;
    sizes.floor = floor;
    sizes.parts = contributions(design, model, fit_of(design, model));
    sizes.remainder = design.projection().beside(design.data());
    Eigen::VectorXd causes = Eigen::VectorXd::Zero(sizes.remainder.size()), changes = causes;
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const auto c = sizes.parts.col(static_cast<Eigen::Index>(k));
        sizes.remainder -= c;
        sizes.square.push_back(c.squaredNorm());
        if (is_cause(design.group(model.members[k]).kind)) causes += c;
        if (design.group(model.members[k]).is_change()) changes += c;
        const bool place = design.group(model.members[k]).kind == GroupKind::driver || large[k];
        if (place) sizes.whole += sizes.square.back();
    }
    for (std::size_t k = 0; k < model.members.size(); ++k)
        sizes.along.push_back(
            sizes.parts.col(static_cast<Eigen::Index>(k))
                .dot(design.group(model.members[k]).is_change() ? changes : causes));
    sizes.whole += causes.squaredNorm() +
                   std::max(0.0, sizes.remainder.squaredNorm() - design.freedom() * floor);
    return sizes;
}

namespace {

const Offer& best_of(const std::vector<Offer>& offers) {
    return *std::max_element(offers.begin(), offers.end(),
                             [](const Offer& x, const Offer& y) { return x.value < y.value; });
}

/// The jumps that share the probability of a claim: for each offer that moves an artefact the one
/// at the same time; for a drift the best one.
std::vector<Offer> jumps_among(const Design& design, const ColumnGroup& own,
                               const std::vector<Offer>& instead,
                               const std::vector<Offer>& others) {
    const bool of_moves = own.effect && own.effect->kind == effects::EffectKind::artefact_moved;
    std::vector<Offer> jumps;
    for (const Offer& o : instead) {
        const ColumnGroup& jump = design.group(o.group);
        if (!jump.machine_jump || !may_be_instead(own, jump)) continue;
        const auto is_its_move = [&](const Offer& other) {
            const ColumnGroup& group = design.group(other.group);
            return group.name == own.name && group.keys == jump.keys;
        };
        if (!of_moves || std::any_of(others.begin(), others.end(), is_its_move)) jumps.push_back(o);
    }
    if (!of_moves && jumps.size() > 1) jumps = {best_of(jumps)};
    return jumps;
}

/// The best ripple that the positions do not resolve, and the best of the forms without a name of
/// their own. They are not claimed, but may be the truth.
std::vector<Offer> unclaimed(const Design& design, const ColumnGroup& own,
                             const std::vector<Offer>& instead) {
    std::map<GroupKind, std::vector<Offer>> kinds;
    for (const Offer& o : instead) {
        const ColumnGroup& group = design.group(o.group);
        if (design.groups()[o.group].only_rival && !group.machine_jump && group.name != own.name &&
            may_be_instead(own, group))
            kinds[group.kind].push_back(o);
    }
    std::vector<Offer> best;
    for (const auto& [kind, offers] : kinds) best.push_back(best_of(offers));
    return best;
}

/// Offers that share the probability of a claim: those that a model may contain, and some that can
/// only be named as rivals. `instead`: all.
std::vector<Offer> sharing(const Design& design, const ColumnGroup& own,
                           const std::vector<Offer>& instead, const std::vector<Offer>& others) {
    std::vector<Offer> all = jumps_among(design, own, instead, others);
    const std::vector<Offer> unnamed = unclaimed(design, own, instead);
    all.insert(all.end(), unnamed.begin(), unnamed.end());
    all.insert(all.end(), others.begin(), others.end());
    return all;
}

/// What the forms of a cause do together: the textbook form and the table of one error may take
/// back parts of each other.
Eigen::VectorXd part_of_cause(const Design& design, const Model& model, const Sizes& sizes,
                              const std::string& name) {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(sizes.remainder.size());
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (const ColumnGroup& group = design.group(model.members[k]);
            is_cause(group.kind) && group.name == name)
            sum += sizes.parts.col(static_cast<Eigen::Index>(k));
    return sum;
}

/// True for a member of which the columns of the other causes do less than four fifths.
bool stands_apart(const Design& design, const Model& model, std::size_t position) {
    constexpr double least_outside = 0.2;  // of its squares (assumed)
    std::set<Eigen::Index> others;
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (const ColumnGroup& group = design.group(model.members[k]);
            k != position && is_cause(group.kind))
            others.insert(group.features.begin(), group.features.end());
    return design.outside(model.members[position], {others.begin(), others.end()}) >= least_outside;
}

/// True where all that is left beyond the noise is little beside the squares of a cause. The
/// correction of a wrong form leaves more: that form differs from the true one in its own way.
bool leaves_no_more(const Sizes& sizes, double square) {
    constexpr double little = 0.02;  // assumed
    const auto rows = static_cast<double>(sizes.remainder.size());
    const double beyond = std::max(0.0, sizes.remainder.squaredNorm() - sizes.floor * rows) +
                          2.0 * std::sqrt(2.0 * rows) * sizes.floor;
    return beyond <= little * square;
}

/// True for a cause that takes back what the others do: the correction of a form that is not
/// theirs. One of known form may be against another by chance, or by its nature, as a play that
/// runs ahead is against a lag: it is no correction where the others cannot do its work, if it is
/// small beside them or leaves nothing.
bool works_against_others(const Design& design, const Model& model, const Sizes& sizes,
                          std::size_t position) {
    constexpr double by_chance = -0.3;  // cosine between both
    constexpr double small = 0.1;       // of the squares of the others (assumed)
    if (sizes.along[position] > 0.0) return false;
    const ColumnGroup& group = design.group(model.members[position]);
    const Eigen::VectorXd own = part_of_cause(design, model, sizes, group.name);
    Eigen::VectorXd others = -own;
    for (std::size_t k = 0; k < model.members.size(); ++k)
        if (is_cause(design.group(model.members[k]).kind))
            others += sizes.parts.col(static_cast<Eigen::Index>(k));
    const double along = own.dot(others);
    if (own.squaredNorm() + along > 0.0) return false;  // with its other forms it does something
    if (group.kind == GroupKind::table) return true;
    return along < by_chance * own.norm() * others.norm() &&
           ((own.squaredNorm() > small * others.squaredNorm() &&
             !leaves_no_more(sizes, own.squaredNorm())) ||
            !stands_apart(design, model, position));
}

/// Squares of all causes, each by itself, relative to the gap.
double sum_of_causes(const Design& design, const Model& model, const Sizes& sizes) {
    double sum = 0.0;
    std::set<std::string> counted;
    for (const std::size_t m : model.members)
        if (const ColumnGroup& group = design.group(m);
            is_cause(group.kind) && counted.insert(group.name).second)
            sum += part_of_cause(design, model, sizes, group.name).squaredNorm();
    return sum / std::max(1e-12, sizes.whole);
}

}  // namespace

std::vector<Claim> claims_of(const Searching& search, const Model& model, const Sizes& sizes,
                             const HeldOutEvidence& heldout) {
    Design& design = search.design;
    const std::vector<Offer> worth = worth_of_members(design, model);
    OffersBeside beside(design, model);
    std::vector<Claim> claims;
    const std::vector<double> usual = usual_sizes(design, model);
    const std::vector<double> shares = shares_of(design, model, sizes);
    // Where far more remains than noise may be, sigma is no measure of what is small.
    const double left = model.variances.nu / std::sqrt(sizes.floor);
    const double least_rms = rules::least_rms * (left > 2.0 ? left : 1.0);
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const ColumnGroup& group = design.group(model.members[k]);
        if (!is_cause(group.kind)) continue;
        Claim claim;
        claim.position = k;
        claim.name = group.name;
        claim.share = shares[k];
        claim.own = sizes.square[k] / std::max(1e-12, sizes.whole);
        claim.rms = std::sqrt(sizes.square[k] / std::max(1.0, design.rows()));
        if (claim.share < rules::least_share && claim.rms < least_rms) continue;
        const std::vector<Offer> others = beside.without(k);
        std::vector<Offer> instead = others;
        for (Offer& o : beside.only_rivals(k)) instead.push_back(std::move(o));
        const double blocks = heldout.support[k].saving.blocks;
        const double seeing = std::min(blocks, blocks_that_see(sizes, k, heldout.folds));
        const Contender& contender = heldout.found.contenders[k];
        const double seen =
            std::min({estimation::student_probability(heldout.support[k].saving.t, blocks - 1.0),
                      seen_by(seeing), std::clamp(heldout.explained, 0.0, 1.0)});
        const std::vector<Offer> one = sharing(design, group, instead, others);
        const std::vector<TwoInstead> two = two_instead(design, search.setting, model, k);
        const EvidenceOf told =
            evidence_of(search, model, worth[k], {one, two, !heldout.interpolates[k]},
                        temper(sizes, k, heldout.folds, heldout.variance));
        // What the evidence leaves open between forms of one axis is open in all that is seen, too.
        const double seen_axis = std::min(seen, told.axis);
        claim.probability = std::min(probability_against(contender),
                                     told.axis > 0.0 ? seen_axis * told.cause / told.axis : 0.0);
        const bool largest = shares[k] >= *std::max_element(shares.begin(), shares.end());
        if (!largest && works_against_others(design, model, sizes, k))
            claim.probability = std::min(claim.probability, doubtful);
        share_with_angles(design, group, claim);
        name_rivals(design, worth[k], instead, claim);
        name_pair(search, model, two, claim);
        name_contender(design, model, contender, sizes.parts.col(static_cast<Eigen::Index>(k)),
                       claim);
        name_axis(design, heldout.found, seen_axis, claim);
        doubt_size(usual[k], left <= 2.0, claim);
        if (heldout.found.ended) claim.probability = std::min(claim.probability, unchallenged_most);
        claims.push_back(std::move(claim));
    }
    // Contributions that cancel are not reliable.
    if (sum_of_causes(design, model, sizes) > rules::most_own)
        for (Claim& claim : claims) claim.probability = std::min(claim.probability, doubtful);
    doubt_lines_of_forms(design, model, claims);
    put_in_order(design, model, claims);
    return claims;
}

void add_rival(const std::string& name, Claim& claim) {
    if (std::find(claim.rivals.begin(), claim.rivals.end(), name) == claim.rivals.end())
        claim.rivals.push_back(name);
}

}  // namespace trunnion::diagnosis
