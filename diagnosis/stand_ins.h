// Effects of many parameters that stand in for two others.
#pragma once

#include "diagnosis/search.h"

namespace trunnion::diagnosis {

/// Two effects of few parameters in place of one of many, where that is better: each of the two
/// alone may explain little, so that no exchange of single members finds them. All pairs are tried
/// beside the other members, with one variance for both; the best few are tuned. Small models only
/// (pairs_up_to).
Model without_stand_ins(Design& design, const SearchSetting& setting, Model model);

}  // namespace trunnion::diagnosis
