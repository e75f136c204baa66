#include "report/parameters_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "report/json_values.h"

namespace trunnion::report {
nlohmann::ordered_json json_parameters(
    const std::vector<identification::FitParameter>& parameters) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const identification::FitParameter& p : parameters) {
        const bool vector = p.component >= 0;
        const bool continues = vector && p.component > 0 && !list.empty() &&
                               list.back()["effect"] == p.effect && list.back()["name"] == p.name;
        if (!continues) {
            list.push_back({{"effect", p.effect}, {"name", p.name}});
            auto& entry = list.back();
            entry["value"] = vector ? nlohmann::ordered_json::array() : json_number(p.value);
            entry["sigma"] = vector ? nlohmann::ordered_json::array() : json_number(p.sigma);
            entry["unit"] = p.unit;
            if (p.sigma_monte_carlo != 0.0)
                entry["sigma_monte_carlo"] =
                    vector ? nlohmann::ordered_json::array() : json_number(p.sigma_monte_carlo);
        }
        if (!vector) continue;
        if (p.sigma_monte_carlo != 0.0)
            list.back()["sigma_monte_carlo"].push_back(json_number(p.sigma_monte_carlo));
        list.back()["value"].push_back(json_number(p.value));
        list.back()["sigma"].push_back(json_number(p.sigma));
    }
    return list;
}

std::string with_component(const identification::FitParameter& p) {
    return p.component < 0 ? p.name : p.name + '[' + "xyz"[p.component] + ']';
}

nlohmann::ordered_json json_covariance(const std::vector<identification::FitParameter>& parameters,
                                       const Eigen::MatrixXd& covariance) {
    nlohmann::ordered_json json;
    json["names"] = nlohmann::ordered_json::array();
    const Eigen::Index n = covariance.rows();
    for (Eigen::Index i = 0; i < n; ++i) {
        const identification::FitParameter& p = parameters[static_cast<std::size_t>(i)];
        json["names"].push_back(p.effect + '.' + with_component(p));
    }
    const Eigen::VectorXd sigma = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
    json["matrix"] = json["correlation"] = nlohmann::ordered_json::array();
    for (Eigen::Index i = 0; i < n; ++i) {
        nlohmann::ordered_json row = nlohmann::ordered_json::array(), correlation = row;
        for (Eigen::Index k = 0; k < n; ++k) {
            row.push_back(json_number(covariance(i, k)));
            correlation.push_back(json_number(covariance(i, k) / (sigma(i) * sigma(k))));
        }
        json["matrix"].push_back(row);
        json["correlation"].push_back(correlation);
    }
    return json;
}

nlohmann::ordered_json json_inseparable(const std::vector<identification::Inseparable>& groups) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const identification::Inseparable& group : groups)
        list.push_back({{"names", group.names}, {"direction", group.direction}});
    return list;
}

}  // namespace trunnion::report
