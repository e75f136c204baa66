#include "diagnosis/groups/driver_functions.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"

namespace trunnion::diagnosis {

std::vector<double> tabulate(std::size_t rows, const RowFunction& f) {
    std::vector<double> v(rows);
    for (std::size_t i = 0; i < rows; ++i) v[i] = f(i);
    return v;
}

std::vector<RowFunction> without_mean(std::vector<RowFunction> list, std::size_t rows) {
    for (RowFunction& f : list) {
        double mean = 0.0;
        for (std::size_t i = 0; i < rows; ++i) mean += f(i) / static_cast<double>(rows);
        f = [of = std::move(f), mean](std::size_t i) { return of(i) - mean; };
    }
    return list;
}

std::vector<RowFunction> smooth_functions(const RowFunction& q, Range range, int orders) {
    const double mid = 0.5 * (range.low + range.high),
                 half = std::max(1e-9, 0.5 * (range.high - range.low));
    std::vector<RowFunction> list;
    for (int k = 1; k <= orders; ++k)
        list.push_back([=](std::size_t i) {
            const double u = std::clamp((q(i) - mid) / half, -1.0, 1.0);
            return std::cos(k * std::acos(u));
        });
    return list;
}

std::vector<RowFunction> harmonics(const RowFunction& q, int orders) {
    std::vector<RowFunction> list;
    for (int k = 1; k <= orders; ++k) {
        list.push_back([=](std::size_t i) { return std::cos(k * q(i)); });
        list.push_back([=](std::size_t i) { return std::sin(k * q(i)); });
    }
    return list;
}

std::vector<RowFunction> random_walk(const RowFunction& t, Range range) {
    constexpr int functions = 20;
    std::vector<RowFunction> list;
    for (int k = 0; k < functions; ++k)
        list.push_back([=](std::size_t i) {
            const double w = (k + 0.5) * pi;
            return std::sqrt(2.0) * std::sin(w * (t(i) - range.low) / (range.high - range.low)) / w;
        });
    return list;
}

double bow(double u) {
    return 1.5 * u * u - 0.5;
}

}  // namespace trunnion::diagnosis
