#include "report/identification_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/alarm.h"
#include "base/rounded.h"
#include "report/diagnosis_words.h"
#include "report/json_values.h"
#include "report/parameters_json.h"

namespace trunnion::report {

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* part_schema = "trunnion.identification-part/1";
constexpr std::size_t most_parameters = 10'000;  ///< a larger number is not a valid part
constexpr int most_repetitions = 100'000;        ///< limit of the option

double number(const Json& json) {
    return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Json parameters_of(const identification::Identification& fitted) {
    Json list = Json::array();
    for (const identification::FitParameter& p : fitted.parameters)
        list.push_back({{"effect", p.effect},
                        {"name", p.name},
                        {"component", p.component},
                        {"value", json_number(p.value)},
                        {"sigma", json_number(p.sigma)},
                        {"unit", p.unit}});
    return list;
}

Json rows_of(const Eigen::MatrixXd& matrix) {
    Json rows = Json::array();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        Json row = Json::array();
        for (Eigen::Index k = 0; k < matrix.cols(); ++k) row.push_back(json_number(matrix(i, k)));
        rows.push_back(std::move(row));
    }
    return rows;
}

std::vector<identification::FitParameter> parse_parameters(const Json& json) {
    std::vector<identification::FitParameter> list;
    for (const Json& item : json) {
        identification::FitParameter p;
        p.effect = item.at("effect").get<std::string>();
        p.of_set_up = p.effect == "setup";
        p.name = item.at("name").get<std::string>();
        p.component = std::clamp(item.at("component").get<int>(), -1, 2);
        p.value = number(item.at("value"));
        p.sigma = number(item.at("sigma"));
        p.unit = item.at("unit").get<std::string>();
        list.push_back(std::move(p));
        if (list.size() > most_parameters) throw std::length_error("parameters");
    }
    return list;
}

Eigen::MatrixXd parse_matrix(const Json& json) {
    const auto n = static_cast<Eigen::Index>(json.size());
    if (json.size() > most_parameters) throw std::length_error("covariance");
    Eigen::MatrixXd matrix(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const Json& row = json.at(static_cast<std::size_t>(i));
        if (row.size() != json.size()) throw std::length_error("covariance");
        for (Eigen::Index k = 0; k < n; ++k)
            matrix(i, k) = number(row.at(static_cast<std::size_t>(k)));
    }
    return matrix;
}

identification::Identification parse_fitted(const Json& json) {
    identification::Identification fitted;
    fitted.parameters = parse_parameters(json.at("parameters"));
    fitted.covariance = parse_matrix(json.at("covariance"));
    if (static_cast<std::size_t>(fitted.covariance.rows()) > fitted.parameters.size())
        throw std::length_error("covariance");
    for (const Json& group : json.at("inseparable"))
        fitted.inseparable.push_back({group.at("names").get<std::vector<std::string>>(),
                                      group.at("direction").get<std::vector<double>>()});
    fitted.set_up_words = json.at("set_up_words").get<std::vector<std::string>>();
    fitted.rms_before_um = number(json.at("rms_before_um"));
    fitted.rms_after_um = number(json.at("rms_after_um"));
    fitted.angles = json.at("unit") == "urad";
    fitted.dof = json.at("dof").get<int>();
    return fitted;
}

RepetitionPart parse_part_json(const Json& json) {
    RepetitionPart part;
    part.inputs = json.at("inputs").get<std::string>();
    part.runs = json.at("runs").get<int>();
    part.seed = json.at("seed").get<std::uint64_t>();
    if (part.runs < 2 || part.runs > most_repetitions) throw std::length_error("runs");
    part.fitted = parse_fitted(json.at("fitted"));
    for (const Json& file : json.value("files", Json::array()))
        part.files.push_back(
            {file.at("path").get<std::string>(), file.at("sha256").get<std::string>()});
    for (const Json& item : json.at("repetitions")) {
        identification::Repetition repetition{item.at("index").get<int>(), {}};
        for (const Json& off : item.at("off")) repetition.off.push_back(number(off));
        if (repetition.off.size() != part.fitted.parameters.size() || repetition.index < 0 ||
            repetition.index >= part.runs)
            throw std::length_error("repetition");
        part.repetitions.push_back(std::move(repetition));
    }
    return part;
}

/// The set-up quantities separately, because they are not errors of the machine.
Json json_set_up(const std::vector<identification::FitParameter>& parameters) {
    Json list = Json::array();
    for (const identification::FitParameter& p : parameters)
        if (p.of_set_up)
            list.push_back({{"name", p.name},
                            {"value", json_number(p.value)},
                            {"sigma", json_number(p.sigma)},
                            {"unit", p.unit}});
    return list;
}

}  // namespace

std::string size_words(const identification::Identification& result, double size) {
    return result.angles ? angle_words(size) : length_words(size);
}

std::string identification_json(const identification::Identification& result,
                                const std::vector<FileRead>& inputs) {
    Json json;
    json["schema"] = "trunnion.identification/1";
    json["parameters"] = json_parameters(result.parameters);
    json["setup"] = json_set_up(result.parameters);
    json["inseparable"] = json_inseparable(result.inseparable);
    json["covariance"] = json_covariance(result.parameters, result.covariance);
    json["rms_before_um"] = result.rms_before_um;
    json["rms_after_um"] = result.rms_after_um;
    json["unit"] = result.angles ? "urad" : "um";
    json["dof"] = result.dof;
    add_inputs(json, inputs);
    return json_text(json, 1) + "\n";
}

std::string identification_text(const identification::Identification& result, bool repetitions) {
    std::string text =
        fmt::format("{:<17} {:<18} {:>13} {:>11} {:>11}  {}\n", "effect", "parameter", "value",
                    "sigma", repetitions ? "Monte Carlo" : "", "unit");
    for (const identification::FitParameter& p : result.parameters) {
        const ShopValue v = shop_value(p);
        identification::FitParameter repeated = p;
        repeated.sigma = p.sigma_monte_carlo;
        text += fmt::format("{:<17} {:<18} {:>13} {:>11} {:>11}  {}\n", p.effect, v.name, v.value,
                            v.sigma, repetitions ? shop_value(repeated).sigma : "", v.unit);
    }
    for (const identification::Inseparable& group : result.inseparable)
        text += fmt::format("not observable from these readings: {}\n", to_string(group));
    for (const std::string& sentence : result.set_up_words)
        text += fmt::format("set-up: {}\n", sentence);
    return text + fmt::format("rms {} before, {} after, {} degrees of freedom\n",
                              size_words(result, result.rms_before_um),
                              size_words(result, result.rms_after_um), result.dof);
}

std::string format_part(const RepetitionPart& part) {
    Json json;
    json["schema"] = part_schema;
    json["inputs"] = part.inputs;
    json["runs"] = part.runs;
    json["seed"] = part.seed;
    json["fitted"] = {{"parameters", parameters_of(part.fitted)},
                      {"inseparable", json_inseparable(part.fitted.inseparable)},
                      {"covariance", rows_of(part.fitted.covariance)},
                      {"set_up_words", part.fitted.set_up_words},
                      {"rms_before_um", part.fitted.rms_before_um},
                      {"rms_after_um", part.fitted.rms_after_um},
                      {"unit", part.fitted.angles ? "urad" : "um"},
                      {"dof", part.fitted.dof}};
    json["files"] = Json::array();
    for (const FileRead& file : part.files)
        json["files"].push_back({{"path", file.path}, {"sha256", file.sha256}});
    json["repetitions"] = Json::array();
    for (const identification::Repetition& r : part.repetitions) {
        Json off = Json::array();
        for (const double v : r.off) off.push_back(json_number(v));
        json["repetitions"].push_back({{"index", r.index}, {"off", std::move(off)}});
    }
    return json_text(json, -1) + "\n";
}

bool is_repetition_part(const std::string& text) {
    const Json json = Json::parse(text, nullptr, false);
    return json.is_object() && json.value("schema", Json()) == part_schema;
}

RepetitionPart parse_repetition_part(const std::string& text, const std::string& path) {
    const std::string refusal = "not a part written by 'identify --shard'";
    const Json json = json_of_file(text, path, refusal);
    try {
        return parse_part_json(json);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& fault) {
        throw InputError(refused_form(refusal, fault), {path});
    }
}

identification::Identification merge_parts(const std::vector<RepetitionPart>& parts) {
    if (parts.empty()) throw InputError("merge: no parts given");
    const RepetitionPart& first = parts.front();
    std::vector<identification::Repetition> all(static_cast<std::size_t>(first.runs), {-1, {}});
    for (const RepetitionPart& part : parts) {
        if (part.inputs != first.inputs || part.runs != first.runs || part.seed != first.seed ||
            part.fitted.parameters.size() != first.fitted.parameters.size())
            throw InputError("merge: the parts come from different identify commands");
        for (const identification::Repetition& r : part.repetitions) {
            auto& place = all[static_cast<std::size_t>(r.index)];
            if (place.index >= 0)
                throw InputError(fmt::format("merge: repetition {} is in two parts", r.index + 1));
            place = r;
        }
    }
    const auto missing =
        std::find_if(all.begin(), all.end(), [](const auto& r) { return r.index < 0; });
    if (missing != all.end())
        throw InputError(fmt::format("merge: repetition {} of {} is in no part: a shard is missing",
                                     missing - all.begin() + 1, first.runs));
    identification::Identification whole = first.fitted;
    identification::enter_spread(all, whole);
    return whole;
}

}  // namespace trunnion::report
