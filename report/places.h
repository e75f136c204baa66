// Results that point at lines of files, in the forms other tools read: SARIF, JUnit, GitHub lines.
#pragma once

#include <string>
#include <vector>

#include "report/xml.h"

namespace trunnion {

/// One result at one place.
struct ReportItem {
    std::string rule;
    std::string level = "error";  ///< error, warning, note
    std::string path;
    int line = 0;  ///< from 1; 0: the file as a whole
    int column = 0;
    int last_line = 0;
    std::string text;  ///< one line
    std::string remedy;
    std::string fingerprint;  ///< stays when lines move; empty: made from rule, path and text
};

struct ReportRule {
    std::string id, description;
};

/// One test case of a JUnit file; `failure` empty: passed.
struct JUnitCase {
    std::string name, file;
    std::string failure, details;
};

/// SARIF 2.1.0, at most `most_results` results (5,000 is what GitHub takes from one run) and a
/// note of how many were left out.
std::string format_sarif(const std::vector<ReportRule>& rules, const std::vector<ReportItem>& items,
                         std::size_t most_results = 5000);
/// Workflow commands: `::error file=..,line=..,title=..::text`.
std::string format_github(const std::vector<ReportItem>& items);
std::string format_junit(const std::string& suite, const std::vector<JUnitCase>& cases);

}  // namespace trunnion
