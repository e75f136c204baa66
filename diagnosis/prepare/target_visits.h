// The visits of the targets of a laser or an autocollimator (target_visits.cpp).
#pragma once

#include <vector>

#include "diagnosis/prepare/prepare.h"

namespace trunnion::diagnosis {

/// Puts the visits of one target of a test into different folds, as far as there are folds. Where
/// all its visits were left out at once, nothing would be known of that target, and an error that
/// each target has for itself would not be predicted. Folds of one group each stay as they are.
void spread_visits(const std::vector<NoiseBlock>& blocks, const emulator::Replay& replay,
                   const records::ReadingTable& table, Folds& folds);

}  // namespace trunnion::diagnosis
