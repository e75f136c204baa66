#include "choices/sparse_noise.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "choices/own_pairs.h"
#include "estimation/distributions.h"

namespace trunnion::choices {

namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;

constexpr std::size_t least_steps = 10;   ///< from row to row, of an axis, for its scatter
constexpr double normal_median = 0.4549;  ///< of the square of a normal variable
constexpr double usual_square = 9.0;      ///< of that square: beyond it is no noise
constexpr double usual_mean = 0.9733;     ///< of the square within it
constexpr double least_shown = 0.5;       ///< of a row's axis, across its segment
constexpr double most_noise = 0.02;       ///< mm or deg, assumed: more is no noise of a control
constexpr double same_noise = 0.6;        ///< of the largest: the axes have the same noise
constexpr double rows_a_number = 3.0;     ///< for each number of a dependence

/// A step of an axis from row to row.
struct RowStep {
    double square = 0.0;  ///< in units of the variance of a row
    double count = 1.0;   ///< numbers that it adds: two steps that share a row are not independent
};
using RowSteps = std::vector<RowStep>;

/// `in_blocks`: only of rows of one block.
RowSteps steps_of(const LogView& view, const ComparedRun& run, const std::vector<int>& blocks,
                  std::size_t at, bool in_blocks) {
    const Axis axis = view.axes[at];
    const auto place = static_cast<Index>(at);
    const std::vector<const Pair*> pairs = own_pairs(view, run);
    RowSteps out;
    bool shares = false;
    for (std::size_t row = 1; row < pairs.size(); ++row) {
        const bool shared = shares;
        shares = false;
        if (!pairs[row] || !pairs[row - 1] || (in_blocks && blocks[row] != blocks[row - 1]))
            continue;
        const double a = shown_by(view, run, *pairs[row])(place, place),
                     b = shown_by(view, run, *pairs[row - 1])(place, place);
        if (a < least_shown || b < least_shown) continue;
        const double step = pairs[row]->apart[axis] - pairs[row - 1]->apart[axis];
        out.push_back({step * step / (a + b), shared ? 2.0 / 3.0 : 1.0});
        shares = true;
    }
    return out;
}

/// From the median first, so that steps to another difference do not count.
SparseNoise scatter_of(RowSteps steps) {
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end(),
                     [](const RowStep& a, const RowStep& b) { return a.square < b.square; });
    const double most = usual_square * middle->square / normal_median;
    std::erase_if(steps, [most](const RowStep& step) { return step.square > most; });
    double sum = 0.0, freedom = 0.0;
    for (const RowStep& step : steps) {
        sum += step.square;
        freedom += step.count;
    }
    return {std::sqrt(sum / (static_cast<double>(steps.size()) * usual_mean)), freedom};
}

/// On what the differences of an axis may depend: the positions, the direction of its travel, the
/// order of the rows.
VectorXd causes_of(const LogView& view, const ComparedRun& run, const Pair& pair, Axis axis) {
    VectorXd out(static_cast<Index>(view.axes.size()) + 3);
    Index k = 0;
    for (const Axis other : view.axes) out[k++] = view.rows[pair.row].at[other];
    const double way = run.path.nodes[pair.node].at[axis] - run.path.nodes[pair.node - 1].at[axis];
    out[k++] = way > 0.0 ? 1.0 : way < 0.0 ? -1.0 : 0.0;
    out[k++] = static_cast<double>(pair.row);
    out[k] = 1.0;
    return out;
}

/// Of one axis.
double p_of_axis(const LogView& view, const ComparedRun& run, Axis axis,
                 const std::vector<const Pair*>& pairs) {
    std::vector<VectorXd> rows;
    std::vector<double> apart;
    for (const Pair* pair : pairs) {
        if (!pair || pair->node == 0) continue;
        rows.push_back(causes_of(view, run, *pair, axis));
        apart.push_back(pair->apart[axis]);
    }
    if (rows.empty()) return 1.0;
    const Index n = static_cast<Index>(rows.size()), numbers = rows.front().size();
    if (static_cast<double>(n) < rows_a_number * static_cast<double>(numbers)) return 1.0;
    MatrixXd a(n, numbers);
    for (Index i = 0; i < n; ++i) a.row(i) = rows[static_cast<std::size_t>(i)].transpose();
    for (Index k = 0; k + 1 < numbers; ++k) {
        a.col(k).array() -= a.col(k).mean();
        if (const double size = a.col(k).norm(); size > 0.0) a.col(k) /= size;
    }
    const VectorXd b = Eigen::Map<const VectorXd>(apart.data(), n);
    MatrixXd normal = a.transpose() * a;
    normal.diagonal().array() += 1e-9;
    const double left = (b - a * normal.ldlt().solve(a.transpose() * b)).squaredNorm();
    const auto used = static_cast<double>(numbers), free = static_cast<double>(n - numbers);
    if (left <= 0.0) return 1.0;
    return estimation::f_tail((b.squaredNorm() - left) / used / (left / free), used, free);
}

}  // namespace

std::optional<SparseNoise> sparse_noise(const LogView& view, const ComparedRun& run,
                                        const std::vector<int>& blocks) {
    std::vector<SparseNoise> axes;
    RowSteps few;  // of axes that have too few
    double most = 0.0;
    for (std::size_t k = 0; k < view.axes.size(); ++k) {
        RowSteps steps = steps_of(view, run, blocks, k, true);
        if (steps.size() < least_steps) steps = steps_of(view, run, blocks, k, false);
        if (steps.size() < least_steps) {
            few.insert(few.end(), steps.begin(), steps.end());
            continue;
        }
        axes.push_back(scatter_of(std::move(steps)));
        most = std::max(most, axes.back().sigma);
    }
    if (axes.empty() && few.size() >= least_steps) {
        axes.push_back(scatter_of(std::move(few)));
        most = axes.back().sigma;
    }
    if (most <= 0.0 || most > most_noise) return std::nullopt;
    SparseNoise out;
    double square = 0.0;
    for (const SparseNoise& own : axes) {
        if (own.sigma < same_noise * most) continue;
        square += own.freedom * own.sigma * own.sigma;
        out.freedom += own.freedom;
    }
    out.sigma = std::sqrt(square / out.freedom);
    return out;
}

double p_of_dependence(const LogView& view, const ComparedRun& run) {
    std::vector<const Pair*> pairs = own_pairs(view, run);
    double least = 1.0;
    for (std::size_t k = 0; k < view.axes.size(); ++k) {
        std::vector<const Pair*> own = pairs;
        const std::size_t first = first_move(run.path, view.axes[k]);
        for (const Pair*& pair : own) {
            if (!pair) continue;
            const auto place = static_cast<Index>(k);
            if (pair->node <= first || shown_by(view, run, *pair)(place, place) < least_shown)
                pair = nullptr;
        }
        least = std::min(least, p_of_axis(view, run, view.axes[k], own));
    }
    return std::min(1.0, least * static_cast<double>(view.axes.size()));
}

}  // namespace trunnion::choices
