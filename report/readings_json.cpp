#include "report/readings_json.h"

#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/numbers.h"
#include "base/units.h"
#include "report/json_values.h"
#include "report/parameters_json.h"

namespace trunnion::report {
namespace {

using Json = nlohmann::ordered_json;

/// As in the CSV: `value_deg` for a row that reads an angle.
Json row_json(const records::Reading& row) {
    const double value = row.value_mm.value_or(0.0);
    Json json{{"index", row.index},
              {"test", row.test},
              {"device", records::name_of(row.device)},
              {"feature", row.feature}};
    if (row.angular)
        json["value_deg"] = parse_number(shortest_degrees(value)).value_or(deg_from_rad(value));
    else
        json["value_mm"] = value;
    return json;
}

Json jacobian_json(const identification::Sensitivity& found) {
    Json json{{"names", Json::array()}, {"units", Json::array()}, {"rows", Json::array()}};
    for (const identification::FitParameter& p : found.parameters) {
        json["names"].push_back(p.effect + '.' + with_component(p));
        json["units"].push_back(p.unit);
    }
    for (Eigen::Index i = 0; i < found.jacobian.rows(); ++i) {
        Json row = Json::array();
        for (const double derivative : found.jacobian.row(i)) row.push_back(derivative);
        json["rows"].push_back(row);
    }
    return json;
}

}  // namespace

std::string prediction_json(const records::ReadingTable& read,
                            const std::optional<identification::Sensitivity>& found,
                            const std::vector<FileRead>& inputs) {
    Json json{{"schema", "trunnion.prediction/1"}, {"readings", Json::array()}};
    for (const records::Reading& row : read.rows)
        if (row.device != records::Device::none) json["readings"].push_back(row_json(row));
    json["jacobian"] = found ? jacobian_json(*found) : Json(nullptr);
    add_inputs(json, inputs);
    return json_text(json, 1) + "\n";
}

std::string import_json(const records::ReadingTable& table, const ImportWords& words,
                        const std::vector<FileRead>& inputs) {
    std::map<std::string_view, int> devices;
    std::set<std::string> tests;
    for (const records::Reading& row : table.rows) {
        if (row.device == records::Device::none) continue;
        ++devices[records::name_of(row.device)];
        tests.insert(row.test);
    }
    Json json{{"schema", "trunnion.import/1"}, {"out", words.out}, {"rows", table.rows.size()}};
    json["devices"] = Json::object();
    for (const auto& [device, rows] : devices) json["devices"][std::string(device)] = rows;
    json["tests"] = tests;
    json["summary"] = words.summary;
    json["notes"] = words.notes;
    add_inputs(json, inputs);
    return json_text(json, 1) + "\n";
}

}  // namespace trunnion::report
