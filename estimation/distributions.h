// Tail probabilities of the distributions used in significance tests.
#pragma once

namespace trunnion::estimation {

// Relative accuracy about 1e-14 (incomplete gamma and beta functions of Boost.Math). Arguments
// outside the domain (freedom <= 0, NaN) give 1, i.e. not significant.

double chi_squared_tail(double value, double freedom);              ///< P(X > value)
double f_tail(double value, double numerator, double denominator);  ///< P(F > value)
double normal_tail(double value);                                   ///< P(Z > value)
/// P(T < value) of Student's t with `freedom` degrees of freedom.
double student_probability(double value, double freedom);
/// P(X >= value) of so many trials, each a success with this probability.
double binomial_tail(double value, double trials, double probability);

}  // namespace trunnion::estimation
