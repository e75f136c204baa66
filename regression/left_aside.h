// The limits of a comparison of two programs, in one line.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "regression/compare_programs.h"

namespace trunnion::regression {

/// Branches in a text of which a run takes only one.
struct OpenWays {
    bool branches = false;  ///< IF, GOTO, WHILE
    bool skips = false;     ///< blocks with '/'
};
/// Ignores comments. True in doubt.
OpenWays open_ways(std::string_view text);

/// "not compared: ..." with all reasons that apply to these runs, and `more`; empty when everything
/// was compared. `a` is nullptr for a golden.
std::string left_aside(const RecordedRun* a, const RecordedRun& b,
                       const std::vector<interpreter::ProgramText>& programs,
                       const CompareOptions& options, std::vector<std::string> more);

}  // namespace trunnion::regression
