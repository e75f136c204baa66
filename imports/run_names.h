// Run and direction from the name of a column or row: "1+", "Run 2 up", "3 rueck", "2-".
#pragma once

#include <string>

namespace trunnion::imports {

struct RunName {
    int run = 0, direction = 0;  ///< 0: not given
    bool other = false;          ///< contains a word of another meaning: "mean up"
};

/// +1 or -1 for a word of a direction, 0 for any other word.
int direction_of(std::string word);
RunName run_name(const std::string& name);

}  // namespace trunnion::imports
