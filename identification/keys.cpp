// Keys of several effects together: a bounded search, and what their uncertainty adds.
#include "identification/keys.h"

#include <Eigen/Cholesky>
#include <cmath>
#include <nlopt.hpp>

namespace trunnion::identification {
namespace {

/// Part of the weighted squared sum of what the base leaves that effects at these keys explain.
class JointGain {
  public:
    JointGain(const emulator::Replay& replay, const BaseModel& base,
              const std::vector<KeyedEffect>& effects)
        : replay_(replay),
          base_(base),
          effects_(effects),
          weight_(base.sigma_mm.cwiseInverse()),
          known_(weight_.asDiagonal() * base.columns),
          left_(base.residual_mm.cwiseProduct(weight_)) {
        Eigen::MatrixXd information = known_.transpose() * known_;
        information.diagonal().array() += 1e-3;
        llt_.compute(information);
    }

    double operator()(const std::vector<double>& keys) const {
        std::vector<Eigen::VectorXd> list;
        std::size_t at = 0;
        for (const KeyedEffect& e : effects_) {
            std::vector<double> values = e.values;
            for (const std::size_t j : e.free) values[j] = keys[at++];
            for (std::size_t j = 0; j < values.size(); ++j)
                if (!e.effect->parameters[j].is_key())
                    list.push_back(effect_column(replay_, base_.gradient, *e.effect, values, j)
                                       .cwiseProduct(weight_));
        }
        Eigen::MatrixXd a(left_.size(), static_cast<Eigen::Index>(list.size()));
        for (std::size_t c = 0; c < list.size(); ++c) a.col(static_cast<Eigen::Index>(c)) = list[c];
        const Eigen::MatrixXd cross = known_.transpose() * a;
        Eigen::MatrixXd information = a.transpose() * a - cross.transpose() * llt_.solve(cross);
        information.diagonal().array() += 1e-2;
        const Eigen::VectorXd h =
            a.transpose() * left_ - cross.transpose() * llt_.solve(known_.transpose() * left_);
        return h.dot(information.ldlt().solve(h));
    }

  private:
    const emulator::Replay& replay_;
    const BaseModel& base_;
    const std::vector<KeyedEffect>& effects_;
    Eigen::VectorXd weight_;
    Eigen::MatrixXd known_;
    Eigen::VectorXd left_;
    Eigen::LLT<Eigen::MatrixXd> llt_;
};

double objective(const std::vector<double>& keys, std::vector<double>&, void* gain) {
    return (*static_cast<const JointGain*>(gain))(keys);
}

/// Change of each reading for one unit of key `j` of a fitted effect.
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
    std::vector<double> keys;
    for (const KeyedEffect& e : effects)
        for (const std::size_t j : e.free) keys.push_back(e.values[j]);
    return JointGain(replay, base, effects)(keys);
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
    JointGain gain(replay, base, effects);
    nlopt::opt search(nlopt::LN_BOBYQA, static_cast<unsigned>(keys.size()));
    search.set_max_objective(objective, &gain);
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
    } catch (const nlopt::roundoff_limited&) {  // the best so far stands in `keys`
    } catch (const std::runtime_error&) {
        return;
    }
    std::size_t at = 0;
    for (KeyedEffect& e : effects)
        for (const std::size_t j : e.free) e.values[j] = keys[at++];
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
        information(j, j) += 1e-6;
        if (f.prior_sigma > 0.0) information(j, j) += std::pow(f.typical / f.prior_sigma, 2);
    }
    information.diagonal().array() += 1e-9;
    const Eigen::MatrixXd covariance =
        information.ldlt().solve(Eigen::MatrixXd::Identity(p + k, p + k));
    for (Eigen::Index j = 0; j < p; ++j) {
        FitParameter& f = parameters[static_cast<std::size_t>(j)];
        if (std::isfinite(f.sigma))
            f.sigma = std::max(f.sigma, f.typical * std::sqrt(covariance(j, j)));
    }
    at = p;
    for (const KeyedEffect& e : effects)
        for (const std::size_t j : e.free) {
            const double sigma =
                size[static_cast<std::size_t>(at - p)] * std::sqrt(covariance(at, at));
            ++at;
            for (FitParameter& f : parameters)
                if (f.effect == e.effect->name && f.name == e.effect->parameters[j].name)
                    f.sigma = sigma;
        }
}

}  // namespace trunnion::identification
