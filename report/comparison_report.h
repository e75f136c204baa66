// A comparison in all its output formats, a file for each: comparison_*.cpp.
#pragma once

#include <string>

#include "regression/comparison.h"
#include "report/page.h"

namespace trunnion::report {

enum class ReportFormat : unsigned char { text, json, junit, sarif, github, html, markdown };
/// The format with this name on the command line; throws InputError that lists all names.
ReportFormat report_format(const std::string& name);

std::string format_comparison(const regression::CompareReport& report, ReportFormat format);

std::string comparison_text(const regression::CompareReport& report);
/// JSON, see docs/compare.md.
std::string comparison_json(const regression::CompareReport& report);
/// For step summaries: the verdict, a table of the programs that differ, and their first
/// differences.
std::string comparison_markdown(const regression::CompareReport& report);
/// The page without its origin: causes first, both paths with the first and the worst place, tools.
Page comparison_page(const regression::CompareReport& report);

/// Result of one shard of a suite: all data of a report as JSON, and back.
struct ComparePart {
    regression::CompareReport report;  ///< cases of this shard only
    std::vector<std::size_t> places;   ///< their numbers in the whole suite, from 0
    std::size_t total = 0;             ///< cases of the whole suite
};
std::string format_part(const ComparePart& part);
/// Throws InputError when the text is not such a part.
ComparePart parse_part(const std::string& text, const std::string& path);
/// Merges parts in the order of the suite; throws InputError when one is missing, duplicated or
/// from another suite.
regression::CompareReport merge_parts(const std::vector<ComparePart>& parts);

}  // namespace trunnion::report
