#include "imports/grid_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace trunnion::imports {

namespace {

constexpr double most_step_mm = 0.0255;    ///< 0.001 inch; beyond it, positions are round by choice
constexpr double least_printed_mm = 1e-7;  ///< more digits are those of a conversion
constexpr double least_ratio = 1.9;        ///< of the step to the printed increment
constexpr std::size_t least_values = 100;  ///< distinct ones
constexpr double surely = -30.0;           ///< logarithm of the chance of such values without grid
constexpr double most_rounding = 0.5 + 0.02;  ///< of the printed increment

using Values = std::vector<double>;

/// Distinct values of an axis, in order.
Values values_of(const records::PositionLog& log, Axis axis, double printed_mm) {
    Values all, out;
    for (const records::LoggedPosition& row : log.rows) all.push_back(row.at[axis]);
    std::sort(all.begin(), all.end());
    for (const double value : all)
        if (out.empty() || value - out.back() > 0.5 * printed_mm) out.push_back(value);
    return out;
}

double least_difference(const std::vector<Values>& axes) {
    double least = std::numeric_limits<double>::infinity();
    for (const Values& values : axes)
        for (std::size_t i = 1; i < values.size(); ++i)
            least = std::min(least, values[i] - values[i - 1]);
    return least;
}

/// The step from the distances of neighbours, the smallest ones first: a distance of n steps is
/// counted right only with a step that is known better than 1/n.
double step_between_neighbours(const std::vector<Values>& axes, double step) {
    Values apart;
    for (const Values& values : axes)
        for (std::size_t i = 1; i < values.size(); ++i) apart.push_back(values[i] - values[i - 1]);
    std::sort(apart.begin(), apart.end());
    double far = step;
    for (const double one : apart) {
        const double count = std::round(one / step);
        if (one <= far || std::abs(one - count * step) > 0.3 * step) continue;
        step = one / count;
        far = one;
    }
    return step;
}

/// The step that fits all values, from a first one: the farther the values, the better it is known.
double refined(const std::vector<Values>& axes, double step) {
    step = step_between_neighbours(axes, step);
    double far = 0.0;
    for (const Values& values : axes)
        for (const double value : values) {
            const double apart = value - values.front(), count = std::round(apart / step);
            if (count < 1.0 || apart <= far) continue;
            // A farther value is counted right only while the step's own error stays small.
            if (std::abs(apart - count * step) > 0.3 * step) return 0.0;
            step = apart / count;
            far = apart;
        }
    return step;
}

}  // namespace

double grid_step(const records::PositionLog& log, double printed_mm) {
    if (log.ends) return 0.0;
    printed_mm = std::max(printed_mm, least_printed_mm);
    std::vector<Values> axes;
    std::size_t count = 0;
    for (const Axis axis : log.axes) {
        if (is_rotary(axis)) continue;
        axes.push_back(values_of(log, axis, printed_mm));
        count += axes.back().size();
    }
    const double first = least_difference(axes);
    if (count < least_values || !(first >= least_ratio * printed_mm) || first > most_step_mm)
        return 0.0;
    const double step = refined(axes, first);
    if (step < least_ratio * printed_mm) return 0.0;
    const double tolerance = 2.0 * most_rounding * printed_mm;  // of the value and of the first one
    for (const Values& values : axes)
        for (const double value : values) {
            const double apart = value - values.front();
            if (std::abs(apart - step * std::round(apart / step)) > tolerance) return 0.0;
        }
    const double chance = std::min(1.0, 2.0 * tolerance / step);
    return static_cast<double>(count) * std::log(chance) < surely ? step : 0.0;
}

}  // namespace trunnion::imports
