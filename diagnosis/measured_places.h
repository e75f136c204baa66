// Tables and ripples that hold at the places where they were measured, and are written for these
// alone (measured_places.cpp).
#pragma once

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// True for a ripple whose period the targets of an axis leave open: its values there are
/// known, whatever its period.
bool is_ripple_of_places(const Outcome& f, std::size_t group);

/// True for such a ripple, and for a table of a laser, autocollimator, tracker or CMM that holds at
/// its positions alone. These are all the positions that were read, so left-out readings at the
/// same positions confirm it; it is written for them only.
bool holds_at_places(const Outcome& f, std::size_t group);

}  // namespace trunnion::diagnosis
