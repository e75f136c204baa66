// Differences between two blocks, in words.
#pragma once

#include <array>
#include <optional>
#include <string>

namespace trunnion::regression {

struct BlockDifference {
    std::string name;   ///< "C of opposite sign", "decimal point lost"; empty: a change of its own
    std::string words;  ///< "X54. instead of X45."; empty: no difference that can be told
};
/// Empty when both are equal, contain computed values, or differ in more than three words without
/// a common name. `start`: X Y Z at the start of A's block, as far as known, in the units and frame
/// of its words.
BlockDifference block_difference(const std::string& a, const std::string& b,
                                 const std::array<std::optional<double>, 3>& start);
/// "decimal point lost: X45 instead of X45."
std::string text_of(const BlockDifference& difference);

/// X Y Z of a block, if they are plain numbers.
std::array<std::optional<double>, 3> position_words(const std::string& block);

}  // namespace trunnion::regression
