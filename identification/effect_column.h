// Derivatives of readings with respect to one parameter of an effect.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "effects/catalogue.h"
#include "emulator/replay.h"

namespace trunnion::identification {

/// One linear parameter of an effect with the keys in `values`.
struct EffectTerm {
    const effects::Effect& effect;
    const std::vector<double>& values;  ///< in the order of the parameters
    std::size_t parameter;
};
/// Derivatives of the device rows with respect to a parameter, times its typical size; mm (rad for
/// angular rows).
Eigen::VectorXd effect_column(const emulator::Replay& replay,
                              const std::vector<kinematics::Perturbation>& gradient,
                              const EffectTerm& term);
/// The same for a subset of the rows.
Eigen::VectorXd effect_column(const emulator::Replay& replay,
                              const std::vector<kinematics::Perturbation>& gradient,
                              const EffectTerm& term, const std::vector<std::size_t>& rows);

}  // namespace trunnion::identification
