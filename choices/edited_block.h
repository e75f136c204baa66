// The program with one block edited, as somebody may have done at the machine: what else explains a
// log.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "choices/compared_run.h"

namespace trunnion::choices {

/// One block with one word changed, or left out.
struct BlockEdit {
    int line = 0;
    std::string said;         ///< "line 12 reads X13.5"
    std::size_t numbers = 0;  ///< fitted: 1 for a number, 0 for another code or none
    ComparedRun run;          ///< of the edited program
};

struct EditQuestion {
    const Comparer& comparer;
    const setup::Setup& setup;
    const ComparedRun& run;                   ///< of the program as it is
    std::function<bool(std::size_t)> is_far;  ///< rows with a gap
    double least_gain = 0.0;                  ///< of the loss: what an edit must remove
};

/// Edits of the main program that remove as much: a number, a work offset, G41 for G42, H or D, or
/// a whole block, in the blocks where the gap begins and in those that set an origin. The best one
/// first. Every number with a point is tried by its derivative, so few runs are compared.
std::vector<BlockEdit> edits_of(const EditQuestion& question);

}  // namespace trunnion::choices
