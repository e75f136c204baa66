#include "report/diagnosis_json.h"

#include <nlohmann/json.hpp>

#include "report/diagnosis_words.h"
#include "report/error_table.h"
#include "report/json_values.h"
#include "report/parameters_json.h"

namespace trunnion::report {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const diagnosis::HeldOut& heldout) {
    return {{"rms_before_um", heldout.rms_before_um},
            {"rms_after_um", heldout.rms_after_um},
            {"noise_um", heldout.noise_um},
            {"shrink", heldout.shrink},
            {"ci95", {heldout.low, heldout.high}}};
}

Json json_of(const diagnosis::DeviceNoise& noise) {
    return {{"scale", noise.scale}, {"shared", noise.shared}, {"memory", noise.memory}};
}

Json json_of(const diagnosis::TablePoint& point) {
    return {{"error", point.error},     {"at", point.at},
            {"value", point.value},     {"sigma", json_number(point.sigma)},
            {"at_unit", point.at_unit}, {"unit", point.unit}};
}

Json json_of(const diagnosis::Cause& cause) {
    Json json{{"effect", cause.effect},
              {"probability", cause.probability},
              {"rivals", cause.rivals},
              {"parameters", json_parameters(cause.parameters)},
              {"inseparable", json_inseparable(cause.unseen)},
              {"share", cause.share},
              {"written", cause.known && cause.written},
              {"heldout", json_of(cause.heldout)},
              {"what", cause.what},
              {"usual_cause", cause.usual_cause},
              {"remedy", cause.remedy}};
    if (!cause.since.empty()) json["since"] = cause.since;
    if (!cause.points.empty()) {
        json["form"] = "table";
        json["between_places"] = cause.holds_between;
        json["points"] = Json::array();
        for (const diagnosis::TablePoint& p : cause.points) json["points"].push_back(json_of(p));
    }
    if (const auto data = pitch_error_data(cause)) {
        const std::string end = data->rotary ? "_deg" : "_mm";
        json["pitch_error"] = {{"first" + end, data->first},
                               {"interval" + end, data->interval},
                               {"unit" + end, data->unit},
                               {"value", data->value}};
        if (!cause.includes.empty()) json["pitch_error"]["includes"] = cause.includes;
    }
    return json;
}

Json where_of(const diagnosis::Diagnosis& d) {
    Json list = Json::array();
    for (const diagnosis::DriverShare& w : d.where)
        list.push_back({{"by", w.by},
                        {"component", w.component},
                        {"share", w.share},
                        {"p_value", w.p_value},
                        {"text", w.text}});
    return list;
}

Json causes_of(const diagnosis::Diagnosis& d) {
    Json list = Json::array();
    for (const diagnosis::Cause& cause : d.causes) list.push_back(json_of(cause));
    return list;
}

/// Quantities of the set-up that the readings determined.
Json set_up_of(const diagnosis::Diagnosis& d) {
    Json list = Json::array();
    for (const identification::FitParameter& p : d.set_up)
        list.push_back({{"name", p.name},
                        {"value", p.value},
                        {"sigma", json_number(p.sigma)},
                        {"unit", p.unit}});
    for (const identification::FoundSide& s : d.sides)
        list.push_back({{"name", "side of " + s.axis},
                        {"value", s.value()},
                        {"sigma", json_number(s.sigma())},
                        {"unit", "1"}});
    return list;
}

Json next_of(const diagnosis::Diagnosis& d) {
    Json list = Json::array();
    for (const diagnosis::NextMeasurement& next : d.next)
        list.push_back({{"separates", {next.first, next.second}},
                        {"text", next.text},
                        {"program", next.program},
                        {"log_bayes_factor", next.log_bayes_factor},
                        {"minutes", next.minutes},
                        {"probability", next.probability},
                        {"settles", next.settles}});
    return list;
}

/// Changes between sessions; a missing sigma is null.
Json over_of(const diagnosis::Diagnosis& d) {
    Json json{{"sessions", Json::array()}, {"changes", Json::array()}};
    for (const diagnosis::SessionFit& s : d.sessions)
        json["sessions"].push_back({{"name", s.name},
                                    {"readings", s.readings},
                                    {"rms_before_um", s.rms_before_um},
                                    {"rms_after_um", s.rms_after_um}});
    for (const diagnosis::SessionChange& c : d.changes)
        json["changes"].push_back({{"effect", c.parameter.effect},
                                   {"name", with_component(c.parameter)},
                                   {"unit", c.parameter.unit},
                                   {"since", c.since},
                                   {"before", c.before},
                                   {"change", c.parameter.value},
                                   {"sigma", json_number(c.parameter.sigma)},
                                   {"claimed", c.claimed}});
    return json;
}

}  // namespace

std::string diagnosis_json(const diagnosis::Diagnosis& d, const std::vector<FileRead>& inputs) {
    Json json{{"schema", "trunnion.diagnosis/1"},
              {"verdict", to_string(d.verdict)},
              {"noise_source", to_string(d.noise.source)},
              {"unit", d.angles ? "urad" : "um"},
              {"gap",
               {{"rms_um", d.rms_um},
                {"noise_um", d.noise_um},
                {"excess_um", d.excess_um},
                {"p_value", d.p_value}}},
              {"where", where_of(d)},
              {"causes", causes_of(d)},
              {"after",
               {{"rms_um", d.after_rms_um},
                {"explained", d.explained},
                {"between_places", d.between_places},
                {"heldout_shrink", d.after.shrink},
                {"ci95", {d.after.low, d.after.high}},
                {"unexplained_share", d.unexplained_share}}},
              {"setup", set_up_of(d)},
              {"next_measurement", next_of(d)},
              {"noise",
               {{"sphere", json_of(d.noise.sphere)},
                {"touch", json_of(d.noise.touch)},
                {"ballbar", json_of(d.noise.ballbar)},
                {"doubt", d.noise.doubt}}},
              {"unseen", unseen_effects(d)},
              {"inseparable", json_inseparable(d.inseparable)},
              {"readings", d.readings}};
    if (const diagnosis::DeviceNoise& point = d.noise.point; point.shared + point.turned > 0.0) {
        json["noise"]["point"] = json_of(point);
        json["noise"]["point"]["turned"] = point.turned;
    }
    for (const diagnosis::AddedNoise& a : d.added)
        json["noise"]["added"].push_back({{"device", std::string(records::name_of(a.device))},
                                          {"stated_um", a.stated_um},
                                          {"added_um", a.added_um}});
    if (d.stated_um) json["gap"]["stated_noise_um"] = *d.stated_um;
    if (!d.background.empty()) json["after"]["background"] = d.background;
    if (d.after.set_aside > 0) json["after"]["set_aside"] = d.after.set_aside;
    if (!d.sessions.empty()) json["over"] = over_of(d);
    if (d.copies > 0) json["copies"] = d.copies;
    if (d.chosen_from > 0) json["chosen_from"] = d.chosen_from;
    if (d.unfinished) json["unfinished"] = true;
    json["outliers"] = d.outliers;
    add_inputs(json, inputs);
    return json_text(json, 1) + "\n";
}

}  // namespace trunnion::report
