// NC lines that print the active stores, for the start of a measuring program.
#pragma once

#include <string>

#include "setup/right_stores.h"

namespace trunnion::setup {

/// Prints G54 with the external offset, 1001#0 INCH, those of 19700-19714 that matter on this
/// machine, and the date (#3011) by DPRNT: `STORE G54 X.. Y.. Z..`, `STORE INCH 0`, `STORE N19704
/// V..`, `STORE H1 V..` (geometry plus wear; a comment tells what to delete on a control with tool
/// offset memory A), `STORE DATE V20260301`. `probe_offset`: offset number of the probe as an NC
/// expression, empty without one. Writes #7 #8 #9. The part set-up of a Hurco has no readable
/// number, so there only G54, INCH and H.
std::string store_prints(const RotaryStores& stores, bool hurco, const std::string& probe_offset);

}  // namespace trunnion::setup
