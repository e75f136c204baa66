// Results with positions in files as SARIF 2.1.0 (OASIS), as accepted by GitHub code scanning.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "report/places.h"

namespace trunnion::report {

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

}  // namespace trunnion::report
