// Tables that hold at the places where they were measured, and are written for these alone
// (measured_places.cpp).
#pragma once

#include "diagnosis/diagnosis_report.h"

namespace trunnion::diagnosis {

/// True for a table of a laser, autocollimator, tracker or CMM that holds at its positions alone.
/// These are all the positions that were read, so left-out readings at the same positions confirm
/// it; it is written for them only.
bool holds_at_places(const Outcome& f, std::size_t group);

}  // namespace trunnion::diagnosis
