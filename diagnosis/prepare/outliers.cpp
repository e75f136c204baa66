#include "diagnosis/prepare/outliers.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "diagnosis/rules/rules.h"
#include "estimation/projection.h"
#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
namespace {

constexpr double wild_sigma = 4.5;
constexpr double least_deviation = 0.5;  ///< minimum scale, relative to the noise

/// Residuals of the set-up fit to the rows of `used`, divided by their own standard deviation.
Eigen::VectorXd studentised(const identification::BaseModel& base, const std::vector<bool>& used) {
    Eigen::VectorXd weight = base.sigma_mm.cwiseInverse();
    for (Eigen::Index i = 0; i < weight.size(); ++i)
        if (!used[static_cast<std::size_t>(i)]) weight(i) = 0.0;
    const estimation::Projection set_up(weight.asDiagonal() * base.columns);
    const Eigen::VectorXd left = set_up.beside(weight.cwiseProduct(base.residual_mm));
    const Eigen::ArrayXd own = 1.0 - set_up.basis().rowwise().squaredNorm().array();
    return left.array() / own.max(0.05).sqrt();
}

/// A value that the maximum of n normal deviates rarely exceeds.
double largest_by_chance(double n) {
    return std::sqrt(2.0 * std::log(std::max(2.0, n))) + 1.0;
}

/// True when the rows are in three or more neighbouring blocks (poses, passes). One bad pose may
/// spoil all its readings; random blocks rarely are neighbours.
bool crowded(const std::vector<std::size_t>& rows, const std::vector<NoiseBlock>& blocks) {
    std::vector<std::size_t> block_of;
    for (std::size_t b = 0; b < blocks.size(); ++b)
        for (const Eigen::Index row : blocks[b].rows) {
            block_of.resize(std::max(block_of.size(), static_cast<std::size_t>(row) + 1));
            block_of[static_cast<std::size_t>(row)] = b;
        }
    std::set<std::size_t> hit;
    for (const std::size_t row : rows) hit.insert(block_of[row]);
    if (hit.size() < 3) return false;
    const auto close = std::max<std::size_t>(1, blocks.size() / (5 * hit.size()));
    std::size_t pairs = 0;
    for (auto it = std::next(hit.begin()); it != hit.end(); ++it)
        pairs += *it - *std::prev(it) <= close ? 1 : 0;
    return 10 * pairs > 4 * hit.size();
}

/// The same within one pass, whose readings are one block. With random rows 18 of 100 neighbours
/// are closer than a fifth of the mean distance.
bool crowded(const std::vector<std::size_t>& rows, std::size_t all) {
    if (rows.size() <= 8) return false;
    const std::size_t close = std::max<std::size_t>(2, all / (5 * rows.size()));
    std::size_t pairs = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) pairs += rows[k] - rows[k - 1] <= close ? 1 : 0;
    return 10 * pairs > 4 * rows.size();
}

bool too_many(std::size_t count, std::size_t all) {
    return static_cast<double>(count) > rules::most_outliers * static_cast<double>(all);
}

}  // namespace

std::vector<std::size_t> lone_probe_readings(const Prepared& prepared,
                                             const std::vector<bool>& used) {
    std::vector<bool> kept = used;
    std::vector<std::size_t> lone;
    const auto is_probe_row = [&](std::size_t i) {
        const records::Device device = prepared.replay.contact(i).device;
        return device == records::Device::sphere || device == records::Device::touch;
    };
    for (int pass = 0; pass < 40; ++pass) {
        const Eigen::VectorXd z = studentised(prepared.base, kept).cwiseAbs();
        std::vector<double> size;
        double worst = 0.0;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            if (!kept[i] || !is_probe_row(i)) continue;
            size.push_back(z(static_cast<Eigen::Index>(i)));
            worst = std::max(worst, size.back());
        }
        const double limit = largest_by_chance(static_cast<double>(used.size())) *
                             std::max(least_deviation, estimation::robust_deviation(size));
        if (size.empty() || worst < limit) break;
        for (std::size_t i = 0; i < kept.size(); ++i) {
            if (!kept[i] || !is_probe_row(i)) continue;
            if (z(static_cast<Eigen::Index>(i)) < std::max(limit, 0.7 * worst)) continue;
            kept[i] = false;
            lone.push_back(i);
        }
        if (too_many(lone.size(), used.size())) return {};
    }
    std::sort(lone.begin(), lone.end());
    const bool keep = crowded(lone, used.size()) || crowded(lone, prepared.blocks);
    return keep ? std::vector<std::size_t>{} : lone;
}

std::vector<std::size_t> wild_readings(const Eigen::VectorXd& left, const std::vector<bool>& used) {
    std::vector<double> size;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) size.push_back(std::abs(left(static_cast<Eigen::Index>(i))));
    const double limit = std::max(wild_sigma, largest_by_chance(static_cast<double>(size.size()))) *
                         std::max(least_deviation, estimation::robust_deviation(size));
    std::vector<std::size_t> wild;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i] && std::abs(left(static_cast<Eigen::Index>(i))) > limit) wild.push_back(i);
    const bool keep = too_many(wild.size(), used.size()) || crowded(wild, used.size());
    return keep ? std::vector<std::size_t>{} : wild;
}

}  // namespace trunnion::diagnosis
