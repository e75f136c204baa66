#include "estimation/distributions.h"

#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <cmath>

namespace trunnion::estimation {

double chi_squared_tail(double value, double freedom) {
    if (!(freedom > 0.0) || !(value > 0.0)) return 1.0;
    // Far below the mean the tail is 1, where the library's series needs factorials beyond its
    // range.
    if (freedom > 100.0 && value < 0.1 * freedom) return 1.0;
    return std::isinf(value) ? 0.0 : boost::math::gamma_q(0.5 * freedom, 0.5 * value);
}

double f_tail(double value, double numerator, double denominator) {
    if (!(numerator > 0.0) || !(denominator > 0.0) || !(value > 0.0)) return 1.0;
    if (std::isinf(value)) return 0.0;
    return boost::math::ibeta(0.5 * denominator, 0.5 * numerator,
                              denominator / (denominator + numerator * value));
}

double normal_tail(double value) {
    return 0.5 * std::erfc(value / std::sqrt(2.0));
}

double student_probability(double value, double freedom) {
    if (!(freedom > 0.0) || std::isnan(value)) return 1.0;
    const double both = f_tail(value * value, 1.0, freedom);
    return value < 0.0 ? 0.5 * both : 1.0 - 0.5 * both;
}

double binomial_tail(double value, double trials, double probability) {
    if (!(value > 0.0) || !(value <= trials)) return value > trials ? 0.0 : 1.0;  // NaN: 1
    if (!(probability > 0.0 && probability < 1.0)) return probability >= 1.0 ? 1.0 : 0.0;
    return boost::math::ibeta(value, trials - value + 1.0, probability);
}

}  // namespace trunnion::estimation
