#include "identification/base_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/alarm.h"
#include "base/rounded.h"
#include "effects/settings.h"
#include "estimation/ranked_least_squares.h"
#include "identification/determined.h"
#include "identification/plausible.h"
#include "identification/unknowns.h"
#include "identification/zero_scatter.h"

namespace trunnion::identification {
namespace {

constexpr int most_passes = 20;
constexpr std::size_t most_gradients = 100000;  ///< rows of which the derivatives are kept
constexpr double least_damping = 1e-4, most_damping = 1e8;  ///< of information in typical sizes

using Slot = Unknowns::Slot;

Eigen::VectorXd residual(const BaseModel& model, const emulator::Replay& replay,
                         const setup::Setup& setup) {
    const std::vector<double> value =
        replay.predict(setup.machine, offsets_to(replay, setup), effects::active_models(setup));
    return model.measured_mm -
           Eigen::Map<const Eigen::VectorXd>(value.data(), static_cast<Eigen::Index>(value.size()));
}

double location_value(const setup::Setup& setup, const FitParameter& fit) {
    return fit.location ? setup.machine.errors.location(*fit.location) : 0.0;
}

/// Rows by their weights, tests by the scatter of their zeros.
struct Weighting {
    const ZeroScatter& zeros;
    Eigen::VectorXd weight;
};

/// Weighted sum of squares of the residuals and of the deviations from calibrated values.
double misfit(const Eigen::VectorXd& residual_mm, const Weighting& weighting,
              const setup::Setup& setup, const std::vector<Slot>& slots) {
    const Eigen::VectorXd r = residual_mm.cwiseProduct(weighting.weight);
    double sum = weighting.zeros.product(r, r, weighting.weight)(0, 0);
    for (const Slot& slot : slots)
        if (const FitParameter& p = slot.fit; p.prior_sigma > 0.0)
            sum += std::pow((location_value(setup, p) - p.prior_value) / p.prior_sigma, 2);
    return sum;
}

Eigen::VectorXd typical_of(const std::vector<Slot>& slots) {
    Eigen::VectorXd typical(static_cast<Eigen::Index>(slots.size()));
    for (std::size_t j = 0; j < slots.size(); ++j)
        typical(static_cast<Eigen::Index>(j)) = slots[j].fit.typical;
    return typical;
}

/// For each unknown: true for an error of the machine, false for the set-up.
std::vector<bool> of_machine(const std::vector<Slot>& slots) {
    std::vector<bool> list;
    for (const Slot& slot : slots) list.push_back(!slot.fit.of_set_up);
    return list;
}

/// What the readings say of a step, in typical sizes.
struct Equations {
    Eigen::MatrixXd information;
    Eigen::VectorXd gradient;
    Weighting weighting;
    Eigen::MatrixXd weighted;     ///< columns, times the weights
    Eigen::MatrixXd to_unknowns;  ///< steps_beside, then zeros_from_first
};

/// Applies a step (in the units of the parameters) unless it increases the misfit.
bool taken(BaseModel& model, const emulator::Replay& replay, const std::vector<Slot>& slots,
           const Weighting& weighting, const Eigen::VectorXd& step) {
    const double before = misfit(model.residual_mm, weighting, model.setup, slots);
    setup::Setup trial = model.setup;
    apply_step(trial, slots, step);
    Eigen::VectorXd left = residual(model, replay, trial);
    if (misfit(left, weighting, trial, slots) > before + 1e-6 * before + 1e-9) return false;
    model.setup = std::move(trial);
    model.residual_mm = std::move(left);
    return true;
}

/// Levenberg-Marquardt: along a hardly observable direction a full step may leave the range in
/// which the derivatives hold, and such directions are damped first. `damping` is kept for the next
/// step. Returns the step in typical sizes, or zero when no step reduces the misfit.
Eigen::VectorXd take_step(BaseModel& model, const emulator::Replay& replay,
                          const std::vector<Slot>& slots, const Equations& e, double& damping) {
    const Eigen::VectorXd typical = typical_of(slots);
    Eigen::VectorXd step = estimation::solve_ranked(e.information, e.gradient).value;
    for (; damping < most_damping; damping = std::max(least_damping, 10.0 * damping)) {
        if (damping > 0.0) {
            Eigen::MatrixXd damped = e.information;
            damped.diagonal().array() += damping;
            step = damped.ldlt().solve(e.gradient);
        }
        if (!taken(model, replay, slots, e.weighting, typical.cwiseProduct(e.to_unknowns * step)))
            continue;
        damping = damping > least_damping ? 0.1 * damping : 0.0;
        return step;
    }
    return Eigen::VectorXd::Zero(step.size());
}

void take_measured(BaseModel& model, const records::ReadingTable& table,
                   const emulator::Replay& replay) {
    const auto n = static_cast<Eigen::Index>(replay.size());
    model.measured_mm.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        const records::Reading& row = table.rows[replay.table_row(static_cast<std::size_t>(i))];
        if (!row.value_mm)
            throw InputError("a row with a device but without value_mm",
                             records::place_of(table, row));
        model.measured_mm(i) = *row.value_mm;
    }
}

void name_null_space(BaseModel& model, const std::vector<Slot>& slots,
                     const estimation::LinearFit& fit) {
    for (const Eigen::VectorXd& v : fit.null_space) {
        Inseparable group;
        double largest = 0.0;
        for (Eigen::Index j = 0; j < v.size(); ++j) {
            const FitParameter& p = slots[static_cast<std::size_t>(j)].fit;
            if (v(j) == 0.0) continue;
            group.names.push_back(full_name(p));
            group.direction.push_back(v(j) * p.typical);
            largest = std::max(largest, std::abs(v(j) * p.typical));
        }
        for (double& d : group.direction) d /= largest;
        model.inseparable.push_back(group);
    }
}

/// Measured readings, their noise, derivatives and residuals for the setup as given.
BaseModel start_model(const setup::Setup& setup, const records::ReadingTable& table,
                      const emulator::Replay& replay) {
    BaseModel model;
    model.setup = setup;
    begin_sessions(model.setup, replay);
    take_measured(model, table, replay);
    const RowNoise noise = row_noise(setup, table, replay);
    model.sigma_mm = noise.sigma_mm;
    model.noise_given = noise.given;
    // A stated scatter of zeros needs them, too (ZeroScatter).
    if (replay.size() <= most_gradients || setup.model.noise_um.contains("zero"))
        model.gradient = gradients_of(replay, setup.machine);
    model.residual_mm = model.start_residual_mm = residual(model, replay, model.setup);
    return model;
}

/// What is known of a parameter beforehand, as one further row of the normal equations; unknowns
/// in units of `typical`.
void add_prior(const FitParameter& prior, const setup::Setup& setup, Eigen::Index j,
               Eigen::MatrixXd& information, Eigen::VectorXd& gradient) {
    if (prior.prior_sigma <= 0.0) return;
    const double pull = prior.typical / prior.prior_sigma;
    information(j, j) += pull * pull;
    gradient(j) += pull * pull * (prior.prior_value - location_value(setup, prior)) / prior.typical;
}

/// True if the step that was left to do exceeds a tenth of a sigma.
bool far_from_solution(const estimation::LinearFit& fit) {
    for (Eigen::Index j = 0; j < fit.value.size(); ++j)
        if (std::abs(fit.value(j)) > 0.1 * fit.sigma(j)) return true;
    return false;
}

/// What reads a setup, and its unknowns.
struct ReadFrom {
    const emulator::Replay& replay;
    const std::vector<Slot>& slots;
};

/// Beside the directions `held`.
Equations equations_of(const BaseModel& model, const ZeroScatter& zeros,
                       const std::vector<Slot>& slots, const Eigen::MatrixXd& held) {
    const Eigen::VectorXd weight = row_weights(model.residual_mm, model.sigma_mm);
    const Eigen::MatrixXd a = weight.asDiagonal() * model.columns;
    Equations e{zeros.product(a, a, weight),
                zeros.product(a, weight.cwiseProduct(model.residual_mm), weight),
                {zeros, weight},
                a,
                {}};
    for (std::size_t j = 0; j < slots.size(); ++j)
        add_prior(slots[j].fit, model.setup, static_cast<Eigen::Index>(j), e.information,
                  e.gradient);
    const Eigen::MatrixXd beside =
        Eigen::MatrixXd::Identity(held.rows(), held.rows()) - held * held.transpose();
    if (held.cols() > 0) {
        e.information = Eigen::MatrixXd(beside * e.information * beside);
        e.gradient = Eigen::VectorXd(beside * e.gradient);
    }
    return e;
}

/// Directions that the model's setup shows by accident (curved_directions), where the readings are
/// `off` by so many sigmas along a direction; `off` is called with the weighted change by a step.
Eigen::MatrixXd accidents(const BaseModel& model, const ReadFrom& from, const Equations& e,
                          const std::function<double(const Eigen::VectorXd&)>& off) {
    const Eigen::VectorXd typical = typical_of(from.slots), &weight = e.weighting.weight;
    const auto left_by = [&](const Eigen::VectorXd& step) {
        setup::Setup moved = model.setup;
        apply_step(moved, from.slots, typical.cwiseProduct(e.to_unknowns * step));
        return residual(model, from.replay, moved);
    };
    return curved_directions(e.information, [&](const Eigen::VectorXd& step) {
        const Eigen::VectorXd d =
            weight.cwiseProduct(0.5 * (left_by(step) + left_by(-step)) - model.residual_mm);
        const ZeroScatter& zeros = e.weighting.zeros;
        return Bend{zeros.product(e.weighted, d, weight), zeros.product(d, d, weight)(0, 0),
                    off(e.weighted * step)};
    });
}

/// Before the fit the residual says little: ten times the noise.
Eigen::MatrixXd held_directions(const BaseModel& model, const ReadFrom& from,
                                const ZeroScatter& zeros, const Eigen::MatrixXd& to_unknowns) {
    const auto p = static_cast<Eigen::Index>(from.slots.size());
    Equations e = equations_of(model, zeros, from.slots, Eigen::MatrixXd(p, 0));
    e.to_unknowns = to_unknowns;
    return accidents(model, from, e, [](const Eigen::VectorXd&) { return 10.0; });
}

/// Columns and steps of the model without what the readings do not determine: whoever fits its
/// residual further leaves it where it is. That is what moves no reading, and that along which all
/// that the fit leaves could be one large step.
void leave_out(BaseModel& model, const ReadFrom& from, const Equations& e,
               const Eigen::MatrixXd& unseen) {
    constexpr double rounding = 1e-6;  // of a sigma
    const double rest = e.weighting.weight.cwiseProduct(model.residual_mm).norm() /
                        std::sqrt(static_cast<double>(model.residual_mm.size()));
    const Eigen::MatrixXd far = accidents(model, from, e, [&](const Eigen::VectorXd& change) {
        const double moved = change.squaredNorm() / change.cwiseAbs2().norm();  // root of a count
        return 2.0 * std::max(1.0, rest) * moved;
    });
    Eigen::MatrixXd open(unseen.rows(), unseen.cols() + far.cols());
    open << unseen, far;
    model.steps = steps_beside(unseen, of_machine(from.slots)) *
                  (Eigen::MatrixXd::Identity(open.rows(), open.rows()) - far * far.transpose());
    if (open.cols() == 0) return;
    model.columns -= Eigen::MatrixXd(model.columns * open) * open.transpose();
    for (auto column : model.columns.colwise())
        if (column.cwiseQuotient(model.sigma_mm).norm() < rounding) column.setZero();
}

/// Robust weights; the model's setup moves to the solution. Returns the last step's fit, in typical
/// sizes.
estimation::LinearFit iterate(BaseModel& model, const emulator::Replay& replay,
                              const ZeroScatter& zeros, const std::vector<Slot>& slots) {
    estimation::LinearFit fit;
    if (slots.empty()) return fit;
    const Eigen::MatrixXd from_first = zeros_from_first(slots, replay, model.columns);
    const Eigen::MatrixXd held = held_directions(model, {replay, slots}, zeros, from_first);
    Eigen::MatrixXd to_unknowns;
    double damping = 0.0;
    for (int pass = 0; pass < most_passes; ++pass) {
        Equations e = equations_of(model, zeros, slots, held);
        fit = estimation::solve_ranked(e.information, e.gradient);
        e.to_unknowns = to_unknowns = from_first * steps_beside(fit.unseen, of_machine(slots));
        const Eigen::VectorXd step = take_step(model, replay, slots, e, damping);
        if (step.cwiseAbs().maxCoeff() < 1e-7) break;
    }
    if (far_from_solution(fit))
        model.notes.emplace_back(
            "the fit has not settled: its values may be off by more than their sigma");
    fit.covariance = to_unknowns * fit.covariance * to_unknowns.transpose();
    for (std::size_t j = 0; j < slots.size(); ++j)
        if (const auto k = static_cast<Eigen::Index>(j);
            is_zero(slots[j].fit) && std::isfinite(fit.sigma(k)))
            fit.sigma(k) = std::sqrt(fit.covariance(k, k));
    Equations last = equations_of(model, zeros, slots, held);
    last.to_unknowns = to_unknowns;
    leave_out(model, {replay, slots}, last, fit.unseen);
    return fit;
}

/// The unknown with its value in the fitted setup.
FitParameter fitted_parameter(const Slot& slot, setup::Setup& setup, double sigma) {
    FitParameter done = slot.fit;
    done.sigma = sigma;
    if (!slot.effect) {
        done.value = number_of(setup, slot.fit.set_up);
    } else if (slot.effect->kind == effects::EffectKind::location) {
        done.value = location_value(setup, slot.fit);
    } else {
        for (const setup::EffectSetting& setting : setup.effects)
            if (setting.name == slot.effect->name)
                done.value = effects::values_of(*slot.effect, setting)[slot.parameter];
    }
    return done;
}

}  // namespace

std::string full_name(const FitParameter& p) {
    const std::string name = p.of_set_up ? p.name : p.effect + "." + p.name;
    return p.component < 0 ? name : fmt::format("{}[{}]", name, "xyz"[p.component]);
}

std::string to_string(const Inseparable& group) {
    std::string text;
    for (std::size_t k = 0; k < group.names.size(); ++k) {
        const double by = group.direction[k];
        text += k == 0 ? (by < 0.0 ? "-" : "") : (by < 0.0 ? " - " : " + ");
        text += fmt::format("{:.3g} {}", std::abs(by), group.names[k]);
    }
    return text;
}

void add_effect(setup::Setup& setup, const effects::Effect& effect,
                const std::vector<double>& values) {
    if (effect.kind == effects::EffectKind::location) {
        for (std::size_t j = 0; j < values.size(); ++j)
            setup.machine.errors.location(*effect.parameters[j].location) += values[j];
        return;
    }
    for (setup::EffectSetting& present : setup.effects) {
        if (present.name != effect.name) continue;
        std::vector<double> sum = effects::values_of(effect, present);
        for (std::size_t j = 0; j < sum.size(); ++j)
            sum[j] = effect.parameters[j].is_key() ? values[j] : sum[j] + values[j];
        present = effects::setting_of(effect, sum);
        return;
    }
    setup.effects.push_back(effects::setting_of(effect, values));
}

BaseColumns base_columns(const setup::Setup& setup, const emulator::Replay& replay,
                         const effects::Catalogue& catalogue,
                         const std::vector<std::string>& effects,
                         const std::vector<kinematics::Perturbation>& gradient) {
    const Unknowns unknowns(setup, replay, catalogue, effects);
    BaseColumns result;
    for (const Slot& slot : unknowns.slots()) result.parameters.push_back(slot.fit);
    result.columns = columns_of(unknowns.slots(), replay, gradient);
    return result;
}

BaseModel fit_base(const setup::Setup& setup, const records::ReadingTable& table,
                   const emulator::Replay& replay, const effects::Catalogue& catalogue,
                   const std::vector<std::string>& effects) {
    BaseModel model = start_model(setup, table, replay);
    const Unknowns unknowns(setup, replay, catalogue, effects);
    const auto& slots = unknowns.slots();
    model.columns = model.gradient.empty() ? columns_of(slots, replay, setup.machine)
                                           : columns_of(slots, replay, model.gradient);
    const Eigen::VectorXd typical = typical_of(slots);
    const estimation::LinearFit fit =
        iterate(model, replay, ZeroScatter(setup, table, replay, model.gradient), slots);
    tell_absurd_residuals(model, replay, table);
    name_null_space(model, slots, fit);
    model.rank = static_cast<int>(typical.size()) - static_cast<int>(fit.null_space.size());
    model.covariance = typical.asDiagonal() * fit.covariance * typical.asDiagonal();
    for (std::size_t j = 0; j < slots.size(); ++j) {
        const auto k = static_cast<Eigen::Index>(j);
        model.parameters.push_back(
            fitted_parameter(slots[j], model.setup, typical(k) * fit.sigma(k)));
        tell_absurd_value(model, model.parameters.back(), table);
    }
    keep_sessions(model.setup, replay);
    model.models = effects::active_models(model.setup);
    return model;
}

void shift_base(setup::Setup& setup, const BaseModel& base, const effects::Catalogue& catalogue,
                const Eigen::VectorXd& step) {
    std::vector<Slot> slots;
    for (const FitParameter& p : base.parameters) {
        Slot slot;
        slot.fit = p;
        if (!p.of_set_up) {
            slot.effect = effects::find_effect(catalogue, p.effect);
            for (std::size_t j = 0; j < slot.effect->parameters.size(); ++j)
                if (slot.effect->parameters[j].name == p.name &&
                    slot.effect->parameters[j].component == p.component)
                    slot.parameter = j;
        }
        slots.push_back(slot);
    }
    Eigen::VectorXd by = base.steps * step;
    for (Eigen::Index j = 0; j < by.size(); ++j)
        by(j) *= slots[static_cast<std::size_t>(j)].fit.typical;
    apply_step(setup, slots, by);
}

}  // namespace trunnion::identification
