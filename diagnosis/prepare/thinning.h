// Selection of rows from very long tables, as many as a search needs.
#pragma once

#include <optional>

#include "records/readings.h"

namespace trunnion::diagnosis {

/// About `most` device rows of a longer table; empty when the table has no more. Places (sphere,
/// touches, points, targets of a laser or autocollimator) all stay while they are no more than half
/// of `most`: few readings of one device beside the stream of another are what was asked for. Of
/// streams (ballbar, servo log), and of more places than that: of passes one row of each stretch of
/// n, at varying positions so that no period coincides with the selection; the first row of each
/// test (its zero refers to it), and at least 120 rows of each pass; each row keeps its
/// motion among all rows (Reading::among_all), a servo log's behind the time `constants` of the
/// drives too.
/// Of poses every n-th completely; the pose before it is kept as rows without device, because it
/// defines the side of approach. The uncertainty of parameters grows by the square root of n; they
/// are not biased.
std::optional<records::ReadingTable> thinned(const records::ReadingTable& table, std::size_t most,
                                             const TimeConstants& constants = {});

}  // namespace trunnion::diagnosis
