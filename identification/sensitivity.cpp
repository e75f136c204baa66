#include "identification/sensitivity.h"

namespace trunnion::identification {

Sensitivity sensitivity(const setup::Setup& setup, const records::ReadingTable& table,
                        const std::vector<std::string>& effects) {
    const emulator::Replay replay(setup, table);
    const kinematics::ForwardModel model(setup.machine);
    std::vector<kinematics::Perturbation> gradient;
    for (std::size_t i = 0; i < replay.size(); ++i)
        gradient.push_back(replay.gradient(i, model, {}));
    BaseColumns base = base_columns(setup, replay, effects::make_catalogue(setup),
                                    effects.empty() ? setup.model.modelled : effects, gradient);
    Sensitivity found{std::move(base.parameters), {}, std::move(base.columns)};
    for (std::size_t i = 0; i < replay.size(); ++i)
        found.index.push_back(table.rows[replay.table_row(i)].index);
    for (std::size_t j = 0; j < found.parameters.size(); ++j)
        found.jacobian.col(static_cast<Eigen::Index>(j)) /= found.parameters[j].typical;
    return found;
}

}  // namespace trunnion::identification
