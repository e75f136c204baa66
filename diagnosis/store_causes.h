// The control's part of a gap, beside that of machine and devices.
#pragma once

#include <string>

#include "diagnosis/diagnosis.h"
#include "diagnosis/stores/store_gap.h"

namespace trunnion::diagnosis {

/// "G54 X is .. in force, .. in the setup": one line for a command that fits the machine only.
std::string words_of(const StoreGap& gap);

/// The control's part added to `d`, which is the gap of machine and devices at
/// the positions in force. `holdout`: rows held out, or null. The setup of `d` gets the stores in
/// force.
void add_store_gap(const setup::Setup& setup, const StoreGap& gap,
                   const records::ReadingTable* holdout, Diagnosis& d);

}  // namespace trunnion::diagnosis
