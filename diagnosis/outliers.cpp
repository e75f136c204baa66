// Readings that stand out so far that they are no readings: left out of everything that follows.
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnosis/diagnoser.h"
#include "diagnosis/rules.h"
#include "diagnosis/statistics.h"

namespace trunnion {
namespace {

constexpr double wild_sigma = 5.0;
constexpr double consistent = 1.4826;  ///< normal standard deviation over median deviation

/// Residuals of base alone over their own standard deviation, rows of `used` fitted.
Eigen::VectorXd studentised(const BaseModel& base, const std::vector<bool>& used) {
    Eigen::VectorXd weight = base.sigma_mm.cwiseInverse();
    for (Eigen::Index i = 0; i < weight.size(); ++i)
        if (!used[static_cast<std::size_t>(i)]) weight(i) = 0.0;
    const Eigen::MatrixXd a = weight.asDiagonal() * base.columns;
    Eigen::MatrixXd information = a.transpose() * a;
    information.diagonal().array() += 1e-9 * information.trace() + 1e-12;
    const Eigen::LLT<Eigen::MatrixXd> llt(information);
    const Eigen::VectorXd y = weight.cwiseProduct(base.residual_mm);
    const Eigen::VectorXd left = y - a * llt.solve(a.transpose() * y);
    const Eigen::MatrixXd half = llt.matrixL().solve(a.transpose());
    const Eigen::ArrayXd own = 1.0 - half.colwise().squaredNorm().transpose().array();
    return left.array() / own.max(0.05).sqrt();
}

/// The largest of n normal numbers is seldom larger.
double largest_by_chance(double n) {
    return std::sqrt(2.0 * std::log(std::max(2.0, n))) + 1.0;
}

/// Do these rows of `all` crowd together? Rows at random leave less than a fifth of the mean
/// distance between 18 of 100 neighbours.
bool crowded(const std::vector<std::size_t>& rows, std::size_t all) {
    if (rows.size() <= 8) return false;
    const std::size_t close = std::max<std::size_t>(2, all / (5 * rows.size()));
    std::size_t pairs = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) pairs += rows[k] - rows[k - 1] <= close ? 1 : 0;
    return 10 * pairs > 4 * rows.size();
}

}  // namespace

/// Probe readings that stand out from the base alone, the worst first and all anew without it: in a
/// small table the catalogue has as many columns as readings and would swallow them. Not for the
/// ballbar, where one reading at each reversal may be all that shows of a spike.
std::vector<std::size_t> Diagnoser::lone_probe_readings() const {
    std::vector<bool> kept = used_;
    std::vector<std::size_t> lone;
    const auto rows = static_cast<double>(used_.size());
    for (int pass = 0; pass < 40; ++pass) {
        const Eigen::VectorXd z = studentised(base_, kept);
        std::vector<double> size;
        double worst = 0.0;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            if (!kept[i] || replay_.contact(i).device == Device::ballbar) continue;
            size.push_back(std::abs(z(static_cast<Eigen::Index>(i))));
            worst = std::max(worst, size.back());
        }
        const double limit = largest_by_chance(rows) * std::max(0.5, consistent * median(size));
        if (size.empty() || worst < limit) break;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            const double own = std::abs(z(static_cast<Eigen::Index>(i)));
            if (!kept[i] || replay_.contact(i).device == Device::ballbar) continue;
            if (own < std::max(limit, 0.7 * worst)) continue;
            kept[i] = false;
            lone.push_back(i);
        }
        if (static_cast<double>(lone.size()) > rules::most_outliers * rows) return {};
    }
    std::sort(lone.begin(), lone.end());
    return crowded(lone, used_.size()) ? std::vector<std::size_t>{} : lone;
}

/// Readings that stand out although everything was tried on them.
std::vector<std::size_t> Diagnoser::wild_readings() const {
    std::vector<Eigen::Index> all(static_cast<std::size_t>(design_->gram().cols()));
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<Eigen::Index>(k);
    const Eigen::VectorXd z = design_->residual(all, 1.0).cwiseQuotient(base_.sigma_mm);
    std::vector<double> size;
    for (Eigen::Index i = 0; i < z.size(); ++i) size.push_back(std::abs(z(i)));
    const double limit = wild_sigma * std::max(0.5, consistent * median(size));
    std::vector<std::size_t> wild;
    for (std::size_t i = 0; i < used_.size(); ++i)
        if (used_[i] && size[i] > limit) wild.push_back(i);
    // Many at once, or in a row, are no outliers: something happened to the machine.
    const bool many =
        static_cast<double>(wild.size()) > rules::most_outliers * static_cast<double>(used_.size());
    return crowded(wild, used_.size()) || many ? std::vector<std::size_t>{} : wild;
}

void Diagnoser::leave_out(const std::vector<std::size_t>& rows) {
    if (rows.empty()) return;
    for (const std::size_t i : rows) {
        const auto row = static_cast<Eigen::Index>(i);
        used_[i] = false;
        sigma_mm_(row) = 1e3 * base_.sigma_mm(row);
    }
    rewhiten();
}

void Diagnoser::drop_outliers() {
    leave_out(lone_probe_readings());
    for (int pass = 0; pass < 2; ++pass) leave_out(wild_readings());
}

double Diagnoser::outliers() const {
    return static_cast<double>(std::count(used_.begin(), used_.end(), false));
}

}  // namespace trunnion
