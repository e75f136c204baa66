// Derivatives of a control's path with respect to stored numbers, and least squares with them.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "choices/compared_run.h"
#include "choices/store_table.h"

namespace trunnion::choices {

constexpr double least_change = 1e-4;  ///< mm or deg: the smallest increment that is entered in
                                       ///< practice
constexpr double least_sigmas = 4.0;   ///< of a number that stands out

/// Least change of a number that the log can tell.
inline double least_change_of(const LogView& log) {
    return std::max(least_change, log.rounding);
}

using Numbers = std::vector<const StoredNumber*>;

/// Derivative of each pair's control position with respect to one stored number.
using Column = std::vector<offsets::ControlPosition>;

double value_of(const setup::Setup& setup, const StoredNumber& number);

/// Nothing if no pair depends on the number, or if every step of it makes the program execute other
/// moves. A pair whose point slides along its segment contains no information along the direction
/// of travel. `other_moves`: set to true in the second case.
std::optional<Column> column_of(const Comparer& comparer, const setup::Setup& setup,
                                const ComparedRun& run, const StoredNumber& number,
                                bool* other_moves = nullptr);

/// The path with the number a step farther.
using SteppedPath = std::function<ControlPath(double step)>;

/// The same of any number.
std::optional<Column> column_of(const Comparer& comparer, const ComparedRun& run,
                                const SteppedPath& path_at, bool* other_moves = nullptr);

/// Those of several numbers; shorter than the list where one of them has none.
std::vector<Column> columns_of(const Comparer& comparer, const setup::Setup& setup,
                               const ComparedRun& run, const Numbers& numbers);

/// Normal equations of pairs.
struct Normal {
    Eigen::MatrixXd matrix;
    Eigen::VectorXd right;
};

/// `part`: share with which each row counts, 0 to 1.
Normal normal_of(const Comparer& comparer, const ComparedRun& run,
                 const std::vector<Column>& columns,
                 const std::function<double(std::size_t)>& part);
Normal normal_of(const Comparer& comparer, const ComparedRun& run,
                 const std::vector<Column>& columns);

Normal part_of(const Normal& all, const std::vector<Eigen::Index>& list);

/// Solution with a ridge of 1e-9 of the trace towards `otherwise`. It does not change a number that
/// the pairs determine; a number on which no pair depends becomes `otherwise`.
Eigen::VectorXd solved(Normal normal, const Eigen::VectorXd& otherwise);

/// With the same ridge, so that a number on which no pair depends has a very large sigma. `scale`:
/// of the variance.
Eigen::VectorXd sigmas(Normal normal, double scale);

/// Residual of a fit, in units of the log's variance, at least one.
double scale_of(const Comparer& comparer, double loss);

/// Losses of the rows, each fold with the numbers fitted to the others, which change them by
/// `back` where these do not determine them. `columns`: of the numbers at this run.
std::vector<double> left_out_losses(const Comparer& comparer, const ComparedRun& run,
                                    const std::vector<Column>& columns, const Eigen::VectorXd& back,
                                    const std::vector<int>& folds);

/// A control with numbers fitted to the log.
struct FittedControl {
    setup::Setup setup;
    ComparedRun run;
};

/// Applies the change `x` of the numbers, or half or a quarter of it, if the loss decreases.
bool take_step(const Comparer& comparer, const Numbers& numbers, const Eigen::VectorXd& x,
               FittedControl& control);

/// One step of Gauss-Newton; false when the loss has (almost) ceased to fall.
bool improve(const Comparer& comparer, const Numbers& numbers, FittedControl& control);

}  // namespace trunnion::choices
