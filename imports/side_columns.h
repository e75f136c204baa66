// What stands beside the readings of an ISO 230-2 table and is none: results, conditions, numbers.
#pragma once

#include <string>

#include "imports/text_table.h"

namespace trunnion::imports {

/// Only results: "X_avg", "B", "2s".
bool is_result(const TextColumn& column);
/// A temperature or a time at a target.
bool is_condition(const TextColumn& column);
/// More results, numbers of points and remarks, as the names of columns beside runs and of rows
/// below targets have them: "Umkehrspanne", "Pos. Nr.".
bool is_beside_runs(const TextColumn& column);
/// Conditions, numbers of points and remarks only.
bool is_beside_values(const TextColumn& column);
/// A result as the name of a row: "Mean", "Max-Min", "2 s".
bool is_result_row_name(const std::string& name);

}  // namespace trunnion::imports
