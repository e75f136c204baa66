#include "diagnosis/rules/rules.h"

#include <algorithm>

namespace trunnion::diagnosis::rules {

double most_at_size(double sizes, bool to_the_noise) {
    if (sizes <= enormous) return 1.0;
    return 1.0 /
           (1.0 + (to_the_noise ? mistaken_odds_explained : mistaken_odds) * sizes / enormous);
}

double rival_limit(double contribution) {
    const double most = 0.3 * contribution;
    return std::min(most,
                    std::clamp(rival_part * contribution, rival_loss, std::max(rival_loss, most)));
}

}  // namespace trunnion::diagnosis::rules
