#include "choices/small_shift.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "choices/own_pairs.h"
#include "choices/store_columns.h"
#include "estimation/distributions.h"

namespace trunnion::choices {

namespace {

constexpr std::size_t most_lags = 20;
constexpr double least_correlation = 0.05;  ///< of a lag that counts
constexpr double least_across = 3.0;        ///< across the motion: fewer have no mean
constexpr std::size_t most_ranges = 300;    ///< blocks, for ranges of them

/// Sum of the differences of an axis, and of what noise does to it, in units of sigma.
struct AxisSum {
    double sum = 0.0, variance = 0.0, weight = 0.0;
    void add(const AxisSum& other) {
        sum += other.sum;
        variance += other.variance;
        weight += other.weight;
    }
};

Eigen::VectorXd apart_of(const LogView& view, const Pair& pair) {
    Eigen::VectorXd out(static_cast<Eigen::Index>(view.axes.size()));
    for (Eigen::Index k = 0; k < out.size(); ++k)
        out[k] = pair.apart[view.axes[static_cast<std::size_t>(k)]];
    return out;
}

/// Of each block, in the order of the rows.
std::vector<AxisSum> sums_of(const LogView& view, const ComparedRun& run,
                             const std::vector<int>& blocks, std::size_t at) {
    const Axis axis = view.axes[at];
    const auto place = static_cast<Eigen::Index>(at);
    const std::vector<const Pair*> pairs = own_pairs(view, run);
    const std::size_t first = first_move(run.path, axis);
    std::vector<AxisSum> out;
    for (std::size_t row = 0; row < pairs.size(); ++row) {
        if (row == 0 || blocks[row] != blocks[row - 1]) out.emplace_back();
        if (!pairs[row] || pairs[row]->node <= first) continue;
        const double part = shown_by(view, run, *pairs[row])(place, place),
                     weight = view.rows[row].weight;
        out.back().add({pairs[row]->apart[axis] * weight, part, part * weight});
    }
    return out;
}

/// Neighbours joined until there are few enough.
std::vector<AxisSum> joined(std::vector<AxisSum> sums) {
    while (sums.size() > most_ranges) {
        std::vector<AxisSum> out((sums.size() + 1) / 2);
        for (std::size_t k = 0; k < sums.size(); ++k) out[k / 2].add(sums[k]);
        sums = std::move(out);
    }
    return sums;
}

/// Differences of the rows, each block without the constant difference that fits it best: that
/// would be alike in neighbouring rows, and is no noise.
std::vector<std::optional<Eigen::VectorXd>> scattered(const LogView& view, const ComparedRun& run,
                                                      const std::vector<int>& blocks) {
    const auto n = static_cast<Eigen::Index>(view.axes.size());
    struct Sum {
        Eigen::MatrixXd shown;
        Eigen::VectorXd apart;
    };
    std::map<int, Sum> sums;
    const std::vector<const Pair*> pairs = own_pairs(view, run);
    std::vector<std::optional<Eigen::VectorXd>> out(pairs.size());
    for (std::size_t row = 0; row < pairs.size(); ++row) {
        if (!pairs[row]) continue;
        Sum& sum = sums.try_emplace(blocks[row], Sum{Eigen::MatrixXd::Identity(n, n) * 1e-6,
                                                     Eigen::VectorXd::Zero(n)})
                       .first->second;
        sum.shown += shown_by(view, run, *pairs[row]);
        sum.apart += apart_of(view, *pairs[row]);
    }
    for (auto& [block, sum] : sums) sum.apart = sum.shown.ldlt().solve(sum.apart);
    for (std::size_t row = 0; row < pairs.size(); ++row)
        if (pairs[row])
            out[row] = apart_of(view, *pairs[row]) -
                       shown_by(view, run, *pairs[row]) * sums.at(blocks[row]).apart;
    return out;
}

double correlation_in(const std::vector<std::optional<Eigen::VectorXd>>& rows,
                      const std::vector<int>& blocks, Eigen::Index axis) {
    double square = 0.0, out = 1.0;
    for (const auto& row : rows)
        if (row) square += (*row)[axis] * (*row)[axis];
    for (std::size_t lag = 1; lag <= most_lags && square > 0.0; ++lag) {
        double sum = 0.0;
        for (std::size_t k = lag; k < rows.size(); ++k)
            if (rows[k] && rows[k - lag] && blocks[k] == blocks[k - lag])
                sum += (*rows[k])[axis] * (*rows[k - lag])[axis];
        if (sum < least_correlation * square) break;
        out += 2.0 * sum / square;
    }
    return out;
}

}  // namespace

double correlation_of(const LogView& view, const ComparedRun& run, const std::vector<int>& blocks) {
    const auto rows = scattered(view, run, blocks);
    double most = 1.0;
    for (std::size_t k = 0; k < view.axes.size(); ++k)
        most = std::max(most, correlation_in(rows, blocks, static_cast<Eigen::Index>(k)));
    return most;
}

double p_of_shift(const LogView& view, const ComparedRun& run, const std::vector<int>& blocks,
                  double correlation) {
    double most = 0.0, ranges = 0.0;
    for (std::size_t k = 0; k < view.axes.size(); ++k) {
        const std::vector<AxisSum> sums = joined(sums_of(view, run, blocks, k));
        ranges += 0.5 * static_cast<double>(sums.size() * (sums.size() + 1));
        for (std::size_t i = 0; i < sums.size(); ++i) {
            AxisSum all;
            for (std::size_t j = i; j < sums.size(); ++j) {
                all.add(sums[j]);
                if (all.variance < least_across ||
                    std::abs(all.sum) <= least_change_of(view) * all.weight)
                    continue;
                most = std::max(most, std::abs(all.sum) / std::sqrt(all.variance * correlation));
            }
        }
    }
    const double tail = std::isfinite(view.freedom)
                            ? estimation::student_probability(-most, view.freedom)
                            : estimation::normal_tail(most);
    return std::min(1.0, 2.0 * ranges * tail);
}

std::vector<double> directions_of(const LogView& view, const ComparedRun& run) {
    const double axes = static_cast<double>(view.axes.size());
    std::vector<double> out(view.rows.size(), axes);
    for (const Pair& pair : run.pairs)
        if (pair.slides && axes > 1.0) out[pair.row] = axes - 1.0;
    return out;
}

}  // namespace trunnion::choices
