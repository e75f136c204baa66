#include "identification/unknowns.h"

#include <map>

#include "base/alarm.h"
#include "effects/settings.h"

namespace trunnion::identification {

using Slot = Unknowns::Slot;

Unknowns::Unknowns(const setup::Setup& setup, const emulator::Replay& replay,
                   const effects::Catalogue& catalogue, const std::vector<std::string>& effects)
    : setup_(setup) {
    for (const std::string& name : effects) add_effect_unknowns(catalogue, name);
    add_set_up(replay);
}

void Unknowns::add_effect_unknowns(const effects::Catalogue& catalogue, const std::string& name) {
    const effects::Effect* effect = effects::find_effect(catalogue, name);
    if (!effect) effects::refuse_effect_name(setup_, name);
    for (std::size_t j = 0; j < effect->parameters.size(); ++j) {
        const effects::EffectParameter& p = effect->parameters[j];
        if (p.is_key()) continue;
        Slot slot;
        slot.effect = effect;
        slot.parameter = j;
        slot.fit = {name, p.name, p.unit, p.component, p.typical, 0.0,
                    0.0,  0.0,    0.0,    0.0,         p.location};
        add_prior(slot.fit);
        slots_.push_back(slot);
    }
}

void Unknowns::add_prior(FitParameter& fit) const {
    if (!fit.location) return;
    const auto it =
        setup_.model.calibration.find(to_string(*fit.location, setup_.machine.chain.names()));
    if (it == setup_.model.calibration.end()) return;
    fit.prior_value = it->second.value;
    fit.prior_sigma = it->second.sigma;
}

void Unknowns::add_set_up(const emulator::Replay& replay) {
    for (const FreeQuantity& free : free_quantities(setup_, replay)) {
        Slot slot;
        slot.fit = {"setup", free.name, free.unit, -1, free.typical, 0.0};
        slot.fit.set_up = free.place;
        slot.fit.of_set_up = true;
        slots_.push_back(slot);
    }
}

namespace {

/// Fills the columns row by row.
class ColumnFiller {
  public:
    ColumnFiller(const std::vector<Slot>& slots, const emulator::Replay& replay)
        : slots_(slots),
          replay_(replay),
          columns_(static_cast<Eigen::Index>(replay.size()),
                   static_cast<Eigen::Index>(slots.size())) {
        for (const Slot& slot : slots) {
            change_.push_back(slot.effect ? slot.effect->zeros() : std::vector<double>());
            if (slot.effect)
                change_.back()[slot.parameter] = slot.effect->parameters[slot.parameter].typical;
        }
    }

    void fill(std::size_t i, const kinematics::Perturbation& gradient) {
        for (std::size_t j = 0; j < slots_.size(); ++j)
            columns_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
                derivative(i, j, gradient);
    }
    Eigen::MatrixXd take() { return std::move(columns_); }

  private:
    double derivative(std::size_t i, std::size_t j,
                      const kinematics::Perturbation& gradient) const {
        const Slot& slot = slots_[j];
        if (!slot.effect)
            return slot.fit.typical * set_up_derivative(slot.fit.set_up, replay_, i, gradient);
        kinematics::Perturbation change;
        slot.effect->add(replay_.sample(i), replay_.contact(i), change_[j], change);
        return emulator::dot(gradient, change);
    }

    const std::vector<Slot>& slots_;
    const emulator::Replay& replay_;
    Eigen::MatrixXd columns_;
    std::vector<std::vector<double>> change_;  ///< values of each slot's effect
};

}  // namespace

Eigen::MatrixXd columns_of(const std::vector<Slot>& slots, const emulator::Replay& replay,
                           const std::vector<kinematics::Perturbation>& gradient) {
    ColumnFiller filler(slots, replay);
    for (std::size_t i = 0; i < replay.size(); ++i) filler.fill(i, gradient[i]);
    return filler.take();
}

Eigen::MatrixXd columns_of(const std::vector<Slot>& slots, const emulator::Replay& replay,
                           const kinematics::Machine& machine) {
    const kinematics::ForwardModel forward(machine);
    ColumnFiller filler(slots, replay);
    for (std::size_t i = 0; i < replay.size(); ++i) filler.fill(i, replay.gradient(i, forward, {}));
    return filler.take();
}

Eigen::MatrixXd zeros_from_first(const std::vector<Slot>& slots, const emulator::Replay& replay,
                                 const Eigen::MatrixXd& columns) {
    const auto n = static_cast<Eigen::Index>(slots.size());
    Eigen::MatrixXd steps = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index z = 0; z < n; ++z) {
        const FitParameter& zero = slots[static_cast<std::size_t>(z)].fit;
        if (!is_zero(zero)) continue;
        const auto group = static_cast<std::size_t>(zero.set_up.index);
        const auto first = static_cast<Eigen::Index>(replay.zeros()[group].rows.front());
        for (Eigen::Index j = 0; j < n; ++j)
            if (!is_zero(slots[static_cast<std::size_t>(j)].fit))
                steps(z, j) = columns(first, j) / zero.typical;
    }
    return steps;
}

std::vector<kinematics::Perturbation> gradients_of(const emulator::Replay& replay,
                                                   const kinematics::Machine& machine) {
    const kinematics::ForwardModel forward(machine);
    std::vector<kinematics::Perturbation> list;
    list.reserve(replay.size());
    for (std::size_t i = 0; i < replay.size(); ++i) list.push_back(replay.gradient(i, forward, {}));
    return list;
}

void need_gradient(BaseModel& model, const emulator::Replay& replay) {
    if (model.gradient.empty()) model.gradient = gradients_of(replay, replay.setup().machine);
}

void apply_step(setup::Setup& setup, const std::vector<Slot>& slots, const Eigen::VectorXd& step) {
    std::map<const effects::Effect*, std::vector<double>> by_effect;
    for (std::size_t j = 0; j < slots.size(); ++j) {
        const double by = step(static_cast<Eigen::Index>(j));
        const Slot& slot = slots[j];
        if (slot.effect) {
            auto& values = by_effect[slot.effect];
            if (values.empty()) values = slot.effect->zeros();
            values[slot.parameter] = by;
        } else {
            number_of(setup, slot.fit.set_up) += by;
        }
    }
    for (const auto& [effect, values] : by_effect) add_effect(setup, *effect, values);
}

}  // namespace trunnion::identification
