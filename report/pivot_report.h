// The four-function test as table, JSON and pictures; its page is in pivot_page.h.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "pivot/affected_programs.h"

namespace trunnion::report {

/// All that is said of one test.
struct PivotResult {
    std::string machine;
    Axis first = Axis::B, second = Axis::C;
    bool hurco = false;
    std::vector<pivot::PivotMap> maps;
    pivot::PivotVerdict verdict;
    std::optional<setup::RotaryStores>
        true_right;  ///< a simulator knows what the stores had to hold
    std::vector<pivot::AffectedPart> affected;
    std::string source;  ///< "simulated", or where the readings come from
    std::string date;    ///< of the measurement; empty: not told
};

/// Stores with what to type, circles and largest errors of each map, who is affected, the verdict.
std::string pivot_table(const PivotResult& result);
/// `{"schema":"trunnion.pivot/1",...}` of formats.md.
std::string pivot_json(const PivotResult& result);
/// Pictures by file name: distances.svg (distance from the map's mean, measured and expected, as
/// figure 4 of pivot 2021), circles.svg (measured points, circle and its centre, as its figure 5).
std::map<std::string, std::string> pivot_pictures(const PivotResult& result);
/// Name of a group of stores in the words of the dialect: "G54", "P1970x", on a Hurco "set-up".
std::string group_words(const PivotResult& result, pivot::PivotGroup group);
/// Name of a number in the words of the dialect: "No.19704 (Y)", "C centreline Y - first".
std::string store_name(const PivotResult& result, const setup::StoreNumber& number);

}  // namespace trunnion::report
