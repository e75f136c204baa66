#include "diagnosis/verdict/contenders.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/units.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/model_weight.h"
#include "diagnosis/verdict/contender_search.h"
#include "diagnosis/verdict/reply.h"
#include "diagnosis/verdict/verdict.h"

namespace trunnion::diagnosis {

double probability_against(const Contender& contender) {
    // Left-out readings exaggerate what separates the models, because each is fitted without them:
    // the evidence scatters as much as they do in proportion.
    const double margin = -contender.ahead;
    const double exaggerated =
        std::max(1.0, std::abs(contender.predicted) / std::max(1e-9, std::abs(margin)));
    const double spread = contender.spread / exaggerated;
    // The mean of 1 / (1 + exp(-x)) over a normal x (MacKay 1992).
    return 1.0 / (1.0 + std::exp(-margin / std::sqrt(1.0 + pi / 8.0 * spread * spread)));
}

namespace {

constexpr double family = 0.8;    ///< probability below which a free form's family is open
constexpr int most_replaced = 3;  ///< models that give way to a contender

/// The best model without free forms of the member's axis, where the member is one and not sure.
Contender contender_of_axis(const Searching& search, const Standing& chosen, FoldColumns& rows,
                            const Challenged& found, std::size_t position) {
    const ColumnGroup held = search.design.group(found.model.members[position]);
    if (held.kind != GroupKind::table || probability_against(found.contenders[position]) >= family)
        return {};
    return best_without(search, chosen, rows, [&](const ColumnGroup& group) {
        return group.kind == GroupKind::table && are_kindred(group.table, held.table);
    });
}

/// Positions of the members, the least certain first: a contender that becomes the model ends the
/// round, and the searches against certain members are the longest ones.
std::vector<std::size_t> least_certain_first(Design& design, const Model& model) {
    const std::vector<Offer> worth = worth_of_members(design, model);
    std::vector<std::size_t> order(worth.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return worth[a].value < worth[b].value; });
    return order;
}

/// Members without benefit for left-out readings come back on both sides, or on none.
Standing whole(const Searching& search, FoldColumns& rows, const Model& model) {
    return {rows, grown(search.design, search.setting, model)};
}

/// Members replaced by others that the evidence prefers to them, where left-out readings do not
/// object: what a member imitated together with an idle one that was removed, another may do alone.
Model exchanged(const Searching& search, FoldColumns& rows, Model model) {
    const Model other = swapped(search.design, search.setting, model);
    if (other.members == model.members ||
        !(weight_of(search.design, other) > weight_of(search.design, model) + better))
        return model;
    const Saving saving = saving_of(loss_of(rows, other), loss_of(rows, model));
    return saving.sum < saving.spread ? other : model;
}

/// A model that takes the place of the chosen one, and how it stands.
struct Successor {
    Model model;
    Standing chosen;
};

/// The contender as the model, if it is the better one also without its idle members, and left-out
/// readings do not lose as much by it as the evidence gains. With more members than a search may
/// take it is a sum that imitates what is not there.
std::optional<Successor> successor(const Searching& search, const Standing& chosen,
                                   FoldColumns& rows, const Contender& contender) {
    const std::size_t most = std::max(search.setting.most_members, chosen.model.members.size());
    const std::vector<std::size_t>& members = contender.model.members;
    // A jump is no cause: no setup can contain it. A ripple that the places do not resolve is none
    // that is claimed. A walk also follows noise that neighbours share.
    const bool barred = std::any_of(members.begin(), members.end(), [&](std::size_t m) {
        return search.design.groups()[m].only_rival || search.design.group(m).is_walk;
    });
    const double lost = contender.predicted < contender.spread ? 0.0 : contender.predicted;
    if (contender.ahead < std::max(better, lost) || members.size() > most || barred)
        return std::nullopt;
    Model model =
        exchanged(search, rows, without_idle_members(rows, search.setting, contender.model));
    Standing standing = whole(search, rows, model);
    if (standing.weight < chosen.weight + better) return std::nullopt;
    return Successor{std::move(model), std::move(standing)};
}

/// True for a model without the cause, and without a driver that would imitate it.
bool does_without(const Design& design, const Model& chosen, const Model& other,
                  const std::string& cause) {
    const bool beside = is_beside_drivers(design, chosen, cause);
    return !other.members.empty() &&
           std::none_of(other.members.begin(), other.members.end(), [&](std::size_t m) {
               const ColumnGroup& group = design.group(m);
               return (is_cause(group.kind) && group.name == cause) ||
                      (beside && group.kind == GroupKind::driver &&
                       std::find(chosen.members.begin(), chosen.members.end(), m) ==
                           chosen.members.end());
           });
}

/// The strongest contender of each cause among all that were found: a model that does without one
/// cause often does without what was found beside it, too.
void share_contenders(const Design& design, const Standing& chosen, const Model& model,
                      std::vector<Contender>& each) {
    const std::vector<Contender> found = each;
    for (std::size_t k = 0; k < each.size(); ++k) {
        const std::string cause = cause_of_member(design, model, k);
        if (cause.empty()) continue;
        for (const Contender& other : found)
            if (does_without(design, chosen.model, other.model, cause) &&
                probability_against(other) < probability_against(each[k]))
                each[k] = other;
    }
}

/// Weighs a contender against what the cause answers it, if that is better than the chosen model;
/// returns this answer, against the chosen model.
std::optional<Contender> replied(const Searching& search, const Standing& chosen, FoldColumns& rows,
                                 const std::string& cause, Contender& contender) {
    if (contender.model.members.empty() || probability_against(contender) >= rules::sure) return {};
    // A jump and a spoiled visit are no causes: none stands beside them.
    if (std::any_of(contender.model.members.begin(), contender.model.members.end(),
                    [&](std::size_t m) { return search.design.groups()[m].only_rival; }))
        return {};
    Standing standing(rows, reply_to(search, chosen.model, contender.model, cause));
    if (!(standing.weight > chosen.weight)) return {};
    contender = against(rows, standing, std::move(contender.model));
    return against(rows, chosen, std::move(standing.model));
}

/// Finds the contender of each member that is a cause; parts of one cause have one. If one may
/// replace the chosen model, returns what it becomes, and there are no contenders.
std::optional<Successor> challenge_each(const Searching& search, const Standing& chosen,
                                        FoldColumns& rows, Challenged& result, bool may_replace) {
    std::vector<Contender> contenders(result.model.members.size());
    std::map<std::string, std::size_t> challenged;
    for (const std::size_t k : least_certain_first(search.design, result.model)) {
        if (search.setting.stopped()) break;
        const std::string cause = cause_of_member(search.design, result.model, k);
        if (cause.empty()) continue;
        if (const auto [at, first] = challenged.try_emplace(cause, k); !first) {
            contenders[k] = contenders[at->second];
            continue;
        }
        contenders[k] = contender_of(search, chosen, rows, cause);
        if (may_replace && contenders[k].ahead >= better) {
            Contender best = contenders[k];
            if (auto reply = replied(search, chosen, rows, cause, best)) best = std::move(*reply);
            if (auto next = successor(search, chosen, rows, best)) return next;
        }
        contenders[k] = or_spoiled(search, chosen, rows, std::move(contenders[k]));
    }
    share_contenders(search.design, chosen, result.model, contenders);
    for (std::size_t k = 0; k < contenders.size() && !search.setting.stopped(); ++k)
        if (const std::string cause = cause_of_member(search.design, result.model, k);
            !cause.empty())
            replied(search, chosen, rows, cause, contenders[k]);
    result.contenders = std::move(contenders);
    return std::nullopt;
}

}  // namespace

Challenged unchallenged(Model model) {
    const std::vector<Contender> none(model.members.size());
    return {std::move(model), none, none, true};
}

Challenged challenged(FoldColumns& rows, const SearchSetting& setting, Model model) {
    const Searching search{rows.design(), setting};
    Challenged result{exchanged(search, rows, std::move(model)), {}, {}};
    Standing chosen = whole(search, rows, result.model);
    for (int replaced = 0; replaced < most_replaced; ++replaced) {
        std::optional<Successor> next = challenge_each(search, chosen, rows, result, true);
        if (!next) break;
        result = {std::move(next->model), {}, {}};
        chosen = std::move(next->chosen);
    }
    if (result.contenders.empty()) challenge_each(search, chosen, rows, result, false);
    for (std::size_t k = 0; k < result.contenders.size(); ++k)
        result.of_axis.push_back(contender_of_axis(search, chosen, rows, result, k));
    // A search that is ended leaves half a contender.
    if (setting.stopped()) return unchallenged(std::move(result.model));
    return result;
}

}  // namespace trunnion::diagnosis
