#include "diagnosis/set_up_alone.h"

#include <algorithm>

#include "diagnosis/search/solution.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion::diagnosis {
namespace {

/// What the set-up leaves of the readings. That of the base is straightened for the model that was
/// found: causes of degrees bend the readings, and where they are not written nothing bends.
Eigen::VectorXd left_by_set_up(const Prepared& p) {
    const setup::Setup& setup = p.base.setup;
    const std::vector<double> read =
        p.replay.predict(setup.machine, identification::offsets_to(p.replay, setup), p.base.models);
    return p.base.measured_mm -
           Eigen::Map<const Eigen::VectorXd>(read.data(), p.base.measured_mm.size());
}

/// Readings of the gap that is written as it is. What a model sets aside that has nothing but zeros
/// is spoiled.
const std::vector<bool>& rows_of(const Outcome& f) {
    const bool zeros =
        std::all_of(f.model.members.begin(), f.model.members.end(),
                    [&](std::size_t m) { return f.design.group(m).kind == GroupKind::offset; });
    return zeros ? f.used : f.beside_set_up;
}

}  // namespace

setup::Setup set_up_alone(const Outcome& f) {
    const identification::BaseModel& base = f.prepared.base;
    Eigen::VectorXd weight = base.sigma_mm.cwiseInverse();
    const std::vector<bool>& counts = rows_of(f);
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (!counts[i]) weight(static_cast<Eigen::Index>(i)) = 0.0;
    const Eigen::MatrixXd columns = weight.asDiagonal() * base.columns;
    Eigen::MatrixXd information = columns.transpose() * columns;
    Eigen::VectorXd product = columns.transpose() * weight.cwiseProduct(left_by_set_up(f.prepared));
    for (std::size_t j = 0; j < base.parameters.size(); ++j)
        if (const identification::FitParameter& q = base.parameters[j]; q.prior_sigma > 0.0) {
            const auto k = static_cast<Eigen::Index>(j);
            const double pull = q.typical / q.prior_sigma;
            information(k, k) += pull * pull;
            product(k) += pull * (q.prior_value - q.value) / q.prior_sigma;
        }
    const Model none{{}, {{}, 1.0}, 0.0};
    Solution solution = solved(f.design, none);
    solution.mean = estimation::solve_ranked(information, product).value;
    return setup_with(f.prepared, f.design, none, solution);
}

}  // namespace trunnion::diagnosis
