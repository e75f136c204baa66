// The unknowns of a fit: location in the setup, derivatives, and a step along them.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::identification {

/// The unknowns of a fit: first those of effects, then those of the set-up.
class Unknowns {
  public:
    Unknowns(const setup::Setup& setup, const emulator::Replay& replay,
             const effects::Catalogue& catalogue, const std::vector<std::string>& effects);

    struct Slot {
        const effects::Effect* effect = nullptr;  ///< nullptr: a set-up quantity, `fit.set_up`
        std::size_t parameter = 0;                ///< index in the effect
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

/// Derivative of each device row with respect to each unknown, times its typical size; mm (rad for
/// angular rows).
Eigen::MatrixXd columns_of(const std::vector<Unknowns::Slot>& slots, const emulator::Replay& replay,
                           const std::vector<kinematics::Perturbation>& gradient);
/// The same; each gradient is computed and forgotten.
Eigen::MatrixXd columns_of(const std::vector<Unknowns::Slot>& slots, const emulator::Replay& replay,
                           const kinematics::Machine& machine);
inline bool is_zero(const FitParameter& p) {  ///< of a test with a laser or autocollimator
    return p.of_set_up && p.set_up.kind == SetUpQuantity::Kind::zero;
}
/// The zero of a test is its first reading (Replay::predict), which the other unknowns change, too:
/// a step along the columns, in typical sizes, times this matrix is the step of the unknowns.
Eigen::MatrixXd zeros_from_first(const std::vector<Unknowns::Slot>& slots,
                                 const emulator::Replay& replay, const Eigen::MatrixXd& columns);
/// Derivatives of all device rows by a Perturbation.
std::vector<kinematics::Perturbation> gradients_of(const emulator::Replay& replay,
                                                   const kinematics::Machine& machine);
/// Computes BaseModel::gradient, 560 bytes a row, where `fit_base` did not keep it: for more than
/// 100,000 rows.
void need_gradient(BaseModel& model, const emulator::Replay& replay);
/// Applies a step of the fit (in the units of the unknowns) to the setup.
void apply_step(setup::Setup& setup, const std::vector<Unknowns::Slot>& slots,
                const Eigen::VectorXd& step);

}  // namespace trunnion::identification
