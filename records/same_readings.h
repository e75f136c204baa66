// A table of readings that is given twice.
#pragma once

#include "records/readings.h"

namespace trunnion::records {

/// Throws InputError when the rows of `next` stand in `first` already: as repeats, or held out, the
/// same values would look like a second measurement without noise.
void refuse_same_readings(const ReadingTable& first, const ReadingTable& next);

}  // namespace trunnion::records
