// A path as numbers in a text file, for comparison when no older program is kept.
#pragma once

#include <string>
#include <vector>

#include "regression/path_record.h"

namespace trunnion::regression {

/// CSV with a head of comments: the reasons (newest first) and a line for each tool, so that a
/// change is readable in a review. One row for each line or arc of the tip in the table frame;
/// consecutive lines in the same direction with the same feed are one row. Numbers to 1e-6.
std::string format_golden(const PathRecord& path, const std::vector<std::string>& reasons);

struct Golden {
    PathRecord path;
    std::vector<std::string> reasons;  ///< newest first
};
/// Throws InputError with line and column.
Golden parse_golden(const std::string& text, const std::string& path);

}  // namespace trunnion::regression
