// Squares: what sets of effects leave, what noise alone leaves, the share of each effect.
#include <algorithm>
#include <cmath>

#include "diagnosis/diagnoser.h"
#include "diagnosis/statistics.h"

namespace trunnion {

/// Calibrated values count as readings of their own: an error may show only in that they no longer
/// fit.
double Diagnoser::mean_square(const std::vector<Eigen::Index>& columns, double scale) const {
    const Eigen::VectorXd left_mm = design_->residual(columns, scale);
    double sum = design_->calibration_square(columns, scale), rows = design_->calibrated();
    for (std::size_t i = 0; i < used_.size(); ++i) {
        if (!used_[i]) continue;
        const auto k = static_cast<Eigen::Index>(i);
        sum += left_mm(k) * left_mm(k) / (base_.sigma_mm(k) * base_.sigma_mm(k));
        rows += 1.0;
    }
    const double lost = static_cast<double>(replay_.size()) - design_->freedom() +
                        static_cast<double>(columns.size());
    return sum / std::max(1.0, rows - lost);
}

double Diagnoser::left_square(const std::vector<std::size_t>& members) const {
    return mean_square(columns_of(*design_, members), set_.scale);
}

double Diagnoser::floor_square() const {
    double sum = 0.0, rows = 0.0;
    for (std::size_t i = 0; i < used_.size(); ++i) {
        if (!used_[i]) continue;
        const double s = noise_.of(replay_.contact(i).device).scale;
        sum += s * s;
        rows += 1.0;
    }
    return sum / std::max(1.0, rows);
}

std::vector<double> Diagnoser::shares_of(const std::vector<std::size_t>& members) const {
    const auto players = static_cast<int>(members.size());
    std::vector<double> worth(std::size_t{1} << players);
    const double base = left_square({});
    for (std::size_t mask = 1; mask < worth.size(); ++mask) {
        std::vector<std::size_t> part;
        for (int k = 0; k < players; ++k)
            if (mask >> k & 1) part.push_back(members[static_cast<std::size_t>(k)]);
        worth[mask] = base - left_square(part);
    }
    return shapley(worth, players);
}

Eigen::MatrixXd Diagnoser::known_columns(const EffectSet& set) const {
    const auto columns = columns_of(*design_, set.members);
    Eigen::MatrixXd known(design_->raw().rows(),
                          design_->base_count() + static_cast<Eigen::Index>(columns.size()));
    known.leftCols(design_->base_count()) = design_->raw().leftCols(design_->base_count());
    for (std::size_t k = 0; k < columns.size(); ++k)
        known.col(design_->base_count() + static_cast<Eigen::Index>(k)) =
            design_->raw().col(design_->base_count() + columns[k]);
    return known;
}

Eigen::VectorXd Diagnoser::noise_mm() const {
    Eigen::VectorXd v = base_.sigma_mm;
    for (Eigen::Index i = 0; i < v.size(); ++i)
        v(i) *= noise_.of(replay_.contact(static_cast<std::size_t>(i)).device).scale;
    return v;
}

double Diagnoser::rms_um(const Eigen::VectorXd& v) const {
    double sum = 0.0, rows = 0.0;
    for (std::size_t i = 0; i < used_.size(); ++i) {
        if (!used_[i]) continue;
        sum += v(static_cast<Eigen::Index>(i)) * v(static_cast<Eigen::Index>(i));
        rows += 1.0;
    }
    return 1e3 * std::sqrt(sum / std::max(1.0, rows));
}

/// Relative standard error of the noise variance: from repeats, or from the freedom that was left.
double Diagnoser::noise_doubt() const {
    if (noise_.source == NoiseSource::repeats) return noise_.doubt;
    return std::sqrt(2.0 / std::max(1.0, independent_readings()));
}

/// Readings with independent noise that know as much about its variance as these.
double Diagnoser::independent_readings() const {
    double rows = 0.0;
    for (const NoiseBlock& block : blocks_)
        rows += noise_.of(block.device).independent(static_cast<double>(block.rows.size()));
    return rows;
}

}  // namespace trunnion
