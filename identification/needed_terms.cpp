#include "identification/needed_terms.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "effects/models.h"

namespace trunnion::identification {
namespace {

/// 0.999 quantile of F with two terms and many degrees of freedom, rounded up. Fewer terms and few
/// readings require more, which their own scatter provides.
constexpr double chance_f = 7.0;

bool bends(const effects::EffectParameter& p) {
    return !p.is_key() && !p.usual;
}

/// True for an effect with terms beside its textbook form.
bool may_bend(const effects::Effect& effect) {
    return std::any_of(effect.parameters.begin(), effect.parameters.end(), bends);
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

/// Increase of the misfit without the terms, in units of the scatter that remains with them;
/// infinite where nothing remains.
double cost(const BaseModel& with, const BaseModel& without) {
    const double dof = std::max(
        1.0, static_cast<double>(with.residual_mm.size()) - static_cast<double>(with.rank));
    const double terms = std::max(1, with.rank - without.rank);
    const double scatter = weighted_squares(with) / dof;
    const double more = weighted_squares(without) - weighted_squares(with);
    return more > 0.0 ? more / terms / scatter : 0.0;
}

/// The effect's values in the fitted model, in the order of its parameters.
std::vector<double> values_in(const BaseModel& model, const effects::Effect& effect) {
    std::vector<double> values = effect.zeros();
    for (std::size_t j = 0; j < values.size(); ++j)
        for (const FitParameter& p : model.parameters)
            if (p.effect == effect.name && p.name == effect.parameters[j].name) values[j] = p.value;
    return values;
}

/// The best straight line (ppm) through a scale that bends, at the positions read; empty for other
/// effects.
std::string straight_line(const FitInputs& in, const BaseModel& model,
                          const effects::Effect& effect) {
    if (effect.kind != effects::EffectKind::scale) return "";
    const Axis axis = *effect.axis;
    std::set<double> places_mm;
    for (std::size_t i = 0; i < in.replay.size(); ++i)
        places_mm.insert(in.replay.sample(i).position[axis]);
    const std::vector<double> values = values_in(model, effect);
    const auto error_mm = [&](double position_mm) {
        AxisSample sample;
        sample.position[axis] = position_mm;
        kinematics::Perturbation change;
        effect.add(sample, {}, values, change);
        return change.axis[axis];
    };
    double mean_mm = 0.0, square = 0.0, product = 0.0;
    for (const double q : places_mm) mean_mm += q / static_cast<double>(places_mm.size());
    for (const double q : places_mm) {
        square += (q - mean_mm) * (q - mean_mm);
        product += (q - mean_mm) * error_mm(q);
    }
    if (square <= 0.0) return "";
    return fmt::format("; as one straight line over {:.4g} to {:.4g} mm it is {:.4g} ppm",
                       *places_mm.begin(), *places_mm.rbegin(), 1e6 * product / square);
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
        notes.push_back(name + ": the readings show no curvature; its higher terms are 0");
    }
    for (const std::string& name : bent)
        if (std::string line = straight_line(in, model, *effects::find_effect(catalogue, name));
            !line.empty())
            notes.push_back(name + " bends" + line);
    return model;
}

}  // namespace trunnion::identification
