// Effects that can stand in for a claimed one on these readings, and its probability.
#include <algorithm>
#include <cmath>

#include "diagnosis/diagnoser.h"
#include "diagnosis/rules.h"

namespace trunnion {

std::vector<std::string> Diagnoser::rivals_of(std::size_t member, double& probability) const {
    std::vector<std::size_t> others;
    for (const std::size_t m : set_.members)
        if (m != member) others.push_back(m);
    const EffectSet rest = evaluate(*design_, others, search_options());
    const double contribution = set_.explained - rest.explained;
    struct Rival {
        std::string name;
        double evidence;
    };
    std::vector<Rival> rivals;
    double sum = 1.0;
    const auto& candidates = design_->candidates();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        if (!candidates[k].visible || candidates[k].effect == candidates[member].effect) continue;
        const bool taken = std::any_of(others.begin(), others.end(), [&](std::size_t o) {
            return candidates[o].effect == candidates[k].effect;
        });
        if (taken) continue;
        std::vector<std::size_t> members = others;
        members.push_back(k);
        std::sort(members.begin(), members.end());
        const EffectSet swapped = evaluate(*design_, members, search_options());
        const double loss = set_.explained - swapped.explained;
        if (loss > std::clamp(rules::rival_part * contribution, rules::rival_loss,
                              std::max(rules::rival_loss, 0.3 * contribution)) ||
            loss > 0.3 * contribution)
            continue;
        const double worse = set_.log_evidence - swapped.log_evidence;
        const auto same = std::find_if(rivals.begin(), rivals.end(), [&](const Rival& r) {
            return r.name == candidates[k].effect->name;
        });
        if (same != rivals.end()) {
            same->evidence = std::min(same->evidence, worse);
            continue;
        }
        rivals.push_back({candidates[k].effect->name, worse});
    }
    std::sort(rivals.begin(), rivals.end(),
              [](const Rival& a, const Rival& b) { return a.evidence < b.evidence; });
    std::vector<std::string> names;
    for (const Rival& r : rivals) {
        sum += std::exp(-std::min(std::max(0.0, r.evidence), rules::parsimony_nats));
        names.push_back(r.name);
    }
    const double with = set_.log_evidence, without = rest.log_evidence;
    probability = 1.0 / (sum + std::exp(std::clamp(without - with, -50.0, 50.0)));
    return names;
}

}  // namespace trunnion
