#include "diagnosis/groups/mean_line.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "diagnosis/prepare/places.h"
#include "effects/polynomials.h"

namespace trunnion::diagnosis {
namespace {

/// Slope of the mean line of q^2 over the positions that were read, mm.
double slope_of_square_mm(const Prepared& p, Axis axis) {
    std::vector<double> places;
    for (std::size_t i = 0; i < p.replay.size(); ++i)
        places.push_back(p.replay.sample(i).position[axis]);
    const Eigen::Map<const Eigen::ArrayXd> q(places.data(),
                                             static_cast<Eigen::Index>(places.size()));
    const Eigen::ArrayXd way = q - q.mean();
    const double square = way.square().sum();
    return square > 0.0 ? (way * q.square()).sum() / square : 0.0;
}

}  // namespace

Eigen::Vector2d bow_about_mean_line(const Prepared& p, const effects::Effect& effect,
                                    std::size_t bow) {
    const double slope = slope_of_square_mm(p, *effect.axis) / effects::reach_mm;
    const auto& parameters = effect.parameters;
    return {-slope * parameters[bow].typical / parameters[bow - 1].typical, 1.0};
}

bool is_bow_to_one_side(const Prepared& p, const ColumnGroup& group) {
    const auto& parameters = group.effect->parameters;
    if (group.effect->kind != effects::EffectKind::straightness ||
        std::any_of(group.parameters.begin(), group.parameters.end(),
                    [&](std::size_t k) { return parameters[k].mean_line; }))
        return false;
    const auto [low, high] = range_of(p, *group.effect->axis);
    return std::abs(low + high) > 0.5 * (high - low);
}

void take_bow_from_mean_line(const Prepared& p, ColumnGroup& group) {
    const auto& parameters = group.effect->parameters;
    std::vector<Eigen::VectorXd> columns;
    const auto count = static_cast<Eigen::Index>(group.parameters.size());
    for (Eigen::Index k = 0; k < count; ++k) {
        const std::size_t bow = group.parameters[static_cast<std::size_t>(k)];
        if (parameters[bow].mean_line) continue;
        Eigen::VectorXd column = Eigen::VectorXd::Unit(count, k);
        // The slope of the same direction stands before it.
        if (k > 0 && group.parameters[static_cast<std::size_t>(k - 1)] == bow - 1)
            column(k - 1) = bow_about_mean_line(p, *group.effect, bow)(0);
        columns.push_back(std::move(column));
    }
    group.shape.resize(count, static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k)
        group.shape.col(static_cast<Eigen::Index>(k)) = columns[k];
}

}  // namespace trunnion::diagnosis
