// Run and direction from the name of a column or row: "1+", "Run 2 up", "3 rueck", "2-".
#pragma once

#include <string>

namespace trunnion::imports {

struct RunName {
    int run = 0, direction = 0;  ///< 0: not given
    bool other = false;          ///< contains a word of another meaning: "mean up"
    bool lone_r = false;         ///< the direction is that of "R1": reverse, or run 1
};

/// The directions that are understood, for messages.
constexpr const char* accepted_directions =
    "+ and -, up and down (dn), forward and reverse (backward, back), vor and zurueck, hin and "
    "rueck, arrows";

/// +1 or -1 for a word of a direction, 0 for any other word.
int direction_of(const std::string& word);
/// A name that tells both directions has none, but a word of another meaning.
RunName run_name(const std::string& name);

}  // namespace trunnion::imports
