// The unknowns of a fit: their place in the setup, their derivatives, a step along them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::identification {

/// Where the unknowns of a fit live: first those of effects, then those of the set-up.
class Unknowns {
  public:
    Unknowns(const setup::Setup& setup, const emulator::Replay& replay,
             const effects::Catalogue& catalogue, const std::vector<std::string>& effects);

    struct Slot {
        const effects::Effect* effect = nullptr;  ///< nullptr: of the set-up, `fit.set_up`
        std::size_t parameter = 0;                ///< of the effect
        FitParameter fit;
    };
    const std::vector<Slot>& slots() const { return slots_; }

  private:
    void add_effect_unknowns(const effects::Catalogue& catalogue, const std::string& name);
    void add_prior(FitParameter& fit) const;
    void add_set_up(const emulator::Replay& replay);

    const setup::Setup& setup_;
    std::vector<Slot> slots_;
};

/// d reading / d unknown of each device row, mm for one typical change.
Eigen::MatrixXd columns_of(const std::vector<Unknowns::Slot>& slots, const emulator::Replay& replay,
                           const std::vector<kinematics::Perturbation>& gradient);
/// Applies a step of the fit (in units) to the setup.
void apply_step(setup::Setup& setup, const std::vector<Unknowns::Slot>& slots,
                const Eigen::VectorXd& step);

}  // namespace trunnion::identification
