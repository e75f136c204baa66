// Run and direction in the name of a column or row: "1+", "Run 2 up", "3 rueck", "2-".
#pragma once

#include <string>

namespace trunnion::imports {

struct RunName {
    int run = 0, direction = 0;  ///< 0: not told
    bool other = false;          ///< a word that says something else: "mean up"
};

/// +1 or -1 for a word of a direction, 0 for another one.
int direction_of(std::string word);
RunName run_name(const std::string& name);

}  // namespace trunnion::imports
