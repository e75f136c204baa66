#include "regression/comparison.h"

#include <algorithm>

namespace trunnion {

int exit_code(const CompareReport& report) {
    const auto any = [&](CompareStatus status) {
        return std::any_of(report.cases.begin(), report.cases.end(),
                           [&](const Comparison& c) { return c.status == status && !c.equal; });
    };
    if (any(CompareStatus::bad_input)) return 2;
    if (any(CompareStatus::alarm)) return 3;
    if (any(CompareStatus::limit)) return 4;
    return any(CompareStatus::differs) ? 1 : 0;
}

std::string verdict_of(const CompareReport& report) {
    if (report.single && report.cases.size() == 1) return report.cases.front().verdict;
    const auto equal = std::count_if(report.cases.begin(), report.cases.end(),
                                     [](const Comparison& c) { return c.equal; });
    const auto total = static_cast<std::ptrdiff_t>(report.cases.size());
    if (equal == total) return "equal: all " + std::to_string(total) + " programs";
    return "differs: " + std::to_string(total - equal) + " of " + std::to_string(total) +
           " programs";
}

}  // namespace trunnion
