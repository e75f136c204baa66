// What a comparison of two programs could not see, in one line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "regression/compare_programs.h"

namespace trunnion::regression {

/// What a text holds that one run takes one way only.
struct OpenWays {
    bool branches = false;  ///< IF, GOTO, WHILE
    bool skips = false;     ///< blocks behind '/'
};
/// Comments aside. True in doubt.
OpenWays open_ways(std::string_view text);

/// "not compared: ..." with all reasons that hold for these runs and `more`; empty where nothing
/// was left aside. `a` is nullptr where a golden stands for it.
std::string left_aside(const RecordedRun* a, const RecordedRun& b,
                       const std::vector<interpreter::ProgramText>& programs,
                       const CompareOptions& options, std::vector<std::string> more);

}  // namespace trunnion::regression
