// The unknowns of a fit: their place in the setup, their derivatives, a step along them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion {

/// Where the unknowns of a fit live: first those of effects, then those of the set-up.
class Unknowns {
  public:
    Unknowns(const Setup& setup, const Replay& replay, const Catalogue& catalogue,
             const std::vector<std::string>& effects);

    struct Slot {
        const Effect* effect = nullptr;  ///< nullptr: of the set-up, `fit.set_up`
        std::size_t parameter = 0;       ///< of the effect
        FitParameter fit;
    };
    const std::vector<Slot>& slots() const { return slots_; }

  private:
    void add_effect_unknowns(const Catalogue& catalogue, const std::string& name);
    void add_prior(FitParameter& fit) const;
    void add_set_up(const Replay& replay);

    const Setup& setup_;
    std::vector<Slot> slots_;
};

/// d reading / d unknown of each device row, mm for one typical change.
Eigen::MatrixXd columns_of(const std::vector<Unknowns::Slot>& slots, const Replay& replay,
                           const std::vector<Perturbation>& gradient);
/// Applies a step of the fit (in units) to the setup.
void apply_step(Setup& setup, const std::vector<Unknowns::Slot>& slots,
                const Eigen::VectorXd& step);

}  // namespace trunnion
