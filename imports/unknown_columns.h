// Columns of a log that nobody reads.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "geometry/axis_names.h"
#include "imports/text_table.h"

namespace trunnion::imports {

/// Names of columns beside `used` that are neither positions, speeds and errors of axes nor columns
/// of a trace or of readings: what they hold is not judged, and may be what was meant.
std::vector<std::string> unknown_columns(const TextTable& table, const AxisNames& axes,
                                         const std::set<std::size_t>& used);

}  // namespace trunnion::imports
