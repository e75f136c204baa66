#include "estimation/free_form.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "estimation/projection.h"
#include "estimation/quantiles.h"

namespace trunnion::estimation {
namespace {

double matern_3_2(double distance, double length) {
    const double s = std::sqrt(3.0) * std::abs(distance) / length;
    return (1.0 + s) * std::exp(-s);
}

}  // namespace

std::vector<double> knots_of(std::vector<double> places, std::size_t most) {
    std::sort(places.begin(), places.end());
    if (places.size() < 2 || places.back() <= places.front()) return {};
    const double low = places.front(), high = places.back();
    const double same = 1e-6 * (high - low);
    std::vector<double> knots;
    for (const double q : places)
        if (knots.empty() || q > knots.back() + same) knots.push_back(q);
    if (knots.size() <= most) return knots;
    knots.resize(most);
    for (std::size_t k = 0; k < most; ++k)
        knots[k] = low + (high - low) * static_cast<double>(k) / static_cast<double>(most - 1);
    return knots;
}

std::pair<Eigen::Index, double> place_between(const std::vector<double>& knots, double q) {
    const auto after = std::upper_bound(knots.begin() + 1, knots.end() - 1, q);
    const auto k = static_cast<std::size_t>(after - knots.begin()) - 1;
    const double part = (q - knots[k]) / (knots[k + 1] - knots[k]);
    return {static_cast<Eigen::Index>(k), std::clamp(part, 0.0, 1.0)};
}

constexpr std::size_t few_places = 25;  ///< that a table may contain one by one

std::vector<double> correlation_lengths(const std::vector<double>& knots, bool each) {
    std::vector<double> spacing, lengths;
    for (std::size_t k = 1; k < knots.size(); ++k) spacing.push_back(knots[k] - knots[k - 1]);
    if (spacing.empty()) return {};
    const double range = knots.back() - knots.front(), least = 0.6 * median(spacing);
    for (double part = 0.5; part > 0.06; part *= 0.5)
        if (part * range >= least) lengths.push_back(part * range);
    // A screw error may change from target to target.
    if ((each || knots.size() <= few_places) && (lengths.empty() || lengths.back() > 1.25 * least))
        lengths.push_back(least);
    return lengths;
}

Eigen::MatrixXd smooth_shapes(const std::vector<double>& knots, double length,
                              const Eigen::MatrixXd& owned, Eigen::Index most) {
    const auto count = static_cast<Eigen::Index>(knots.size());
    Eigen::MatrixXd covariance(count, count);
    for (Eigen::Index i = 0; i < count; ++i)
        for (Eigen::Index j = 0; j < count; ++j)
            covariance(i, j) = matern_3_2(
                knots[static_cast<std::size_t>(i)] - knots[static_cast<std::size_t>(j)], length);
    const Projection own(owned);
    covariance = own.beside(own.beside(covariance).transpose());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(covariance);
    const Eigen::VectorXd value = eigen.eigenvalues().reverse();  // eigenvalues are in ascending
                                                                  // order
    Eigen::Index columns = 0;
    while (columns < std::min(most, count) && value(columns) > 1e-4 * value(0)) ++columns;
    return eigen.eigenvectors().rowwise().reverse().leftCols(columns) *
           value.head(columns).cwiseSqrt().asDiagonal();
}

Eigen::MatrixXd polynomials_at(const std::vector<double>& knots, int orders) {
    const auto count = static_cast<Eigen::Index>(knots.size());
    Eigen::MatrixXd values(count, orders);
    const double middle = 0.5 * (knots.front() + knots.back());
    const double half = 0.5 * (knots.back() - knots.front());
    for (Eigen::Index i = 0; i < count; ++i)
        for (int n = 0; n < orders; ++n)
            values(i, n) = std::pow((knots[static_cast<std::size_t>(i)] - middle) / half, n);
    return values;
}

}  // namespace trunnion::estimation
