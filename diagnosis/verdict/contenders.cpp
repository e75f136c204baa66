#include "diagnosis/verdict/contenders.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "base/units.h"
#include "diagnosis/rules/rules.h"
#include "diagnosis/search/model_weight.h"
#include "diagnosis/search/offers.h"
#include "diagnosis/verdict/reply.h"
#include "diagnosis/verdict/verdict.h"

namespace trunnion::diagnosis {
namespace {

constexpr double hopeless = 60.0;  ///< evidence behind, nats, that no exchange makes up for
constexpr double family = 0.8;     ///< probability below which a free form's family is open
constexpr std::size_t more = 2;    ///< members that it may have beyond the chosen model
constexpr int most_replaced = 3;   ///< models that give way to a contender

/// Which groups a model must do without.
using Excluded = std::function<bool(const ColumnGroup&)>;

/// Groups taken out of the offers as long as this exists.
class Withheld {
  public:
    Withheld(Design& design, const Excluded& excluded) : design_(design) {
        for (std::size_t k = 0; k < design.groups().size(); ++k)
            if (!design.groups()[k].hidden && excluded(design.group(k))) {
                design.hide(k);
                groups_.push_back(k);
            }
    }
    ~Withheld() {
        for (const std::size_t k : groups_) design_.offer_again(k);
    }
    Withheld(const Withheld&) = delete;
    Withheld& operator=(const Withheld&) = delete;

  private:
    Design& design_;
    std::vector<std::size_t> groups_;
};

BlockLoss loss_of(FoldColumns& columns, const Model& model) {
    const std::vector<bool> all(model.members.size(), true);
    return LeftOut(columns, model).loss(all, all);
}

/// Name of a member that is a cause, else empty.
std::string cause_of_member(const Design& design, const Model& model, std::size_t position) {
    const ColumnGroup& group = design.group(model.members[position]);
    return is_cause(group.kind) ? group.name : "";
}

/// The chosen model with what every contender is compared with.
struct Standing {
    Model model;
    double weight;
    BlockLoss loss;  ///< of left-out readings
    Standing(FoldColumns& columns, Model chosen)
        : model(std::move(chosen)),
          weight(weight_of(columns.design(), model)),
          loss(loss_of(columns, model)) {}
};

/// A model against the chosen one, on left-out readings with all members of both.
Contender against(FoldColumns& rows, const Standing& chosen, Model model) {
    Contender contender{std::move(model), 0.0};
    contender.ahead = weight_of(rows.design(), contender.model) - chosen.weight;
    const Saving saving = steady_saving_of(loss_of(rows, contender.model), chosen.loss);
    const double per_nat = 2.0 * chosen.model.variances.nu * chosen.model.variances.nu;
    contender.predicted = saving.sum / per_nat;
    contender.spread = saving.spread / per_nat;
    return contender;
}

/// The best model without a cause, with up to `more` members more.
Contender best_without(const Searching& search, const Standing& chosen, FoldColumns& rows,
                       const Excluded& excluded) {
    Design& design = search.design;
    const Withheld withheld(design, excluded);
    Model model = chosen.model;
    for (std::size_t k = model.members.size(); k-- > 0;)
        if (excluded(design.group(model.members[k]))) model = without(model, k);
    SearchSetting setting = search.setting;
    setting.most_members = std::max(setting.most_members, chosen.model.members.size() + more);
    setting.worth_growing = chosen.model.score - hopeless;
    model = grown(design, setting, tuned(design, setting, std::move(model), 2));
    if (weight_of(design, model) > chosen.weight - hopeless)
        model = settled(design, setting, std::move(model));
    return against(rows, chosen, std::move(model));
}

}  // namespace

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

/// The chosen model with the bow of a straightness taken from its mean line, and the slope of that
/// line as squareness, in place of a bow about machine zero: on one side of it they look alike.
std::optional<Contender> with_slope_apart(const Searching& search, const Standing& chosen,
                                          FoldColumns& rows, std::size_t position) {
    Design& design = search.design;
    const ColumnGroup held = design.group(chosen.model.members[position]);
    Model model = chosen.model;
    for (std::size_t k = 0; k < design.groups().size(); ++k)
        if (same_cause(design.group(k), held) && design.group(k).shape.size() > 0)
            model.members[position] = k;
    if (model.members == chosen.model.members) return std::nullopt;
    model = tuned(design, search.setting, std::move(model), 2);
    for (int direction = 0; direction < 2; ++direction) {
        const std::vector<Offer> all = offers(design, model, is_cause);
        const auto slope = std::find_if(all.begin(), all.end(), [&](const Offer& offer) {
            return is_its_slope(design.group(offer.group), held) && offer.gain.mean >= 0.0;
        });
        if (slope == all.end()) break;
        model = tuned(design, search.setting, with(std::move(model), *slope), 2);
    }
    if (std::none_of(model.members.begin(), model.members.end(),
                     [&](std::size_t m) { return is_its_slope(design.group(m), held); }))
        return std::nullopt;
    return against(rows, chosen, std::move(model));
}

/// True for a cause of textbook forms alone, or a play, of which a driver by direction is the same.
bool is_beside_drivers(const Design& design, const Model& model, const std::string& cause) {
    return std::none_of(model.members.begin(), model.members.end(), [&](std::size_t m) {
        const ColumnGroup& group = design.group(m);
        return group.name == cause && is_cause(group.kind) && group.kind != GroupKind::textbook &&
               !group.table.play;
    });
}

bool is_jump(const Design& design, std::size_t group) {
    return design.group(group).machine_jump;
}

/// The best model with a jump in place of a member, and with what it needs beside it: what was
/// found beside the member fits that one.
Contender best_with_jump(const Searching& search, const Standing& chosen, FoldColumns& rows,
                         std::size_t position) {
    Design& design = search.design;
    const std::string cause = cause_of_member(design, chosen.model, position);
    const std::vector<Offer> rivals = OffersBeside(design, chosen.model).only_rivals(position);
    const auto jump =
        std::max_element(rivals.begin(), rivals.end(), [&](const Offer& a, const Offer& b) {
            return std::pair(is_jump(design, a.group), a.value) <
                   std::pair(is_jump(design, b.group), b.value);
        });
    if (jump == rivals.end() || !is_jump(design, jump->group)) return {};
    const Withheld withheld(design, [&](const ColumnGroup& group) {
        return is_cause(group.kind) && group.name == cause;
    });
    Model model = with(without(chosen.model, position), *jump);
    model = settled(design, search.setting, tuned(design, search.setting, std::move(model), 2));
    return against(rows, chosen, std::move(model));
}

/// The contender with the visit that it misses most taken for spoiled, if that is more likely: what
/// a single visit tells is not certain.
Contender or_spoiled(const Searching& search, const Standing& chosen, FoldColumns& rows,
                     Contender contender) {
    Design& design = search.design;
    const std::vector<Offer> visits = OffersBeside(design, contender.model).spoiled_visits();
    if (visits.empty() || visits.front().value < 0.0) return contender;
    const std::size_t visit = visits.front().group;
    Model model = tuned(design, search.setting, with(contender.model, visits.front()), 2);
    Contender spoiled = against(rows, chosen, std::move(model));
    // The same visit may be spoiled beside the chosen model, too.
    for (const Offer& own : OffersBeside(design, chosen.model).spoiled_visits())
        if (own.group == visit) spoiled.ahead -= std::max(0.0, own.value);
    return probability_against(spoiled) < probability_against(contender) ? spoiled : contender;
}

/// The best model without a cause; or, of a bow about machine zero, the one that takes its slope
/// for squareness, if that is more likely.
Contender contender_of(const Searching& search, const Standing& chosen, FoldColumns& rows,
                       const std::string& cause) {
    const Design& design = search.design;
    // A driver has nothing in common with a textbook form, but makes one out of another effect: a
    // spike less what a driver has of it is a backlash. It joins only where a cause has other
    // forms.
    const bool beside = is_beside_drivers(design, chosen.model, cause);
    const auto chosen_too = [&](const ColumnGroup& group) {
        return std::any_of(chosen.model.members.begin(), chosen.model.members.end(),
                           [&](std::size_t m) { return &design.group(m) == &group; });
    };
    Contender best = best_without(search, chosen, rows, [&](const ColumnGroup& group) {
        return (is_cause(group.kind) && group.name == cause) ||
               (beside && group.kind == GroupKind::driver && !chosen_too(group));
    });
    for (std::size_t k = 0; k < chosen.model.members.size(); ++k) {
        const ColumnGroup& group = design.group(chosen.model.members[k]);
        if (group.name == cause && group.effect &&
            group.effect->kind == effects::EffectKind::thermal_drift) {
            Contender jump = best_with_jump(search, chosen, rows, k);
            if (jump.ahead > best.ahead) best = std::move(jump);
        }
        if (group.name != cause || group.kind != GroupKind::textbook || group.shape.size() > 0 ||
            group.effect->kind != effects::EffectKind::straightness)
            continue;
        auto apart = with_slope_apart(search, chosen, rows, k);
        if (apart && apart->ahead > best.ahead) best = std::move(*apart);
    }
    return best;
}

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
    // A jump is no cause: no setup can contain it.
    const bool jumps = std::any_of(members.begin(), members.end(),
                                   [&](std::size_t m) { return is_jump(search.design, m); });
    const double lost = contender.predicted < contender.spread ? 0.0 : contender.predicted;
    if (contender.ahead < std::max(better, lost) || members.size() > most || jumps)
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
