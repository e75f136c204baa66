// Passes words of a macro call to local variables (argument specifications I and II).
#pragma once

#include "interpreter/block_words.h"
#include "interpreter/memory.h"

namespace trunnion::interpreter {

struct ArgumentRules {
    /// Parameter 3401#0 = 1: `X10` passes 10. 0: ten least increments for position addresses.
    bool whole_numbers_as_written = true;
    double increments_per_unit = 1000.0;
    /// G66.1 and G codes that call macros in the same way also pass G, L, N and P.
    bool pass_all = false;
};

/// Sets `locals` from the words [first, last); all others become vacant. I J K may be repeated: set
/// n goes to #(3n+1)... Alarm 129 for G, L, N, O, P; 1095 for more than ten sets.
void pass_arguments(const WordValue* first, const WordValue* last, const ArgumentRules& rules,
                    Locals& locals);

/// M98 P: a program number. Digits in front of its last four are the repeat count, unless L gives
/// it.
struct SubprogramCall {
    int program = 0;
    int repeats = 1;
};
SubprogramCall unpack_subprogram(int p, int l, bool packed);

}  // namespace trunnion::interpreter
