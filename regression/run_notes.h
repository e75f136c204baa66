// Notes of a comparison about its two runs, besides differences.
#pragma once

#include <string>
#include <vector>

#include "regression/compare_programs.h"

namespace trunnion::regression {

/// The notes of the runs, with the side if only one has it. `a` is nullptr for a golden.
std::vector<std::string> notes_of(const RecordedRun* a, const RecordedRun& b);

}  // namespace trunnion::regression
