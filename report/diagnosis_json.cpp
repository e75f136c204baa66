#include "report/diagnosis_json.h"

#include <nlohmann/json.hpp>

#include "report/error_table.h"
#include "report/parameters_json.h"

namespace trunnion::report {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const diagnosis::HeldOut& heldout) {
    return {{"rms_before_um", heldout.rms_before_um},
            {"rms_after_um", heldout.rms_after_um},
            {"noise_um", heldout.noise_um},
            {"shrink", heldout.shrink},
            {"ci95", {heldout.low, heldout.high}}};
}

Json to_json(const diagnosis::DeviceNoise& noise) {
    return {{"scale", noise.scale}, {"shared", noise.shared}, {"memory", noise.memory}};
}

Json to_json(const diagnosis::TablePoint& point) {
    return {{"error", point.error}, {"at", point.at},           {"value", point.value},
            {"sigma", point.sigma}, {"at_unit", point.at_unit}, {"unit", point.unit}};
}

Json to_json(const diagnosis::Cause& cause) {
    Json json{{"effect", cause.effect},
              {"probability", cause.probability},
              {"rivals", cause.rivals},
              {"parameters", json_parameters(cause.parameters)},
              {"inseparable", json_inseparable(cause.unseen)},
              {"share", cause.share},
              {"heldout", to_json(cause.heldout)},
              {"what", cause.what},
              {"usual_cause", cause.usual_cause},
              {"remedy", cause.remedy}};
    if (!cause.points.empty()) {
        json["form"] = "table";
        json["between_places"] = cause.holds_between;
        json["points"] = Json::array();
        for (const diagnosis::TablePoint& p : cause.points) json["points"].push_back(to_json(p));
        if (const auto data = pitch_error_data(cause))
            json["pitch_error"] = {{"first_mm", data->first_mm},
                                   {"interval_mm", data->interval_mm},
                                   {"unit_mm", data->unit_mm},
                                   {"value", data->value}};
    }
    return json;
}

Json to_json(const diagnosis::Diagnosis& d) {
    Json json{{"schema", "trunnion.diagnosis/1"},
              {"verdict", to_string(d.verdict)},
              {"noise_source", to_string(d.noise.source)},
              {"gap",
               {{"rms_um", d.rms_um},
                {"noise_um", d.noise_um},
                {"excess_um", d.excess_um},
                {"p_value", d.p_value}}}};
    json["where"] = Json::array();
    for (const diagnosis::DriverShare& w : d.where)
        json["where"].push_back({{"by", w.by},
                                 {"component", w.component},
                                 {"share", w.share},
                                 {"p_value", w.p_value},
                                 {"text", w.text}});
    json["causes"] = Json::array();
    for (const diagnosis::Cause& cause : d.causes) json["causes"].push_back(to_json(cause));
    json["after"] = {{"rms_um", d.after_rms_um},
                     {"explained", d.explained},
                     {"between_places", d.between_places},
                     {"heldout_shrink", d.after.shrink},
                     {"ci95", {d.after.low, d.after.high}},
                     {"unexplained_share", d.unexplained_share}};
    json["setup"] = Json::array();
    for (const identification::FitParameter& p : d.set_up)
        json["setup"].push_back(
            {{"name", p.name}, {"value", p.value}, {"sigma", p.sigma}, {"unit", p.unit}});
    for (const identification::FoundSide& s : d.sides)
        json["setup"].push_back({{"name", "side of " + s.axis},
                                 {"value", s.value()},
                                 {"sigma", s.sigma()},
                                 {"unit", "1"}});
    json["next_measurement"] = Json::array();
    for (const diagnosis::NextMeasurement& next : d.next)
        json["next_measurement"].push_back({{"separates", {next.first, next.second}},
                                            {"text", next.text},
                                            {"program", next.program},
                                            {"log_bayes_factor", next.log_bayes_factor},
                                            {"minutes", next.minutes},
                                            {"settles", next.settles}});
    json["noise"] = {{"sphere", to_json(d.noise.sphere)},
                     {"touch", to_json(d.noise.touch)},
                     {"ballbar", to_json(d.noise.ballbar)},
                     {"doubt", d.noise.doubt}};
    json["unseen"] = d.unseen;
    json["inseparable"] = json_inseparable(d.inseparable);
    json["readings"] = d.readings;
    if (d.chosen_from > 0) json["chosen_from"] = d.chosen_from;
    json["outliers"] = d.outliers;
    return json;
}

}  // namespace

std::string diagnosis_json(const diagnosis::Diagnosis& diagnosis) {
    return to_json(diagnosis).dump(1) + "\n";
}

}  // namespace trunnion::report
