// NC lines that print the stores in force, at the head of a measuring program.
#pragma once

#include <string>

#include "setup/right_stores.h"

namespace trunnion::setup {

/// G54 with the external offset, 1001#0 INCH and 19700-19714 as far as they count on this machine,
/// by DPRNT: `STORE G54 X.. Y.. Z..`, `STORE INCH 0`, `STORE N19704 V..`, and the
/// date (#3011, `STORE DATE V20260301`). Writes #7 #8 #9. What a Hurco keeps in its part set-up has
/// no number to read: only G54 and INCH.
std::string store_prints(const RotaryStores& stores, bool hurco);

}  // namespace trunnion::setup
