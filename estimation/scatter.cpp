#include "estimation/scatter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "estimation/distributions.h"
#include "estimation/quantiles.h"

namespace trunnion::estimation {
namespace {

constexpr double rejected = 0.01;  ///< good values set aside in a sample
constexpr double most_spoiled = 1.0 / 3.0;
constexpr double farthest = 6.0;  ///< deviations: what is farther counts as there

double root_mean_square(const std::vector<double>& sizes) {
    double sum = 0.0;
    for (const double size : sizes) sum += size * size;
    return std::sqrt(sum / static_cast<double>(sizes.size()));
}

/// True for a size that is no deviate beside the smallest ones, by Student's t.
bool is_far(double size, double deviation, std::size_t kept, std::size_t all) {
    const double t = size / deviation;
    return f_tail(t * t, 1.0, static_cast<double>(kept)) < rejected / static_cast<double>(all);
}

/// Number of the smallest sizes, of half of them at least, before the first one that is far beside
/// them. `sizes` rise.
std::size_t within(const std::vector<double>& sizes, double least) {
    double sum = 0.0;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
        const double deviation = std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, k)));
        if (2 * k >= sizes.size() &&
            is_far(sizes[k], std::max({deviation, least, 1e-300}), k, sizes.size()))
            return k;
        sum += sizes[k] * sizes[k];
    }
    return sizes.size();
}

/// All values, those beyond six deviations as if they were there.
Scatter cut_off(const std::vector<double>& values, double least) {
    const double most = farthest * std::max(least, robust_deviation(values));
    std::vector<double> sizes;
    for (const double value : values) sizes.push_back(std::min(most, std::abs(value)));
    return {root_mean_square(sizes), std::vector<bool>(values.size(), true)};
}

}  // namespace

Scatter scatter_of(const std::vector<double>& values, double least) {
    if (values.empty()) return {};
    std::vector<double> sizes;
    for (const double value : values) sizes.push_back(std::abs(value));
    std::sort(sizes.begin(), sizes.end());
    const std::size_t kept = within(sizes, least);
    const auto all = static_cast<double>(sizes.size());
    if (static_cast<double>(sizes.size() - kept) > most_spoiled * all)
        return cut_off(values, least);
    sizes.resize(kept);
    Scatter scatter{root_mean_square(sizes), {}};
    const double limit = sizes.back();
    for (const double value : values) scatter.kept.push_back(std::abs(value) <= limit);
    return scatter;
}

}  // namespace trunnion::estimation
