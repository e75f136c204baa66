// Simultaneous search of the keys of several effects, and their contribution to the uncertainty.
#include "identification/keys.h"

#include <cmath>
#include <nlopt.hpp>

#include "estimation/ranked_least_squares.h"

namespace trunnion::identification {
namespace {

/// A search that changes the free keys of `effects`.
struct KeySearchGoal {
    KeyGain gain;
    std::vector<KeyedEffect> effects;
};

void set_free_keys(std::vector<KeyedEffect>& effects, const std::vector<double>& keys) {
    std::size_t at = 0;
    for (KeyedEffect& e : effects)
        for (const std::size_t j : e.free) e.values[j] = keys[at++];
}

double objective(const std::vector<double>& keys, std::vector<double>&, void* data) {
    auto& goal = *static_cast<KeySearchGoal*>(data);
    set_free_keys(goal.effects, keys);
    return goal.gain(goal.effects);
}

/// Derivative of each reading with respect to key `j` of a fitted effect.
Eigen::VectorXd key_column(const emulator::Replay& replay, const BaseModel& base,
                           const effects::Effect& effect, std::vector<double> values,
                           std::size_t j) {
    const double step = 1e-4 * std::abs(values[j]);
    Eigen::VectorXd column(static_cast<Eigen::Index>(replay.size()));
    for (std::size_t i = 0; i < replay.size(); ++i) {
        double reading[2];
        for (const int side : {0, 1}) {
            std::vector<double> at = values;
            at[j] += side ? step : -step;
            kinematics::Perturbation change;
            effect.add(replay.sample(i), replay.contact(i), at, change);
            reading[side] = emulator::dot(base.gradient[i], change);
        }
        column(static_cast<Eigen::Index>(i)) = (reading[1] - reading[0]) / (2.0 * step);
    }
    return column;
}

}  // namespace

double explained(const emulator::Replay& replay, const BaseModel& base,
                 const std::vector<KeyedEffect>& effects) {
    return KeyGain(replay, base, base.residual_mm)(effects);
}

void refine_together(const emulator::Replay& replay, const BaseModel& base,
                     std::vector<KeyedEffect>& effects) {
    std::vector<double> keys, low, high;
    for (const KeyedEffect& e : effects)
        for (const std::size_t j : e.free) {
            const auto& grid = e.effect->parameters[j].grid;
            keys.push_back(e.values[j]);
            low.push_back(std::min(e.values[j], 0.5 * grid.front()));
            high.push_back(std::max(e.values[j], 2.0 * grid.back()));
        }
    if (keys.empty()) return;
    KeySearchGoal goal{KeyGain(replay, base, base.residual_mm), effects};
    nlopt::opt search(nlopt::LN_BOBYQA, static_cast<unsigned>(keys.size()));
    search.set_max_objective(objective, &goal);
    search.set_lower_bounds(low);
    search.set_upper_bounds(high);
    std::vector<double> step;
    for (const double key : keys) step.push_back(0.05 * std::abs(key));
    search.set_initial_step(step);
    search.set_xtol_rel(1e-6);
    search.set_maxeval(200);
    double best = 0.0;
    try {
        search.optimize(keys, best);
    } catch (const nlopt::roundoff_limited&) {  // `keys` contains the best point so far
    } catch (const std::runtime_error&) {
        return;
    }
    set_free_keys(effects, keys);
}

void add_key_uncertainty(const emulator::Replay& replay, const std::vector<KeyedEffect>& effects,
                         const BaseModel& base, std::vector<FitParameter>& parameters) {
    std::size_t keys = 0;
    for (const KeyedEffect& e : effects) keys += e.free.size();
    if (keys == 0) return;
    const Eigen::VectorXd weight = base.sigma_mm.cwiseInverse();
    const Eigen::Index p = base.columns.cols(), k = static_cast<Eigen::Index>(keys);
    Eigen::MatrixXd all(base.columns.rows(), p + k);
    all.leftCols(p) = base.columns;
    Eigen::Index at = p;
    std::vector<double> size;
    for (const KeyedEffect& e : effects)
        for (const std::size_t j : e.free) {
            size.push_back(std::abs(e.values[j]));
            all.col(at++) = size.back() * key_column(replay, base, *e.effect, e.values, j);
        }
    all = weight.asDiagonal() * all;
    Eigen::MatrixXd information = all.transpose() * all;
    for (Eigen::Index j = 0; j < p; ++j) {
        const FitParameter& f = base.parameters[static_cast<std::size_t>(j)];
        if (f.prior_sigma > 0.0) information(j, j) += std::pow(f.typical / f.prior_sigma, 2);
    }
    const Eigen::VectorXd sigma =
        estimation::solve_ranked(information, Eigen::VectorXd::Zero(p + k)).sigma;
    for (Eigen::Index j = 0; j < p; ++j) {
        FitParameter& f = parameters[static_cast<std::size_t>(j)];
        if (std::isfinite(f.sigma) && std::isfinite(sigma(j)))
            f.sigma = std::max(f.sigma, f.typical * sigma(j));
    }
    at = p;
    for (const KeyedEffect& e : effects)
        for (const std::size_t j : e.free) {
            const double of_key = size[static_cast<std::size_t>(at - p)] * sigma(at);
            ++at;
            for (FitParameter& f : parameters)
                if (f.effect == e.effect->name && f.name == e.effect->parameters[j].name)
                    f.sigma = of_key;
        }
}

}  // namespace trunnion::identification
