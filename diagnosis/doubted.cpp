#include "diagnosis/doubted.h"

#include <algorithm>

#include "diagnosis/bent_sight.h"
#include "diagnosis/measured_surface.h"
#include "diagnosis/one_feed.h"
#include "diagnosis/plays_of_passes.h"
#include "diagnosis/rounded_forms.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/solution.h"
#include "diagnosis/verdict/line_of_form.h"

namespace trunnion::diagnosis {
namespace {

/// A ripple, a drift or a spike: one that is not sure may do something else at other positions and
/// times. A slip has happened, whatever its name.
bool goes_on(const ColumnGroup& group) {
    return group.kind == GroupKind::periodic &&
           group.effect->kind != effects::EffectKind::artefact_moved;
}

/// True where a ripple is more likely than the claim, which is the ripple found or another cause.
/// A claim whose nearest rivals hold between places as well is unsure of its name, not of that.
bool is_improbable_ripple(const Outcome& f, const Claim& claim) {
    if (claim.probability >= rules::claimed || !f.judgement.interpolates[claim.position])
        return false;
    if (goes_on(f.design.group(f.model.members[claim.position]))) return true;
    if (claim.rival_groups.empty() || claim.share < rules::between_part) return false;
    const Design::Entry& nearest = f.design.groups()[claim.rival_groups.front()];
    return nearest.only_rival && goes_on(nearest.group);
}

/// Probability that a claim is there, or a rival that does the same at these readings: which of the
/// two names the error has does not matter where it is written.
double probability_of_either(const Outcome& f, const Claim& claim) {
    const bool rivalled =
        std::any_of(claim.rival_groups.begin(), claim.rival_groups.end(), [&](std::size_t rival) {
            const ColumnGroup& group = f.design.group(rival);
            return is_cause(group.kind) && !group.machine_jump;
        });
    return claim.probability * (rivalled ? 2.0 : 1.0);
}

/// The line beside a claimed form is as certain as that: only its name is open.
bool is_claimed(const Outcome& f, std::size_t position, const std::vector<Claim>& claims) {
    const std::string& name = f.design.group(f.model.members[position]).name;
    const auto form = form_of_line(f.design, f.model, position);
    if (form && is_claimed(f, *form, claims)) return true;
    return std::any_of(claims.begin(), claims.end(), [&](const Claim& claim) {
        return probability_of_either(f, claim) >= rules::claimed &&
               (claim.position == position || claim.name == name);
    });
}

/// What all causes do of the gap; none where zeros of tests are a part of it.
std::optional<double> told_share(const Outcome& f, const std::vector<Claim>& claims) {
    const std::vector<bool>& large = f.judgement.large;
    if (claims.empty() || std::find(large.begin(), large.end(), true) != large.end()) return {};
    double sum = 0.0;
    for (const Claim& claim : claims) sum += claim.share;
    return sum;
}

}  // namespace

std::optional<Judgement> doubted(const Outcome& f, const std::vector<Claim>& claims) {
    Judgement judgement = f.judgement;
    for (const Claim& claim : claims) {
        if (!is_improbable_ripple(f, claim)) continue;
        if (claim.share >= rules::between_part) judgement.between_places = false;
        const GroupKind kind = f.design.group(f.model.members[claim.position]).kind;
        for (std::size_t k = 0; k < f.model.members.size(); ++k) {
            const ColumnGroup& group = f.design.group(f.model.members[k]);
            if (group.name == claim.name && group.kind == kind) judgement.interpolates[k] = false;
        }
    }
    const std::vector<double> sizes = usual_sizes(f.design, f.model);
    for (std::size_t k = 0; k < f.model.members.size(); ++k) {
        if (!is_cause(f.design.group(f.model.members[k]).kind) || sizes[k] <= rules::enormous ||
            is_claimed(f, k, claims))
            continue;
        judgement.interpolates[k] = false;
        for (const Claim& claim : claims)
            if (claim.position == k && claim.own >= rules::between_part)
                judgement.between_places = false;
    }
    const auto told = told_share(f, claims);
    const bool less = told && *told < rules::least_told * judgement.part;
    if (less) judgement.part = judgement.beside_zeros = *told;
    if (!less && judgement.interpolates == f.judgement.interpolates) return std::nullopt;
    return judgement;
}

void doubt_look_alikes(const Outcome& found, std::vector<Claim>& claims) {
    doubt_measured_surface(found, claims);
    doubt_bent_sight(found, claims);
    doubt_contour_at_one_feed(found, claims);
    doubt_rounded_forms(found, claims);
    doubt_plays_of_passes(found, claims);
}

void tell_look_alikes(const Outcome& found, std::vector<Cause>& causes) {
    tell_measured_surface(found, causes);
    tell_bent_sight(causes);
    tell_one_feed(causes);
}

}  // namespace trunnion::diagnosis
