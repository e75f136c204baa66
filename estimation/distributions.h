// Tail probabilities of the distributions that decide whether a difference is more than chance.
#pragma once

namespace trunnion::estimation {

// All values are exact to about 1e-14 relative (Boost.Math's incomplete gamma and beta functions).
// Arguments outside the domain (freedom <= 0, NaN) give 1: nothing is shown.

double chi_squared_tail(double value, double freedom);              ///< P(X > value)
double f_tail(double value, double numerator, double denominator);  ///< P(F > value)
double normal_tail(double value);                                   ///< P(Z > value)
/// P(T < value) of Student's t with `freedom` degrees of freedom.
double student_probability(double value, double freedom);

}  // namespace trunnion::estimation
