// Values to enter into a control, as lines to type from.
#pragma once

#include <set>
#include <string>

#include "setup/right_stores.h"

namespace trunnion::report {

/// One line for each value (active, to enter, change), the sets of G54.2 relative to G54, and the
/// tip error on the table before and after. A Hurco has no parameters 1970x; there the lines name
/// the fields of its part set-up (names assumed).
/// The lines named in `open` are marked: the readings do not determine them.
std::string stores_text(const setup::StoresToType& stores, interpreter::DialectFamily dialect,
                        const std::set<std::string>& open = {});

}  // namespace trunnion::report
