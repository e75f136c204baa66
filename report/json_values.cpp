#include "report/json_values.h"

#include <algorithm>

#include "base/alarm.h"

namespace trunnion::report {
namespace {

using Json = nlohmann::ordered_json;

void refuse_not_finite(const Json& json, const std::string& key) {
    if (json.is_number_float() && !std::isfinite(json.get<double>()))
        throw InputError("the result \"" + key + "\" is not a finite number");
    if (!json.is_structured()) return;
    for (const auto& item : json.items())
        refuse_not_finite(item.value(), json.is_object() ? item.key() : key);
}

/// The place of the byte at `at`, and its line.
InputError error_at(const std::string& message, const std::string& path, std::string_view text,
                    std::size_t at) {
    const std::string_view before = text.substr(0, at);
    const auto line = static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
    const std::size_t begin = before.rfind('\n') + 1;  // npos + 1 is 0
    const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
    return {message,
            {path, line, static_cast<int>(at - begin) + 1},
            std::string(text.substr(begin, end - begin))};
}

}  // namespace

Json json_of_file(const std::string& text, const std::string& path, const std::string& refusal) {
    const std::size_t end = text.find_last_not_of(" \t\r\n") + 1;  // npos + 1 is 0
    if (end == 0) throw InputError(refusal + ": the file is empty", {path});
    try {
        return Json::parse(text);
    } catch (const Json::parse_error& fault) {
        if (fault.byte > end)
            throw error_at(refusal + ": the file ends too early", path, text, end);
        const std::size_t at = fault.byte > 0 ? fault.byte - 1 : 0;
        throw error_at(refusal + ": this is not JSON", path, text, at);
    }
}

std::string refused_form(const std::string& refusal, const std::exception& fault) {
    const std::string what = fault.what();  // "[json.exception.out_of_range.403] key 'a' not found"
    const std::size_t behind = what.starts_with('[') ? what.find("] ") : std::string::npos;
    return refusal + ": " + (behind == std::string::npos ? what : what.substr(behind + 2));
}

void add_inputs(Json& json, const std::vector<FileRead>& inputs) {
    for (const FileRead& input : inputs)
        json["inputs"].push_back({{"path", input.path}, {"sha256", input.sha256}});
}

std::vector<FileRead> inputs_of(const Json& json) {
    std::vector<FileRead> inputs;
    if (!json.contains("inputs")) return inputs;
    for (const Json& input : json.at("inputs"))
        inputs.push_back(
            {input.at("path").get<std::string>(), input.at("sha256").get<std::string>()});
    return inputs;
}

std::string json_text(const Json& json, int indent) {
    refuse_not_finite(json, "");
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace trunnion::report
