#include "estimation/quantiles.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace trunnion::estimation {

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const double at = share * static_cast<double>(values.size() - 1);
    const auto low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, values.size() - 1);
    const double part = at - static_cast<double>(low);
    return values[low] * (1.0 - part) + values[high] * part;
}

double median(std::vector<double> values) {
    return quantile(std::move(values), 0.5);
}

double robust_deviation(std::vector<double> values) {
    constexpr double of_normal = 0.6744897501960817;  // median |z|
    for (double& v : values) v = std::abs(v);
    return median(std::move(values)) / of_normal;
}

}  // namespace trunnion::estimation
