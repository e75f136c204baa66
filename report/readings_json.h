// Readings as JSON: output of predict and import for other programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/sensitivity.h"
#include "records/readings.h"

namespace trunnion::report {

/// trunnion.prediction/1: every device row with its value, and the derivatives if there are any.
std::string prediction_json(const records::ReadingTable& read,
                            const std::optional<identification::Sensitivity>& found);

/// Report of an import.
struct ImportWords {
    std::string out;  ///< path of the readings
    std::vector<std::string> summary, notes;
};
/// trunnion.import/1: number of rows of each device, tests, and the report.
std::string import_json(const records::ReadingTable& table, const ImportWords& words);

}  // namespace trunnion::report
