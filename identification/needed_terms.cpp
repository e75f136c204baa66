#include "identification/needed_terms.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace trunnion::identification {
namespace {

/// 0.999 quantile of F with two terms and many degrees of freedom, rounded up. Fewer terms and few
/// readings require more, which their own scatter provides.
constexpr double chance_f = 7.0;

bool bends(const effects::EffectParameter& p) {
    return !p.is_key() && !p.usual;
}

/// True for an effect with both its textbook form and further terms.
bool may_bend(const effects::Effect& effect) {
    const auto& list = effect.parameters;
    return std::any_of(list.begin(), list.end(), bends) &&
           std::any_of(list.begin(), list.end(),
                       [](const auto& p) { return !p.is_key() && p.usual; });
}

void hold_straight(effects::Effect& effect) {
    for (effects::EffectParameter& p : effect.parameters) {
        if (!bends(p)) continue;
        p.grid = {0.0};
        p.typical = 0.0;
        p.refine = false;
    }
}

double weighted_squares(const BaseModel& model) {
    return model.residual_mm.cwiseQuotient(model.sigma_mm).squaredNorm();
}

/// Increase of the misfit without the terms, in units of the scatter that remains with them.
double cost(const BaseModel& with, const BaseModel& without) {
    const double dof = std::max(
        1.0, static_cast<double>(with.residual_mm.size()) - static_cast<double>(with.rank));
    const double terms = std::max(1, with.rank - without.rank);
    const double scatter = weighted_squares(with) / dof;
    return scatter > 0.0 ? (weighted_squares(without) - weighted_squares(with)) / terms / scatter
                         : 2.0 * chance_f;
}

double value_of(const BaseModel& model, const std::string& effect, const std::string& name) {
    for (const FitParameter& p : model.parameters)
        if (p.effect == effect && p.name == name) return p.value;
    return 0.0;
}

/// Slope (ppm) of the best straight line through the curve at the positions read.
std::string straight_line(const FitInputs& in, const BaseModel& model, const std::string& effect) {
    const std::string name = effect.substr(0, effect.find('.'));
    const auto axis = in.setup.machine.chain.names().find(name);
    if (!axis || !effect.ends_with(".scale")) return "";
    std::set<double> places;
    for (std::size_t i = 0; i < in.replay.size(); ++i)
        places.insert(in.replay.sample(i).position[*axis]);
    const double scale = 1e-6 * value_of(model, effect, "scale_ppm"),
                 bow2 = value_of(model, effect, "bow2_mm"),
                 bow3 = value_of(model, effect, "bow3_mm");
    double mean = 0.0, error_mean = 0.0, way = 0.0, sum = 0.0;
    const auto error_mm = [&](double q) {
        const double u = q / 200.0;
        return scale * q + bow2 * u * u + bow3 * u * u * u;
    };
    const auto n = static_cast<double>(places.size());
    for (const double q : places) {
        mean += q / n;
        error_mean += error_mm(q) / n;
    }
    for (const double q : places) {
        way += (q - mean) * (q - mean);
        sum += (q - mean) * (error_mm(q) - error_mean);
    }
    if (way <= 0.0) return "";
    return fmt::format("; as one straight line over {:.4g} to {:.4g} mm it is {:.4g} ppm",
                       *places.begin(), *places.rbegin(), 1e6 * sum / way);
}

}  // namespace

BaseModel fit_needed_terms(const FitInputs& in, effects::Catalogue& catalogue,
                           std::vector<std::string>& notes) {
    const auto fit = [&] { return fit_base(in.setup, in.table, in.replay, catalogue, in.effects); };
    BaseModel model = fit();
    std::vector<std::string> bent;
    for (const std::string& name : in.effects) {
        const auto at = std::find_if(catalogue.begin(), catalogue.end(),
                                     [&](const effects::Effect& e) { return e.name == name; });
        if (at == catalogue.end() || !may_bend(*at)) continue;
        const std::vector<effects::EffectParameter> all = at->parameters;
        hold_straight(*at);
        BaseModel straight = fit();
        if (cost(model, straight) > chance_f) {
            at->parameters = all;
            bent.push_back(name);
            continue;
        }
        model = std::move(straight);
        notes.push_back(name + ": the readings do not show that it bends; its higher terms are 0");
    }
    for (const std::string& name : bent)
        if (std::string line = straight_line(in, model, name); !line.empty())
            notes.push_back(name + " bends" + line);
    return model;
}

}  // namespace trunnion::identification
