#include "identification/sensitivity.h"

#include "identification/unknowns.h"

namespace trunnion::identification {
namespace {

/// Readings between two zeroings count from the first of them, as those of predict do.
void count_from_first(const emulator::Replay& replay, BaseColumns& base) {
    for (const emulator::ZeroGroup& group : replay.zeros()) {
        const Eigen::RowVectorXd first =
            base.columns.row(static_cast<Eigen::Index>(group.rows.front()));
        for (std::size_t j = 0; j < base.parameters.size(); ++j) {
            const auto k = static_cast<Eigen::Index>(j);
            if (is_zero(base.parameters[j])) continue;
            for (const std::size_t i : group.rows)
                base.columns(static_cast<Eigen::Index>(i), k) -= first(k);
        }
    }
}

}  // namespace

Sensitivity sensitivity(const setup::Setup& setup, const records::ReadingTable& table,
                        const std::vector<std::string>& effects) {
    const emulator::Replay replay(setup, table);
    const kinematics::ForwardModel model(setup.machine);
    std::vector<kinematics::Perturbation> gradient;
    for (std::size_t i = 0; i < replay.size(); ++i)
        gradient.push_back(replay.gradient(i, model, {}));
    BaseColumns base = base_columns(setup, replay, effects::make_catalogue(setup),
                                    effects.empty() ? setup.model.modelled : effects, gradient);
    count_from_first(replay, base);
    Sensitivity found{std::move(base.parameters), {}, std::move(base.columns)};
    for (std::size_t i = 0; i < replay.size(); ++i)
        found.index.push_back(table.rows[replay.table_row(i)].index);
    for (std::size_t j = 0; j < found.parameters.size(); ++j)
        found.jacobian.col(static_cast<Eigen::Index>(j)) /= found.parameters[j].typical;
    return found;
}

}  // namespace trunnion::identification
