// Results with positions in files, as JUnit and as GitHub lines; sarif.h has SARIF.
#pragma once

#include <string>
#include <vector>

#include "report/xml.h"

namespace trunnion::report {

/// One result at one position.
struct ReportItem {
    std::string rule;
    std::string level = "error";  ///< error, warning, note
    std::string path;
    int line = 0;  ///< from 1; 0: the file as a whole
    int column = 0;
    int last_line = 0;
    std::string text;  ///< one line
    std::string remedy;
    std::string fingerprint;  ///< unchanged when lines move; empty: derived from rule, path and
                              ///< text
};

struct ReportRule {
    std::string id, description;
};

/// One test case of a JUnit file; empty `failure`: passed.
struct JUnitCase {
    std::string name, file;
    std::string failure, details;
};

/// Workflow commands: `::error file=..,line=..,title=..::text`.
std::string format_github(const std::vector<ReportItem>& items);
std::string format_junit(const std::string& suite, const std::vector<JUnitCase>& cases);

}  // namespace trunnion::report
