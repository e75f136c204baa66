// Results with positions in files, in formats of other tools: SARIF, JUnit, GitHub lines.
#pragma once

#include <cstdint>
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

/// GitHub limits of one run: it rejects files above 10 MB compressed and 25,000 results, and shows
/// 5,000.
struct SarifLimits {
    std::size_t results = 5000;
    std::size_t bytes = 9'000'000;  ///< of the results, before compression
};
/// SARIF 2.1.0. Beyond the limits errors are kept before notes, and a property of the run gives the
/// number of omitted results, including `left_out` (omitted by the caller).
std::string format_sarif(const std::vector<ReportRule>& rules, const std::vector<ReportItem>& items,
                         const SarifLimits& limits = {}, std::uint64_t left_out = 0);
/// Workflow commands: `::error file=..,line=..,title=..::text`.
std::string format_github(const std::vector<ReportItem>& items);
std::string format_junit(const std::string& suite, const std::vector<JUnitCase>& cases);

}  // namespace trunnion::report
