#include "diagnosis/verdict/contender_search.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "diagnosis/search/model_weight.h"
#include "diagnosis/search/offers.h"

namespace trunnion::diagnosis {
namespace {

constexpr double hopeless = 60.0;  ///< evidence behind, nats, that no exchange makes up for
constexpr std::size_t more = 2;    ///< members that it may have beyond the chosen model

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

}  // namespace

BlockLoss loss_of(FoldColumns& columns, const Model& model) {
    const std::vector<bool> all(model.members.size(), true);
    return LeftOut(columns, model).loss(all, all);
}

Standing::Standing(FoldColumns& columns, Model chosen)
    : model(std::move(chosen)),
      weight(weight_of(columns.design(), model)),
      loss(loss_of(columns, model)) {}

std::string cause_of_member(const Design& design, const Model& model, std::size_t position) {
    const ColumnGroup& group = design.group(model.members[position]);
    return is_cause(group.kind) ? group.name : "";
}

bool is_jump(const Design& design, std::size_t group) {
    return design.group(group).machine_jump;
}

bool is_beside_drivers(const Design& design, const Model& model, const std::string& cause) {
    return std::none_of(model.members.begin(), model.members.end(), [&](std::size_t m) {
        const ColumnGroup& group = design.group(m);
        return group.name == cause && is_cause(group.kind) && group.kind != GroupKind::textbook &&
               !group.table.play;
    });
}

Contender against(FoldColumns& rows, const Standing& chosen, Model model) {
    Contender contender{std::move(model), 0.0};
    contender.ahead = weight_of(rows.design(), contender.model) - chosen.weight;
    const Saving saving = steady_saving_of(loss_of(rows, contender.model), chosen.loss);
    const double per_nat = 2.0 * chosen.model.variances.nu * chosen.model.variances.nu;
    contender.predicted = saving.sum / per_nat;
    contender.spread = saving.spread / per_nat;
    return contender;
}

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

/// True for the scale, a form or a ripple of positioning of an axis, but not for a play.
bool is_positioning_of(const ColumnGroup& group, Axis axis) {
    if (group.kind == GroupKind::table)
        return !group.table.play && group.table.axis.axis == axis &&
               group.table.motion == effects::EffectKind::positioning;
    return group.effect && group.effect->axis == axis &&
           (group.effect->kind == effects::EffectKind::scale ||
            group.effect->kind == effects::EffectKind::cyclic);
}

/// The best model with a course of time, whole, in place of a cause: poses follow each other in
/// time, and a course orthogonal to the textbook columns cannot do what these do.
Contender best_with_course(const Searching& search, const Standing& chosen, FoldColumns& rows,
                           const std::string& cause) {
    Design& design = search.design;
    Contender best;
    Model rest = chosen.model;
    for (std::size_t k = rest.members.size(); k-- > 0;) {
        const ColumnGroup& group = design.group(rest.members[k]);
        if (is_cause(group.kind) && group.name == cause) {
            if (is_course_of_time(group)) return best;
            rest = without(rest, k);
        }
    }
    for (std::size_t k = 0; k < design.groups().size(); ++k) {
        const ColumnGroup& course = design.group(k);
        if (!course.is_whole || !course.of_time) continue;
        Model model = rest;
        for (std::size_t m = model.members.size(); m-- > 0;)
            if (same_cause(design.group(model.members[m]), course)) model = without(model, m);
        model.members.push_back(k);
        model.variances.tau.push_back(1.0);
        model = pruned(design, search.setting, tuned(design, search.setting, std::move(model), 3));
        Contender contender = against(rows, chosen, std::move(model));
        if (contender.ahead > best.ahead) best = std::move(contender);
    }
    return best;
}

/// The best model with a ripple that the places do not resolve in place of a line of positioning
/// and of what stands beside it on the axis: few places turn a ripple into a line and a pattern,
/// and beside the pattern the search sees no ripple.
Contender best_with_ripple(const Searching& search, const Standing& chosen, FoldColumns& rows,
                           std::size_t position) {
    Design& design = search.design;
    const ColumnGroup held = design.group(chosen.model.members[position]);
    Contender best;
    for (std::size_t r = 0; r < design.groups().size(); ++r) {
        const Design::Entry& entry = design.groups()[r];
        if (!entry.only_rival || entry.group.kind != GroupKind::periodic || !entry.group.effect ||
            entry.group.effect->kind != effects::EffectKind::cyclic ||
            entry.group.effect->axis != held.effect->axis || !entry.moves_readings())
            continue;
        Model model = chosen.model;
        for (std::size_t k = model.members.size(); k-- > 0;)
            if (is_positioning_of(design.group(model.members[k]), *held.effect->axis))
                model = without(model, k);
        model.members.push_back(r);
        model.variances.tau.push_back(1.0);
        model = pruned(design, search.setting, tuned(design, search.setting, std::move(model), 3));
        Contender contender = against(rows, chosen, std::move(model));
        if (best.model.members.empty() || contender.ahead > best.ahead) best = std::move(contender);
    }
    return best;
}

}  // namespace

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
    if (Contender course = best_with_course(search, chosen, rows, cause);
        probability_against(course) < probability_against(best))
        best = std::move(course);
    for (std::size_t k = 0; k < chosen.model.members.size(); ++k) {
        const ColumnGroup& group = design.group(chosen.model.members[k]);
        if (group.name == cause && group.effect &&
            group.effect->kind == effects::EffectKind::thermal_drift) {
            Contender jump = best_with_jump(search, chosen, rows, k);
            if (jump.ahead > best.ahead) best = std::move(jump);
        }
        if (group.name == cause && group.kind == GroupKind::textbook &&
            group.effect->kind == effects::EffectKind::scale) {
            Contender ripple = best_with_ripple(search, chosen, rows, k);
            if (ripple.ahead > best.ahead) best = std::move(ripple);
        }
        if (group.name != cause || group.kind != GroupKind::textbook || group.shape.size() > 0 ||
            group.effect->kind != effects::EffectKind::straightness)
            continue;
        auto apart = with_slope_apart(search, chosen, rows, k);
        if (apart && apart->ahead > best.ahead) best = std::move(*apart);
    }
    return best;
}

}  // namespace trunnion::diagnosis
