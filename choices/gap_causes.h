// The causes that a search found: what each one does, and how sure it is.
#pragma once

#include <limits>
#include <vector>

#include "choices/control_gap.h"
#include "choices/gap_search.h"
#include "choices/gap_teller.h"

namespace trunnion::choices {

constexpr double infinite_loss = std::numeric_limits<double>::infinity();

struct Judged {
    const Comparer& comparer;
    const Teller& teller;
    const std::vector<int>& blocks;
    double excess;     ///< of the loss, over noise
    double row_limit;  ///< loss of a row that noise may have
    double beside;     ///< that a row may have beside its cause: noise, or what stays in most rows
};

/// Limits the probability by the number of blocks that depend on the cause, and by a part that is
/// explained.
void cap_probability(GapCause& cause, double explained);

/// Step `k` of a search.
GapCause cause_of(const GapQuestion& question, const GapSearch& found, std::size_t k,
                  const Judged& by);

/// A cause that improves nothing without another one is at most as sure as that one. `causes`: in
/// the order of the steps.
void cap_by_needed(const GapQuestion& question, const GapSearch& found, const Judged& by,
                   std::vector<GapCause>& causes);

}  // namespace trunnion::choices
