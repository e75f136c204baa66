// An edited block beside the causes that a search found.
#pragma once

#include <string>
#include <vector>

#include "choices/gap_causes.h"

namespace trunnion::choices {

/// An edit of one block that explains as much as a cause, or as all of them, shares the probability
/// and is a rival. `causes`: in the order of the steps.
void share_with_edits(const GapQuestion& question, const GapSearch& found, const Judged& by,
                      std::vector<GapCause>& causes);

/// An edit is among its rivals: the setup with the cause would be wrong for every other program.
bool may_be_edit(const GapCause& cause);

/// The edit of one block with which the log agrees, in words; empty: none does. `found`: what stays
/// beside its causes may be the edit, too.
std::string agreeing_edit(const GapQuestion& question, const GapSearch& found,
                          const ComparedRun& base, const Judged& by);

}  // namespace trunnion::choices
