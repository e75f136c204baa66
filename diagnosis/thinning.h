// Very long tables: readings chosen evenly, as many as a search needs.
#pragma once

#include <optional>

#include "records/readings.h"

namespace trunnion::diagnosis {

/// At most about `most` device rows of a longer table; nothing when the table has no more. Of
/// passes (ballbar, laser, autocollimator, servo log) one row in each stretch of n, not always the
/// same one, so that no period falls in step with the choice; the first row of each test stays (its
/// zero counts from there), and at least 120 rows of each pass. Of poses (sphere, touches, points)
/// every n-th whole; the pose before it stays as rows without a device, because it tells the side
/// of approach. Parameters become less sure by the root of n, not biased.
std::optional<records::ReadingTable> thinned(const records::ReadingTable& table, std::size_t most);

}  // namespace trunnion::diagnosis
