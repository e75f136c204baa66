#include "identification/effect_column.h"

#include <numeric>

namespace trunnion::identification {

Eigen::VectorXd effect_column(const emulator::Replay& replay,
                              const std::vector<kinematics::Perturbation>& gradient,
                              const EffectTerm& term, const std::vector<std::size_t>& rows) {
    const auto& [effect, values, parameter] = term;
    std::vector<double> at = values;
    for (std::size_t k = 0; k < at.size(); ++k)
        if (!effect.parameters[k].is_key())
            at[k] = k == parameter ? effect.parameters[k].typical : 0.0;
    Eigen::VectorXd column(static_cast<Eigen::Index>(rows.size()));
    for (std::size_t k = 0; k < rows.size(); ++k) {
        kinematics::Perturbation change;
        effect.add(replay.sample(rows[k]), replay.contact(rows[k]), at, change);
        column(static_cast<Eigen::Index>(k)) = emulator::dot(gradient[rows[k]], change);
    }
    return column;
}

Eigen::VectorXd effect_column(const emulator::Replay& replay,
                              const std::vector<kinematics::Perturbation>& gradient,
                              const EffectTerm& term) {
    std::vector<std::size_t> rows(replay.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    return effect_column(replay, gradient, term, rows);
}

}  // namespace trunnion::identification
