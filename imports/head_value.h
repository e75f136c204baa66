// The value behind the key of a line above a table.
#pragma once

#include <string>
#include <string_view>

namespace trunnion::imports {

/// "40" of ": 40;;", "40 in/min" of ";40;in/min", "1,000" of ": 1,000" (no number here). `cuts`:
/// the signs between key and value, then (from the third on) those between values.
std::string head_value(std::string_view text, const std::string& cuts);

}  // namespace trunnion::imports
