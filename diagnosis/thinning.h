// Selection of rows from very long tables, as many as a search needs.
#pragma once

#include <optional>

#include "records/readings.h"

namespace trunnion::diagnosis {

/// About `most` device rows of a longer table; empty when the table has no more. Passes (ballbar,
/// laser, autocollimator, servo log): one row of each stretch of n, at varying positions so that no
/// period coincides with the selection; the first row of each test (its zero refers to it), and at
/// least 120 rows of each pass; rows of a servo log are told the commanded speed and acceleration
/// of the whole log. Poses (sphere, touches, points): every n-th pose completely; the pose before
/// it is kept as rows without device, because it defines the side of approach. The uncertainty of
/// parameters grows by the square root of n; they are not biased.
std::optional<records::ReadingTable> thinned(const records::ReadingTable& table, std::size_t most);

}  // namespace trunnion::diagnosis
