#include "choices/most_rows.h"

#include <algorithm>
#include <cmath>

namespace trunnion::choices {

namespace {

constexpr int most_turns = 20;
constexpr double far_sigmas_square = 9.0;  ///< an axis
constexpr double closer = 0.95;            ///< of the bounded loss: more is no change worth telling

/// Loss of a row from which on it counts less and less (the weights of Cauchy).
double far_of(const Comparer& comparer) {
    return far_sigmas_square * static_cast<double>(comparer.log().axes.size());
}

double bounded(const std::vector<double>& losses, double far) {
    double sum = 0.0;
    for (const double loss : losses) sum += std::log1p(loss / far);
    return sum;
}

}  // namespace

bool fit_to_most_rows(const Comparer& comparer, const Numbers& numbers, FittedControl& control) {
    const double far = far_of(comparer), before = bounded(control.run.losses, far);
    const auto is_near = [&](double loss) { return loss <= far; };
    if (std::all_of(control.run.losses.begin(), control.run.losses.end(), is_near)) return false;
    FittedControl best = control;
    double least = before;
    for (int turn = 0; turn < most_turns; ++turn) {
        const auto columns = columns_of(comparer, best.setup, best.run, numbers);
        if (columns.size() != numbers.size()) break;
        const auto part = [&](std::size_t row) { return 1.0 / (1.0 + best.run.losses[row] / far); };
        const Eigen::VectorXd x =
            solved(normal_of(comparer, best.run, columns, part),
                   Eigen::VectorXd::Zero(static_cast<Eigen::Index>(numbers.size())));
        FittedControl next{best.setup, {}};
        for (std::size_t k = 0; k < numbers.size(); ++k)
            numbers[k]->in(next.setup) += x[static_cast<Eigen::Index>(k)];
        next.run = comparer.run(next.setup);
        const double loss = bounded(next.run.losses, far);
        if (loss >= 0.9999 * least) break;
        least = loss;
        best = std::move(next);
    }
    if (least >= closer * before) return false;
    control = std::move(best);
    return true;
}

}  // namespace trunnion::choices
