// Common variables of which a program takes the value that was there before it began.
#pragma once

#include <set>
#include <vector>

#include "interpreter/program_source.h"

namespace trunnion::choices {

/// #100-#199 and #500-#999 that the texts read before, or without, storing anything in them, in the
/// order of the lines; the main program first. At most `most_inherited`. A number that is computed
/// (#[#1+500]) names none.
std::set<int> inherited_variables(const std::vector<interpreter::ProgramText>& texts);

constexpr std::size_t most_inherited = 12;  ///< each costs a run of the program

}  // namespace trunnion::choices
