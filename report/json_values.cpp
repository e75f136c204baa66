#include "report/json_values.h"

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

}  // namespace

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
