#include "diagnosis/statistics.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace trunnion {
namespace {

constexpr double tiny = 1e-300;

/// Upper regularised incomplete gamma Q(a, x): series below a + 1, continued fraction above
/// (Lentz).
double gamma_q(double a, double x) {
    if (x <= 0.0) return 1.0;
    const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1.0) {
        double term = 1.0 / a, sum = term;
        for (int n = 1; n < 10000 && std::abs(term) > 1e-16 * std::abs(sum); ++n)
            sum += term *= x / (a + n);
        return std::clamp(1.0 - front * sum, 0.0, 1.0);
    }
    double b = x + 1.0 - a, c = 1.0 / tiny, d = 1.0 / b, h = d;
    for (int n = 1; n < 10000; ++n) {
        const double an = -n * (n - a);
        b += 2.0;
        d = an * d + b;
        d = 1.0 / (std::abs(d) < tiny ? tiny : d);
        c = b + an / c;
        if (std::abs(c) < tiny) c = tiny;
        h *= d * c;
        if (std::abs(d * c - 1.0) < 1e-15) break;
    }
    return std::clamp(front * h, 0.0, 1.0);
}

double beta_fraction(double a, double b, double x) {
    double c = 1.0, d = 1.0 - (a + b) * x / (a + 1.0);
    d = 1.0 / (std::abs(d) < tiny ? tiny : d);
    double h = d;
    for (int m = 1; m < 10000; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1.0) * (a + 2 * m));
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1.0));
        double change = 1.0;
        for (const double term : {even, odd}) {
            d = 1.0 + term * d;
            d = 1.0 / (std::abs(d) < tiny ? tiny : d);
            c = 1.0 + term / c;
            if (std::abs(c) < tiny) c = tiny;
            change = c * d;
            h *= change;
        }
        if (std::abs(change - 1.0) < 1e-15) break;
    }
    return h;
}

/// Regularised incomplete beta I_x(a, b).
double beta_i(double a, double b, double x) {
    if (x <= 0.0) return 0.0;
    if (x >= 1.0) return 1.0;
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                  a * std::log(x) + b * std::log1p(-x));
    return x < (a + 1.0) / (a + b + 2.0) ? front * beta_fraction(a, b, x) / a
                                         : 1.0 - front * beta_fraction(b, a, 1.0 - x) / b;
}

}  // namespace

double chi_squared_tail(double value, double freedom) {
    return gamma_q(0.5 * freedom, 0.5 * value);
}

double f_tail(double value, double numerator, double denominator) {
    if (value <= 0.0) return 1.0;
    return beta_i(0.5 * denominator, 0.5 * numerator,
                  denominator / (denominator + numerator * value));
}

double normal_tail(double value) {
    return 0.5 * std::erfc(value / std::sqrt(2.0));
}

double median(std::vector<double> values) {
    return quantile(std::move(values), 0.5);
}

double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    std::sort(values.begin(), values.end());
    const double at = share * static_cast<double>(values.size() - 1);
    const auto low = static_cast<std::size_t>(at);
    const std::size_t high = std::min(low + 1, values.size() - 1);
    const double part = at - static_cast<double>(low);
    return values[low] * (1.0 - part) + values[high] * part;
}

std::vector<double> shapley(const std::vector<double>& worth, int players) {
    std::vector<double> weight(static_cast<std::size_t>(players));
    for (int k = 0; k < players; ++k)
        weight[static_cast<std::size_t>(k)] =
            std::exp(std::lgamma(k + 1.0) + std::lgamma(players - k) - std::lgamma(players + 1.0));
    std::vector<double> share(static_cast<std::size_t>(players), 0.0);
    for (int k = 0; k < players; ++k)
        for (unsigned mask = 0; mask < (1U << players); ++mask) {
            const unsigned with = mask | 1U << k;
            if (with == mask) continue;
            share[static_cast<std::size_t>(k)] +=
                weight[static_cast<std::size_t>(std::popcount(mask))] * (worth[with] - worth[mask]);
        }
    return share;
}

}  // namespace trunnion
