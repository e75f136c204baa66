// Words of a macro call -> local variables (argument specifications I and II).
#pragma once

#include "interpreter/block_words.h"
#include "interpreter/memory.h"

namespace trunnion::interpreter {

struct ArgumentRules {
    /// Parameter 3401#0 = 1: `X10` passes 10. 0: ten least increments for the letters of positions.
    bool whole_numbers_as_written = true;
    double increments_per_unit = 1000.0;
    /// G66.1 and parameter-called macros of that kind also pass G, L, N and P.
    bool pass_all = false;
};

/// Fills `locals` (the rest becomes vacant) from the words [first, last). I J K may come
/// repeatedly: the n-th set goes to #(3n+1).. . Alarm 129 for G, L, N, O, P; 1095 beyond ten sets.
void pass_arguments(const WordValue* first, const WordValue* last, const ArgumentRules& rules,
                    Locals& locals);

/// M98 P: a program number with the repeats packed in front of its last four digits, unless L says
/// the repeats.
struct SubprogramCall {
    int program = 0;
    int repeats = 1;
};
SubprogramCall unpack_subprogram(int p, int l, bool packed);

}  // namespace trunnion::interpreter
