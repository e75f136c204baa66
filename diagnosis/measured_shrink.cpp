// Reduction of the gap on separate readings.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "diagnosis/diagnosis_report.h"
#include "effects/settings.h"
#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
namespace {

/// Squares before and after, with their expectation from noise alone, by block, mm^2.
struct SquaredSums {
    std::vector<double> before, after, noise, rows;
    double independent = 0.0;
    double whitened_before = 0.0, whitened_after = 0.0;  ///< divided by the variance of the noise
    double freedom = 0.0;  ///< readings, less the zeros that they determine
};

double shrink_of(double before, double after, double noise) {
    const double gap = before - noise;
    return gap > 0.0 ? 1.0 - std::sqrt(std::max(0.0, after - noise) / gap) : 0.0;
}

double total(const std::vector<double>& v) {
    double sum = 0.0;
    for (const double x : v) sum += x;
    return sum;
}

/// What is measured beside a prediction, mm; the zero of each test and session of a laser or
/// autocollimator is free, also in readings that took no part in the fit.
Eigen::VectorXd left_of(const emulator::Replay& replay, const records::ReadingTable& table,
                        const std::vector<double>& predicted, const Eigen::VectorXd& sigma_mm) {
    Eigen::VectorXd left(static_cast<Eigen::Index>(predicted.size()));
    for (std::size_t k = 0; k < predicted.size(); ++k)
        left(static_cast<Eigen::Index>(k)) =
            *table.rows[replay.table_row(k)].value_mm - predicted[k];
    free_zeros(replay, sigma_mm, left);
    return left;
}

/// Part of the noise that remains in each reading beside the zero of its test.
std::vector<double> noise_left(const emulator::Replay& replay) {
    std::vector<double> part(replay.size(), 1.0);
    for (const emulator::ZeroGroup& group : replay.zeros())
        for (const std::size_t k : group.rows)
            part[k] -= 1.0 / static_cast<double>(group.rows.size());
    return part;
}

SquaredSums sums_of(const Outcome& f, const setup::Setup& setup,
                    const records::ReadingTable& table) {
    const emulator::Replay replay(f.prepared.base.setup, table), fitted(setup, table);
    const identification::RowNoise noise =
        identification::row_noise(f.prepared.base.setup, table, replay);
    const Eigen::VectorXd before =
        left_of(replay, table, replay.predict(f.prepared.base.models), noise.sigma_mm);
    const Eigen::VectorXd after =
        left_of(fitted, table, fitted.predict(effects::active_models(setup)), noise.sigma_mm);
    const std::vector<double> part = noise_left(replay);
    SquaredSums sums;
    for (const NoiseBlock& block : noise_blocks(replay, table)) {
        double b = 0, a = 0, n = 0;
        for (const Eigen::Index i : block.rows) {
            const auto k = static_cast<std::size_t>(i);
            const double scale = f.noise.model.of(block.device).scale;
            b += std::pow(before(i), 2);
            a += std::pow(after(i), 2);
            const double own = f.judgement.floor * std::pow(scale * noise.sigma_mm(i), 2);
            n += part[k] * own;
            sums.whitened_before += std::pow(before(i), 2) / own;
            sums.whitened_after += std::pow(after(i), 2) / own;
            sums.freedom += part[k];
        }
        sums.before.push_back(b);
        sums.after.push_back(a);
        sums.noise.push_back(n);
        sums.rows.push_back(static_cast<double>(block.rows.size()));
        sums.independent += f.noise.model.of(block.device).independent(sums.rows.back());
    }
    return sums;
}

}  // namespace

double measured_part(const Outcome& f, const setup::Setup& setup,
                     const records::ReadingTable& holdout) {
    const SquaredSums sums = sums_of(f, setup, holdout);
    const double rows = sums.freedom, excess = sums.whitened_before - rows;
    const double chance = 3.0 * std::sqrt(2.0 * rows);  // three sigma of the squared noise itself
    // Readings without a gap say nothing of the causes, unless these would make one.
    if (excess < chance) return sums.whitened_after - sums.whitened_before < chance ? 1.0 : 0.0;
    return (sums.whitened_before - sums.whitened_after) / excess;
}

HeldOut measured_shrink(const Outcome& f, const setup::Setup& setup,
                        const records::ReadingTable& holdout, std::uint64_t seed) {
    constexpr int draws = 400;
    const SquaredSums sums = sums_of(f, setup, holdout);
    const double before = total(sums.before), after = total(sums.after), noise = total(sums.noise);
    const double rows = std::max(1.0, sums.freedom);
    const double micro = records::micro_per_one(holdout);
    HeldOut h{micro * std::sqrt(before / rows),
              micro * std::sqrt(after / rows),
              micro * std::sqrt(noise / rows),
              shrink_of(before, after, noise),
              0.0,
              0.0};
    // The noise of these few readings may by chance differ from its variance.
    const double doubt =
        std::hypot(f.noise.model.doubt, std::sqrt(2.0 / std::max(1.0, sums.independent)));
    SeededNoise random(seed);
    std::vector<double> shrink;
    for (int k = 0; k < draws; ++k) {
        double b = 0, a = 0, n = 0;
        for (std::size_t g = 0; g < sums.before.size(); ++g) {
            const double weight = -std::log(random.uniform());
            b += weight * sums.before[g];
            a += weight * sums.after[g];
            n += weight * sums.noise[g];
        }
        n *= std::max(0.2, 1.0 + doubt * random.normal());
        shrink.push_back(shrink_of(b, a, n));
    }
    h.low = std::min(h.shrink.value(), estimation::quantile(shrink, 0.025));
    h.high = std::max(h.shrink.value(), estimation::quantile(shrink, 0.975));
    return h;
}

}  // namespace trunnion::diagnosis
