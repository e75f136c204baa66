// Readings as JSON: output of predict and import for other programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/read_file.h"
#include "identification/sensitivity.h"
#include "records/readings.h"

namespace trunnion::report {

/// trunnion.prediction/1: every device row with its value, and the derivatives if there are any.
std::string prediction_json(const records::ReadingTable& read,
                            const std::optional<identification::Sensitivity>& found,
                            const std::vector<FileRead>& inputs = {});

/// Report of an import.
struct ImportWords {
    std::string out;  ///< path of the readings
    std::vector<std::string> summary, notes;
};
/// trunnion.import/1: how many rows of which device, tests, and the words.
std::string import_json(const records::ReadingTable& table, const ImportWords& words,
                        const std::vector<FileRead>& inputs = {});

}  // namespace trunnion::report
