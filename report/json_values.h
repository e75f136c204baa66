// Numbers and vectors as JSON, common to all reports.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/read_file.h"
#include "geometry/pose.h"

namespace trunnion::report {

/// null for a value that is not finite.
inline nlohmann::ordered_json json_number(double value) {
    return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

/// The text of a report with a line break at its end. Throws InputError with the key of a number
/// that is not finite: null is written by json_number only. Bytes that are not UTF-8 become
/// U+FFFD. `indent` -1: everything in one line.
std::string json_text(const nlohmann::ordered_json& json, int indent);

/// "inputs": path and SHA-256 of each file that the result was made from; no key without any.
void add_inputs(nlohmann::ordered_json& json, const std::vector<FileRead>& inputs);

/// What add_inputs wrote; throws nlohmann's exceptions for another form.
std::vector<FileRead> inputs_of(const nlohmann::ordered_json& json);

/// The JSON of the file `path`. Throws InputError that begins with `refusal`, at the place of the
/// fault, for text that is not JSON.
nlohmann::ordered_json json_of_file(const std::string& text, const std::string& path,
                                    const std::string& refusal);
/// The refusal of JSON that has another form than expected, with what was found instead.
std::string refused_form(const std::string& refusal, const std::exception& fault);

/// [x, y, z]
inline nlohmann::ordered_json vector_json(const Vector3& v) {
    return nlohmann::ordered_json::array({v.x(), v.y(), v.z()});
}

}  // namespace trunnion::report
