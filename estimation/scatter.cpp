#include "estimation/scatter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "estimation/distributions.h"
#include "estimation/quantiles.h"

namespace trunnion::estimation {
namespace {

constexpr double mean_of_half = 0.142658;  ///< of the smaller half of squared normal deviates
constexpr double rejected = 0.01;          ///< good values set aside in a sample
constexpr double most_spoiled = 1.0 / 3.0;
constexpr double farthest = 6.0;  ///< deviations: what is farther counts as there
constexpr int most_passes = 50;

double root_mean_square(const std::vector<double>& sizes, std::size_t count) {
    double sum = 0.0;
    for (std::size_t k = 0; k < count; ++k) sum += sizes[k] * sizes[k];
    return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, count)));
}

/// Number of the smallest sizes that may be normal deviates; `kept` of them told the deviation.
std::size_t within(const std::vector<double>& sizes, double deviation, std::size_t kept) {
    const auto freedom = static_cast<double>(kept);
    const double level = rejected / static_cast<double>(sizes.size());
    const auto end = std::partition_point(sizes.begin(), sizes.end(), [&](double size) {
        const double t = size / deviation;
        return !(f_tail(t * t, 1.0, freedom) < level);
    });
    return static_cast<std::size_t>(end - sizes.begin());
}

/// All values, those beyond six deviations as if they were there.
Scatter cut_off(const std::vector<double>& values, double least) {
    const double most = farthest * std::max(least, robust_deviation(values));
    std::vector<double> sizes;
    for (const double value : values) sizes.push_back(std::min(most, std::abs(value)));
    return {root_mean_square(sizes, sizes.size()), std::vector<bool>(values.size(), true)};
}

}  // namespace

Scatter scatter_of(const std::vector<double>& values, double least) {
    if (values.empty()) return {};
    std::vector<double> sizes;
    for (const double value : values) sizes.push_back(std::abs(value));
    std::sort(sizes.begin(), sizes.end());
    std::size_t kept = (sizes.size() + 1) / 2;
    double deviation = root_mean_square(sizes, kept) / std::sqrt(mean_of_half);
    kept = sizes.size();
    for (int pass = 0; pass < most_passes; ++pass) {
        const std::size_t count = within(sizes, std::max({deviation, least, 1e-300}), kept);
        deviation = root_mean_square(sizes, count);
        if (count == kept && pass > 0) break;
        kept = count;
    }
    const auto all = static_cast<double>(sizes.size());
    if (static_cast<double>(sizes.size() - kept) > most_spoiled * all)
        return cut_off(values, least);
    Scatter scatter{deviation, {}};
    const double limit = kept == 0 ? 0.0 : sizes[kept - 1];
    for (const double value : values) scatter.kept.push_back(std::abs(value) <= limit);
    return scatter;
}

}  // namespace trunnion::estimation
