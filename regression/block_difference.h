// Differences between two blocks, in words.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace trunnion::regression {

/// "X54. instead of X45.", "C of opposite sign: ..", "decimal point lost: ..", "I J absolute
/// instead of incremental: .."; empty when both are equal, contain computed values, or differ in
/// more than three words. `start`: X Y Z at the start of A's block, as far as known, in the units
/// and frame of its words.
std::string block_difference(const std::string& a, const std::string& b,
                             const std::array<std::optional<double>, 3>& start);

/// X Y Z of a block, if they are plain numbers.
std::array<std::optional<double>, 3> position_words(const std::string& block);

}  // namespace trunnion::regression
