// Readings that a log repeats because it is faster than its sensor.
#pragma once

#include <optional>

#include "records/readings.h"

namespace trunnion::diagnosis {

/// The table with one of each run of copies: rows at one position with exactly the value of the row
/// before them. Empty unless such rows are at least 10 and more than half of those that follow
/// another one at its position, and far more than the few digits of the values bring about by
/// chance. Copies tell nothing of the noise, and are no readings of their own.
std::optional<records::ReadingTable> without_copies(const records::ReadingTable& table);

}  // namespace trunnion::diagnosis
