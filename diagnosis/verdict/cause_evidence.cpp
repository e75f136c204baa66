#include "diagnosis/verdict/cause_evidence.h"

#include <algorithm>
#include <cmath>

namespace trunnion::diagnosis {

bool are_forms_of_one_axis(const ColumnGroup& a, const ColumnGroup& b) {
    return a.kind == GroupKind::table && b.kind == GroupKind::table &&
           are_kindred(a.table, b.table);
}

double log_sum(const std::vector<double>& values) {
    const double most = *std::max_element(values.begin(), values.end());
    double sum = 0.0;
    for (const double v : values) sum += std::exp(v - most);
    return most + std::log(sum);
}

namespace {

constexpr std::size_t rivals_tried = 20;
constexpr std::size_t replacements_tried = 3;  ///< of each other cause

/// True when another free form of the same axis makes the family of a free form doubtful. What an
/// angular error does on the only line that was measured is positioning and straightness by their
/// definition (ISO 230-1), so an angular form makes only angular forms doubtful.
bool makes_doubtful(const ColumnGroup& own, const ColumnGroup& other) {
    return are_forms_of_one_axis(own, other) &&
           (own.table.motion == effects::EffectKind::angular ||
            other.table.motion != effects::EffectKind::angular);
}

/// True for a ripple of the axis whose positioning errors the table gives.
bool is_ripple_of(const ColumnGroup& table, const ColumnGroup& other) {
    return table.kind == GroupKind::table &&
           table.table.motion == effects::EffectKind::positioning && other.effect &&
           other.effect->kind == effects::EffectKind::cyclic &&
           other.effect->axis == table.table.axis.axis;
}

double nats_of(const Design& design, const Offer& o) {
    return o.gain.best + design.group(o.group).log_prior;
}

/// Logarithms of the posterior weights of models, relative to the chosen one: each with its own
/// noise and averaged over the sizes of its members.
class Weights {
  public:
    Weights(const Searching& search, const Model& chosen)
        : search_(search), chosen_(evidence(search.design, chosen)) {}

    /// `lost`: nats that the model loses with the noise of the chosen one. With its own noise it
    /// loses less, but at least as much as with noise that is free; if that is too much, its
    /// weight is 0.
    void add(const Model& model, double lost, std::vector<double>& list) const {
        const double freedom = std::max(1.0, search_.design.freedom());
        if (lost > 0.0 && 0.5 * freedom * std::log1p(2.0 * lost / freedom) > most_lost) return;
        const double nats =
            evidence(search_.design, tuned(search_.design, search_.setting, model, 1)) - chosen_;
        // Sizes at which no likelihood can be computed are those of no rival.
        if (std::isfinite(nats) || !std::isfinite(chosen_)) list.push_back(nats);
    }

  private:
    static constexpr double most_lost = 12.0;
    const Searching& search_;
    double chosen_;
};

/// Adds models without member k in which another cause is replaced as well: one effect may do what
/// two are claimed for. None for large models.
void weigh_one_for_two(const Searching& search, const Model& model, const Offer& held,
                       const Weights& weights, std::vector<double>& list) {
    Design& design = search.design;
    if (model.members.size() > pairs_up_to) return;
    const auto k = std::find(model.members.begin(), model.members.end(), held.group);
    const Model rest = without(model, static_cast<std::size_t>(k - model.members.begin()));
    const std::vector<Offer> worth = worth_of_members(design, rest);
    for (std::size_t m = 0; m < rest.members.size(); ++m) {
        const std::string& replaced = design.group(rest.members[m]).name;
        if (!is_cause(design.group(rest.members[m]).kind)) continue;
        const Model none = without(rest, m);
        std::size_t count = 0;
        for (const Offer& o : offers(design, none, is_cause)) {
            const std::string& name = design.group(o.group).name;
            if (name == replaced || name == design.group(held.group).name) continue;
            if (count++ == replacements_tried) break;
            weights.add(with(none, o),
                        nats_of(design, held) + nats_of(design, worth[m]) - nats_of(design, o),
                        list);
        }
    }
}

}  // namespace

EvidenceOf evidence_of(const Searching& search, const Model& model, const Offer& held,
                       const Alternatives& instead, double zeta) {
    const Design& design = search.design;
    const ColumnGroup& cause = design.group(held.group);
    const Weights weights(search, model);
    const auto k = std::find(model.members.begin(), model.members.end(), held.group);
    const Model rest = without(model, static_cast<std::size_t>(k - model.members.begin()));
    const double own = nats_of(design, held);
    std::vector<double> same{0.0}, kindred, other;
    weights.add(rest, own, other);
    std::size_t count = 0;
    for (const Offer& o : instead.others) {
        if (o.group == held.group) continue;
        if (count++ == rivals_tried) break;
        const ColumnGroup& group = design.group(o.group);
        const bool again =
            group.name == cause.name || (instead.at_places && is_ripple_of(cause, group));
        std::vector<double>& list = again ? same : makes_doubtful(cause, group) ? kindred : other;
        const std::size_t before = list.size();
        weights.add(with(rest, o), own - nats_of(design, o), list);
        if (list.size() == before) continue;
        list.back() -= unusual_size(design, o);
        // A ripple that the places do not resolve has the values of a slow wave there. That is a
        // form of the table, of no more numbers: the ripple is no more likely.
        if (is_ripple_of(cause, group) && design.groups()[o.group].only_rival)
            list.back() = std::min(list.back(), 0.0);
    }
    weigh_one_for_two(search, model, held, weights, other);
    for (const TwoInstead& pair : instead.pairs) {
        weights.add(pair.model, 0.0, other);
        other.back() += pair.known;
    }
    for (auto* list : {&same, &kindred, &other})
        for (double& w : *list) w *= zeta;
    const double of_same = log_sum(same);
    kindred.push_back(of_same);
    const double of_axis = log_sum(kindred);
    other.push_back(of_axis);
    const double all = log_sum(other);
    // A search that was ended early may leave variances at which no likelihood can be computed.
    if (!std::isfinite(all)) return {0.0, 0.0};
    return {std::exp(of_same - all), std::exp(of_axis - all)};
}

}  // namespace trunnion::diagnosis
