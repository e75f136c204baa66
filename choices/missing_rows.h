// Places where rows of a log are missing, and the distance of its samples.
#pragma once

#include <string>

#include "choices/pairing.h"

namespace trunnion::choices {

/// Marks the rows after which others are missing (single jumps, far longer than any other distance
/// of samples), and sets the distance of samples: the third largest beside these. (A rapid move
/// that begins and ends between two samples may have gone as far, wherever they are; two gaps in a
/// log say nothing of its sampling.) Tells whether the samples are even: along straight ways most
/// distances are like their neighbours, and how many
/// distances of samples lie between two rows where single rows are missing. Nothing for ends of
/// moves. Returns notes for the jumps.
std::vector<std::string> mark_missing_rows(LogView& view);

}  // namespace trunnion::choices
