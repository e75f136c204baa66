// Functions of a row that drivers consist of (driver_functions.cpp).
#pragma once

#include <functional>
#include <vector>

#include "diagnosis/prepare/places.h"

namespace trunnion::diagnosis {

/// A value for each row of the readings.
using RowFunction = std::function<double(std::size_t)>;

std::vector<double> tabulate(std::size_t rows, const RowFunction& f);
/// Less their means: a constant part would be a displacement, or the zero of an axis.
std::vector<RowFunction> without_mean(std::vector<RowFunction> list, std::size_t rows);

/// Chebyshev polynomials of a value over its range, from the first order on.
std::vector<RowFunction> smooth_functions(const RowFunction& q, Range range, int orders);
/// Cosine and sine of each order of an angle, rad.
std::vector<RowFunction> harmonics(const RowFunction& q, int orders);
/// A random walk over a range of time that may end a unit off: the first functions of its
/// Karhunen-Loeve expansion, the shortest of a tenth of the range.
std::vector<RowFunction> random_walk(const RowFunction& t, Range range);
/// Second Legendre polynomial.
double bow(double u);

}  // namespace trunnion::diagnosis
