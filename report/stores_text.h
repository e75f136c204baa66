// What to type into a control, as lines that a person can type from.
#pragma once

#include <string>

#include "setup/right_stores.h"

namespace trunnion::report {

/// A line for each number (in force, to type, change), the sets of G54.2 that are counted from G54,
/// and how far the tip is off on the table before and after. A Hurco has no numbers 1970x: there
/// the lines name the fields of its part set-up (names assumed).
std::string stores_text(const setup::StoresToType& stores, interpreter::DialectFamily dialect);

}  // namespace trunnion::report
