// Effects that can stand in for a claimed one on these readings, and the belief in each.
#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/diagnoser.h"
#include "diagnosis/rules.h"

namespace trunnion {
namespace {

constexpr double negligible_nats = 12.0;  ///< sets this much worse than the best carry no belief

std::vector<std::size_t> without(std::vector<std::size_t> members, std::size_t member) {
    std::erase(members, member);
    return members;
}

}  // namespace

/// The chosen set with `member` replaced by each candidate that it does not hold yet.
std::vector<EffectSet> Diagnoser::swapped_sets(std::size_t member) const {
    const std::vector<std::size_t> others = without(set_.members, member);
    const auto& candidates = design_->candidates();
    std::vector<EffectSet> sets;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (!candidates[k].visible || k == member) continue;
        const bool taken = std::any_of(others.begin(), others.end(), [&](std::size_t o) {
            return candidates[o].effect == candidates[k].effect;
        });
        if (taken) continue;
        std::vector<std::size_t> members = others;
        members.insert(std::upper_bound(members.begin(), members.end(), k), k);
        sets.push_back(evaluate(*design_, std::move(members), search_options()));
    }
    return sets;
}

/// Sets that may be true, best first: those the search met, and the chosen one with each effect
/// replaced or left out.
std::vector<EffectSet> Diagnoser::possible_sets() const {
    std::vector<EffectSet> sets = visited_;
    sets.push_back(set_);
    for (const std::size_t m : set_.members) {
        sets.push_back(evaluate(*design_, without(set_.members, m), search_options()));
        for (EffectSet& s : swapped_sets(m)) sets.push_back(std::move(s));
    }
    std::sort(sets.begin(), sets.end(), [](const EffectSet& a, const EffectSet& b) {
        return a.log_evidence != b.log_evidence ? a.log_evidence > b.log_evidence
                                                : a.members < b.members;
    });
    const double best = sets.front().log_evidence;
    std::set<std::vector<std::size_t>> met;
    std::erase_if(sets, [&](const EffectSet& s) {
        const bool weak = s.log_evidence < best - negligible_nats;
        return (weak && s.members != set_.members) || !met.insert(s.members).second;
    });
    return sets;
}

/// Belief in each effect: weight of the sets that hold it among all, and among an unknown cause
/// that follows one driver.
std::map<std::string, double> Diagnoser::belief_of(const std::vector<EffectSet>& sets) const {
    std::map<std::string, double> belief;
    const double best = std::max(sets.front().log_evidence, unknown_evidence_);
    double sum = std::exp(unknown_evidence_ - best);
    for (const EffectSet& s : sets) {
        const double weight = std::exp(s.log_evidence - best);
        sum += weight;
        for (const std::size_t m : s.members)
            belief[design_->candidates()[m].effect->name] += weight;
    }
    belief["unknown"] = std::exp(unknown_evidence_ - best);
    for (auto& [name, weight] : belief) weight /= sum;
    return belief;
}

std::vector<std::string> Diagnoser::rivals_of(std::size_t member) const {
    const EffectSet rest = evaluate(*design_, without(set_.members, member), search_options());
    const double contribution = set_.explained - rest.explained;
    const double most = rules::rival_limit(contribution);
    const auto& candidates = design_->candidates();
    std::vector<std::pair<double, std::string>> rivals;  // evidence lost, name
    for (const EffectSet& swapped : swapped_sets(member)) {
        if (set_.explained - swapped.explained > most) continue;
        const auto in =
            std::find_if(swapped.members.begin(), swapped.members.end(), [&](std::size_t k) {
                return !std::binary_search(set_.members.begin(), set_.members.end(), k);
            });
        const Effect* effect = candidates[*in].effect;
        if (effect == candidates[member].effect) continue;
        const double worse = set_.log_evidence - swapped.log_evidence;
        const auto same = std::find_if(rivals.begin(), rivals.end(),
                                       [&](const auto& r) { return r.second == effect->name; });
        if (same == rivals.end())
            rivals.emplace_back(worse, effect->name);
        else
            same->first = std::min(same->first, worse);
    }
    std::sort(rivals.begin(), rivals.end());
    std::vector<std::string> names;
    for (auto& [worse, name] : rivals) names.push_back(std::move(name));
    return names;
}

}  // namespace trunnion
