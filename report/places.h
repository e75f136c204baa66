// Results that point at lines of files, in the forms other tools read: SARIF, JUnit, GitHub lines.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/xml.h"

namespace trunnion::report {

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

/// What GitHub takes and shows of one run: it refuses files above 10 MB compressed and 25,000
/// results, and shows 5,000.
struct SarifLimits {
    std::size_t results = 5000;
    std::size_t bytes = 9'000'000;  ///< of the results, before compression
};
/// SARIF 2.1.0. Beyond the limits errors stay before notes, and a property of the run says how many
/// were left out, `left_out` (by the caller already) included.
std::string format_sarif(const std::vector<ReportRule>& rules, const std::vector<ReportItem>& items,
                         const SarifLimits& limits = {}, std::uint64_t left_out = 0);
/// Workflow commands: `::error file=..,line=..,title=..::text`.
std::string format_github(const std::vector<ReportItem>& items);
std::string format_junit(const std::string& suite, const std::vector<JUnitCase>& cases);

}  // namespace trunnion::report
