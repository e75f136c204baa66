// The four-function test as text and JSON.
#pragma once

#include <optional>
#include <string>

#include "base/read_file.h"
#include "base/rounded.h"
#include "pivot/affected_programs.h"

namespace trunnion::report {

/// All results of one test.
struct PivotResult {
    std::string machine;
    Axis first = Axis::B, second = Axis::C;
    bool hurco = false;
    std::vector<pivot::PivotMap> maps;
    pivot::PivotVerdict verdict;
    std::optional<setup::RotaryStores>
        true_right;  ///< simulation only: correct values of the stores
    std::vector<pivot::AffectedPart> affected;
    std::string source;  ///< "simulated", or the source of the readings
    std::string date;    ///< of the measurement; empty: not given
};

/// Stores with the values to enter, circles and largest errors of each map, affected programs,
/// verdict.
std::string pivot_table(const PivotResult& result);
/// `{"schema":"trunnion.pivot/1",...}` of formats.md.
std::string pivot_json(const PivotResult& result, const std::vector<FileRead>& inputs = {});
/// Name of a group of stores in the terms of the dialect: "G54", "P1970x", on a Hurco "set-up".
std::string group_words(const PivotResult& result, pivot::PivotGroup group);
/// Name of a value in the terms of the dialect: "No.19704 (Y)", "C centreline Y - first".
std::string store_name(const PivotResult& result, const setup::StoreNumber& number);
/// The error of a store and its sigma, in µm; "–" for a number that nothing sees.
Rounded store_error(const pivot::StoreVerdict& store);
/// " within 0.10 µm", nothing below a nanometre.
std::string agreement_words(const pivot::PivotVerdict& verdict);

}  // namespace trunnion::report
