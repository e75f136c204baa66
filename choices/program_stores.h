// Which of a control's many stores a program may use.
#pragma once

#include <set>
#include <vector>

#include "interpreter/program_source.h"

namespace trunnion::choices {

struct ProgramStores {
    std::set<int> offsets;     ///< numbers of H, D and T: empty ones may be those of the other
                               ///< control
    std::set<int> additional;  ///< P of G54.1, for the same reason
    std::set<int> fixture;     ///< P of G54.2
    std::set<int> variables;   ///< common variables that it reads before it stores anything there
    /// A G52 or G92 that an earlier program left in force, where it is not just another external
    /// offset: this program has such codes itself.
    bool left_local = false, left_preset = false;
};

/// From the words of the texts, the main program first.
ProgramStores stores_of(const std::vector<interpreter::ProgramText>& texts);

}  // namespace trunnion::choices
