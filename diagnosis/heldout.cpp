#include "diagnosis/heldout.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/search.h"
#include "diagnosis/statistics.h"
#include "base/random.h"

namespace trunnion {
namespace {

double shrink_of(double before, double after, double noise) {
    const double gap = before - noise;
    if (gap <= 0.0) return 0.0;
    return 1.0 - std::sqrt(std::max(0.0, after - noise) / gap);
}

HeldOut figures_of(const SquaredSums& sums) {
    double before = 0, after = 0, noise = 0, rows = 0;
    for (std::size_t g = 0; g < sums.before.size(); ++g) {
        before += sums.before[g];
        after += sums.after[g];
        noise += sums.noise[g];
        rows += sums.rows[g];
    }
    HeldOut result;
    if (rows == 0.0) return result;
    result.rms_before_um = 1e3 * std::sqrt(before / rows);
    result.rms_after_um = 1e3 * std::sqrt(after / rows);
    result.noise_um = 1e3 * std::sqrt(noise / rows);
    result.shrink = result.low = result.high = shrink_of(before, after, noise);
    return result;
}

}  // namespace

Folds make_folds(const std::vector<NoiseBlock>& blocks, std::size_t rows) {
    Folds folds;
    folds.group.assign(rows, 0);
    int pass = 0;
    for (const NoiseBlock& block : blocks) {
        const bool bar = block.device == Device::ballbar;
        const std::size_t pieces = bar ? std::min<std::size_t>(6, 1 + block.rows.size() / 8) : 1;
        const auto first = static_cast<int>(folds.fold.size());
        for (std::size_t k = 0; k < block.rows.size(); ++k)
            folds.group[static_cast<std::size_t>(block.rows[k])] =
                first + static_cast<int>(k * pieces / block.rows.size());
        for (std::size_t k = 0; k < pieces; ++k)
            folds.fold.push_back((bar ? 3 * pass + static_cast<int>(k) : pass) % Folds::count);
        ++pass;
    }
    return folds;
}

HeldOut summarise(const SquaredSums& sums, std::uint64_t seed, double doubt) {
    HeldOut result = figures_of(sums);
    SeededNoise random(seed);
    std::vector<double> draws;
    for (int k = 0; k < 400; ++k) {
        double before = 0, after = 0, noise = 0;
        for (std::size_t g = 0; g < sums.before.size(); ++g) {
            const double weight = -std::log(random.uniform());
            before += weight * sums.before[g];
            after += weight * sums.after[g];
            noise += weight * sums.noise[g];
        }
        noise *= std::max(0.2, 1.0 + doubt * random.normal());
        draws.push_back(shrink_of(before, after, noise));
    }
    result.low = std::min(result.shrink, quantile(draws, 0.025));
    result.high = std::max(result.shrink, quantile(draws, 0.975));
    return result;
}

HeldOut cross_validate(const Design& design, const BaseModel& base, const Folds& folds,
                       const std::vector<std::size_t>& members, double scale,
                       const Eigen::VectorXd& noise_mm, const std::vector<bool>& used) {
    const std::vector<Eigen::Index> columns = columns_of(design, members);
    const auto groups = folds.fold.size();
    SquaredSums sums{std::vector<double>(groups), std::vector<double>(groups),
                     std::vector<double>(groups), std::vector<double>(groups)};
    const auto n = static_cast<std::size_t>(base.residual_mm.size());
    for (int f = 0; f < Folds::count; ++f) {
        std::vector<Eigen::Index> test;
        for (std::size_t i = 0; i < n; ++i)
            if (folds.fold[static_cast<std::size_t>(folds.group[i])] == f)
                test.push_back(static_cast<Eigen::Index>(i));
        const Eigen::VectorXd without = design.residual_without(test, {}, scale);
        const Eigen::VectorXd with = design.residual_without(test, columns, scale);
        for (std::size_t k = 0; k < test.size(); ++k) {
            const auto i = static_cast<std::size_t>(test[k]);
            if (!used[i]) continue;
            const auto g = static_cast<std::size_t>(folds.group[i]);
            const auto at = static_cast<Eigen::Index>(k);
            sums.before[g] += without(at) * without(at);
            sums.after[g] += with(at) * with(at);
            sums.noise[g] += noise_mm(test[k]) * noise_mm(test[k]);
            sums.rows[g] += 1.0;
        }
    }
    return figures_of(sums);
}

}  // namespace trunnion
