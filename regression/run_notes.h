// What a comparison has to say about its two runs besides differences.
#pragma once

#include <string>
#include <vector>

#include "regression/compare_programs.h"

namespace trunnion::regression {

/// The runs' own notes, with the side where only one has it. `a` is nullptr where a golden stands
/// for it.
std::vector<std::string> notes_of(const RecordedRun* a, const RecordedRun& b);

}  // namespace trunnion::regression
