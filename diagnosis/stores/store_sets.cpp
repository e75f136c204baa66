#include "diagnosis/stores/store_sets.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "diagnosis/rules/rules.h"
#include "estimation/ranked_least_squares.h"

namespace trunnion::diagnosis {
namespace {

constexpr double floor_mm = 2e-5;   ///< smaller differences are digits of the table
constexpr double digits_mm = 1e-7;  ///< of a printed position

/// What a set may leave.
struct Limits {
    double variance = 0.0;  ///< of one difference, mm^2
    double left = 0.0, floor = 0.0;
};

NumberSet fitted(const PointEquations& e, std::vector<std::size_t> members) {
    const Eigen::MatrixXd gram = e.gram(members, members);
    const Eigen::VectorXd product = e.product(members);
    estimation::LinearFit fit = estimation::solve_ranked(gram, product, 1e-6);
    const double left = (e.difference - e.columns(Eigen::all, members) * fit.value).squaredNorm();
    return {std::move(members), fit.value, fit.sigma, left, std::move(fit.null_space)};
}

void try_sets(const PointEquations& e, std::size_t size, std::vector<std::size_t> members,
              double limit, std::vector<NumberSet>& found) {
    if (members.size() == size) {
        NumberSet set = fitted(e, std::move(members));
        if (set.left <= limit) found.push_back(std::move(set));
        return;
    }
    for (std::size_t k = members.empty() ? 0 : members.back() + 1; k < e.numbers.size(); ++k) {
        std::vector<std::size_t> longer = members;
        longer.push_back(k);
        try_sets(e, size, std::move(longer), limit, found);
    }
}

/// With all numbers.
NumberSet fitted_to_all(const PointEquations& e) {
    std::vector<std::size_t> all(e.numbers.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return fitted(e, std::move(all));
}

Limits limits_of(const PointEquations& e, const NumberSet& all) {
    const double freedom = std::max(1.0, static_cast<double>(e.difference.size() - e.gram.rows()));
    const double variance = std::max(digits_mm * digits_mm, e.repeats * all.left / freedom);
    const double floor = floor_mm * floor_mm * static_cast<double>(e.difference.size());
    return {variance, all.left + std::pow(rules::store_sigmas, 2) * variance + floor, floor};
}

}  // namespace

std::vector<NumberSet> smallest_sets(const PointEquations& e) {
    const NumberSet all = fitted_to_all(e);
    const Limits limits = limits_of(e, all);
    std::vector<NumberSet> found;
    for (std::size_t size = 0; size <= std::min(most_numbers, e.numbers.size()); ++size) {
        try_sets(e, size, {}, limits.left, found);
        if (!found.empty()) break;
    }
    if (found.empty()) found.push_back(all);
    for (NumberSet& set : found) set.sigma_mm *= std::sqrt(limits.variance);
    // Equal ones in the order of the stores: 19701 before 19704.
    const auto best =
        std::min_element(found.begin(), found.end(), [&](const NumberSet& a, const NumberSet& b) {
            return a.left < b.left - 1e-3 * limits.floor;
        });
    std::rotate(found.begin(), best, best + 1);
    return found;
}

}  // namespace trunnion::diagnosis
