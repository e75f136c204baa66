// Executes one block of words in the fixed order of a control, independent of the written order.
#pragma once

#include "controller/control.h"
#include "interpreter/block_words.h"

namespace trunnion::controller {

/// Executes a block:
///   speed, feed and units codes - F S T - M codes that act before motion - plane, reading, work
///   offset, frame and offset codes - one-shot code or motion - M codes that act after motion.
/// An alarm without a column gets that of the code or word at fault.
void execute_block(Control& c, const interpreter::BlockWords& block);

/// Raises the alarms that the words alone cause, in whatever state the block is reached.
void read_block(Control& c, const interpreter::BlockWords& block);

}  // namespace trunnion::controller
