#include "diagnosis/verdict/between_places.h"

#include <algorithm>

namespace trunnion::diagnosis {
namespace {

/// Mean square of linear interpolation between the values at `places`, from second differences.
double mean_square_between(const std::vector<double>& places, const Eigen::VectorXd& value) {
    constexpr double of_parabola = 8.0 / 15.0;  // of the square at the middle
    double sum = 0.0, length = 0.0;
    for (std::size_t k = 1; k + 1 < places.size(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        const double before = places[k] - places[k - 1], after = places[k + 1] - places[k];
        const double bend =
            2.0 * ((value(i + 1) - value(i)) / after - (value(i) - value(i - 1)) / before) /
            (before + after);
        for (const double step : {before, after}) {
            const double middle = bend * step * step / 8.0;
            sum += of_parabola * middle * middle * step;
            length += step;
        }
    }
    return length > 0.0 ? sum / length : 0.0;
}

/// The same relative to the mean square of the values about their mean; the largest of the
/// directions.
double fraction_between(const TableForm& table, const Eigen::VectorXd& values) {
    const Eigen::Index each = table.per_direction();
    double most = 0.0;
    for (std::size_t d = 0; d < table.directions.size(); ++d) {
        const Eigen::VectorXd own = values.segment(static_cast<Eigen::Index>(d) * each, each);
        const double square = (own.array() - own.mean()).square().mean();
        if (square > 0.0) most = std::max(most, mean_square_between(table.knots, own) / square);
    }
    return most;
}

}  // namespace

double left_between_places(Design& design, const Model& model,
                           const std::function<bool(std::size_t)>& interpolates) {
    if (model.members.empty()) return 0.0;
    const Solution solution = solved(design, model);
    const Eigen::MatrixXd parts = contributions(design, model, fit_of(design, model));
    Eigen::VectorXd all = Eigen::VectorXd::Zero(parts.rows());
    double left = 0.0;
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        const ColumnGroup& group = design.group(model.members[k]);
        const auto part = parts.col(static_cast<Eigen::Index>(k));
        if (is_cause(group.kind)) all += part;
        if (group.kind != GroupKind::table || group.table.knots.size() < 3 ||
            !interpolates(model.members[k]))
            continue;
        const Eigen::VectorXd own = solution.mean.segment(solution.first[k], solution.size[k]);
        left += part.squaredNorm() * fraction_between(group.table, table_values(group, own));
    }
    return all.squaredNorm() > 0.0 ? left / all.squaredNorm() : 0.0;
}

}  // namespace trunnion::diagnosis
