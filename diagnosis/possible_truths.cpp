// What may be true instead of the chosen set, for the interval of the shrink.
#include <algorithm>
#include <array>
#include <cmath>

#include "diagnosis/diagnoser.h"

namespace trunnion {
namespace {

constexpr std::size_t most_truths = 40;
/// Changes of a key, in its logarithm, and the range each stands for.
constexpr std::array<double, 6> key_steps{0.005, 0.02, 0.05, 0.1, 0.2, 0.4};
constexpr std::array<double, 6> step_widths{0.01, 0.022, 0.04, 0.075, 0.15, 0.2};
constexpr double own_width = 0.005;

}  // namespace

/// The chosen set with a searched key a little larger or smaller: the readings leave it open how
/// long a time constant or a decay is. Weighted like a distribution over the key, all together 1.
std::vector<PossibleTruth> Diagnoser::near_truths() {
    std::vector<PossibleTruth> truths{{columns_of(*design_, set_.members), set_.scale, 1.0}};
    struct Near {
        std::size_t member, candidate;
        double width;
    };
    std::vector<Near> list;
    for (const std::size_t m : set_.members) {
        const Candidate chosen = design_->candidates()[m];
        for (std::size_t j = 0; j < chosen.effect->parameters.size(); ++j) {
            const EffectParameter& p = chosen.effect->parameters[j];
            if (!p.is_key() || !p.refine) continue;
            for (std::size_t k = 0; k < key_steps.size(); ++k)
                for (const double sign : {-1.0, 1.0}) {
                    std::vector<double> values = chosen.values;
                    values[j] *= std::exp(sign * key_steps[k]);
                    list.push_back({m, design_->add(*chosen.effect, values, chosen.log_prior),
                                    step_widths[k]});
                }
        }
    }
    if (list.empty()) return truths;
    design_->update();
    double sum = 1.0;
    for (const Near& near : list) {
        std::vector<std::size_t> members = set_.members;
        std::replace(members.begin(), members.end(), near.member, near.candidate);
        std::sort(members.begin(), members.end());
        const EffectSet set = evaluate(*design_, members, search_options());
        const double weight =
            std::exp(set.log_evidence - set_.log_evidence) * near.width / own_width;
        if (weight < 1e-4) continue;
        truths.push_back({columns_of(*design_, members), set.scale, weight});
        sum += weight;
    }
    for (PossibleTruth& t : truths) t.weight /= sum;
    return truths;
}

/// The chosen set and others that may be true instead, as truths to draw from.
ShrinkDraws Diagnoser::shrink_draws(const std::vector<EffectSet>& sets) {
    std::vector<PossibleTruth> truths = near_truths();
    const double best = sets.front().log_evidence;
    for (PossibleTruth& t : truths) t.weight *= std::exp(set_.log_evidence - best);
    for (const EffectSet& s : sets)
        if (s.members != set_.members && truths.size() < most_truths)
            truths.push_back(
                {columns_of(*design_, s.members), s.scale, std::exp(s.log_evidence - best)});
    const FreshReadings fresh(base_, catalogue_, table_, replay_, blocks_, options_.seed);
    return {*design_,
            blocks_,
            fresh,
            noise_mm(),
            used_,
            std::move(truths),
            result_.unexplained_share,
            options_.seed,
            noise_doubt(),
            independent_readings()};
}

}  // namespace trunnion
