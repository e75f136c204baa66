// Effects of many parameters that stand in for two others.
#pragma once

#include "diagnosis/search/search.h"

namespace trunnion::diagnosis {

/// One of many parameters replaced by two of few, tuned.
struct TwoInstead {
    std::size_t first = 0, second = 0;  ///< groups
    Model model;
    double known = 0.0;  ///< nats for what is known beforehand: two effects that do what the angles
                         ///< of an axis do are no coincidence, but other names of the same
};
/// The best few of the pairs that may stand in place of a member; none for an effect of one
/// parameter, and for large models. A pair has no more parameters than the member.
std::vector<TwoInstead> two_instead(Design& design, const SearchSetting& setting,
                                    const Model& model, std::size_t position);

/// Two effects of few parameters in place of one of many, where that is better: each of the two
/// alone may explain little, so that no exchange of single members finds them. All pairs are tried
/// beside the other members, with one variance for both; the best few are tuned. Small models only
/// (pairs_up_to).
Model without_stand_ins(Design& design, const SearchSetting& setting, Model model);

}  // namespace trunnion::diagnosis
