#include "regression/comparison.h"

#include <algorithm>
#include <cmath>

#include "base/exit_codes.h"

namespace trunnion::regression {

namespace {

double gravity(const Difference& d) {
    switch (d.kind) {
        case DifferenceKind::alarm: return 1e9;
        case DifferenceKind::only_a:
        case DifferenceKind::only_b:
        case DifferenceKind::tool: return 1e6 + d.position_mm;
        case DifferenceKind::function:
            return 10.0;  // a missing M3 or dwell has no distance; it counts like 10 mm
        case DifferenceKind::reordered: return 1e-6;
        default: return d.position_mm + d.direction_deg;
    }
}

}  // namespace

double ComparePicture::Closeup::apart_mm() const {
    return std::hypot(other_mm[0] - place_mm[0], other_mm[1] - place_mm[1],
                      other_mm[2] - place_mm[2]);
}

std::size_t gravest_difference(const Comparison& comparison) {
    const auto& list = comparison.differences;
    const auto graver = [](const Difference& p, const Difference& q) {
        return gravity(p) < gravity(q);
    };
    return static_cast<std::size_t>(std::max_element(list.begin(), list.end(), graver) -
                                    list.begin());
}

double gravity_of(const Comparison& c) {
    if (c.equal) return 0.0;
    const std::size_t gravest = gravest_difference(c);
    return gravest < c.differences.size() ? gravity(c.differences[gravest]) : 2e9;
}

std::vector<ExpectedDifference> no_longer_occurring(const CompareReport& report) {
    std::vector<ExpectedDifference> result;
    for (const ExpectedDifference& e : report.expected) {
        const auto shows = [&](const Comparison& c) {
            if (!e.case_name.empty() && e.case_name != c.name) return false;
            // A program that was not compared to its end does not count.
            if (c.status == CompareStatus::limit || c.status == CompareStatus::bad_input)
                return true;
            return std::any_of(c.differences.begin(), c.differences.end(), [&](const auto& d) {
                return d.expected && d.fingerprint == e.fingerprint;
            });
        };
        if (std::none_of(report.cases.begin(), report.cases.end(), shows)) result.push_back(e);
    }
    return result;
}

int exit_code(const CompareReport& report) {
    const auto any = [&](CompareStatus status) {
        return std::any_of(report.cases.begin(), report.cases.end(),
                           [&](const Comparison& c) { return c.status == status && !c.equal; });
    };
    if (any(CompareStatus::bad_input)) return exit_bad_input;
    if (any(CompareStatus::alarm)) return exit_alarm;
    if (any(CompareStatus::limit)) return exit_limit;
    return any(CompareStatus::differs) ? exit_differs : exit_done;
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

}  // namespace trunnion::regression
