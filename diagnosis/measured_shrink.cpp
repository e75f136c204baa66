// Reduction of the gap on separate readings.
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "diagnosis/diagnosis_report.h"
#include "diagnosis/prepare/holdout_zeros.h"
#include "diagnosis/prepare/outliers.h"
#include "effects/settings.h"
#include "estimation/quantiles.h"
#include "identification/resolution.h"

namespace trunnion::diagnosis {
namespace {

/// Squares before and after, with their expectation from noise alone, by block, mm^2.
struct SquaredSums {
    std::vector<double> before, after, noise;
    double independent = 0.0;
    double whitened_before = 0.0, whitened_after = 0.0;  ///< divided by the variance of the noise
    double freedom = 0.0;       ///< readings, less the zeros that they determine
    std::size_t set_aside = 0;  ///< spoiled readings, in none of the sums
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

/// Sizes of a separate table beside a prediction, without and with the causes, mm.
struct Separate {
    emulator::Replay replay;
    std::vector<std::vector<std::size_t>> zeros;
    std::vector<NoiseBlock> blocks;
    Eigen::VectorXd sigma_mm;  ///< as the noise was found in the fit
    Eigen::VectorXd before_mm, after_mm;
    std::vector<bool> used;  ///< false: spoiled
};

Eigen::VectorXd beside(const records::ReadingTable& table, const emulator::Replay& replay,
                       const std::vector<double>& predicted) {
    Eigen::VectorXd left(static_cast<Eigen::Index>(predicted.size()));
    for (std::size_t k = 0; k < predicted.size(); ++k)
        left(static_cast<Eigen::Index>(k)) =
            *table.rows[replay.table_row(k)].value_mm - predicted[k];
    return left;
}

/// Readings far from the prediction with the causes, by the rule for the fit, unless the causes
/// themselves put them there.
std::vector<bool> not_spoiled(const Separate& held, const records::ReadingTable& table) {
    const Eigen::VectorXd digit =
        last_digit(identification::rounding(table, held.replay), held.sigma_mm);
    Eigen::VectorXd before = held.before_mm, after = held.after_mm;
    free_medians(held.zeros, before);
    free_medians(held.zeros, after);
    std::vector<bool> used(held.replay.size(), true);
    // Few readings: two of 48 are more than the usual part, and no more than chance.
    for (const std::size_t i :
         wild_readings({after.cwiseQuotient(held.sigma_mm), digit, devices_of(held.replay)}, used,
                       most_by_chance(used.size()))) {
        const auto at = static_cast<Eigen::Index>(i);
        used[i] = std::abs(after(at) - before(at)) > 0.5 * std::abs(after(at));
    }
    return used;
}

Separate separate(const Outcome& f, const setup::Setup& setup, const records::ReadingTable& table) {
    const setup::Setup& base = f.prepared.base.setup;
    Separate held{emulator::Replay(base, table), {}, {}, {}, {}, {}, {}};
    const emulator::Replay fitted(setup, table);
    held.zeros = rows_of_zeros(held.replay);
    held.blocks = noise_blocks(held.replay, table);
    held.sigma_mm = identification::row_noise(base, table, held.replay).sigma_mm;
    for (const NoiseBlock& block : held.blocks)
        for (const Eigen::Index i : block.rows)
            held.sigma_mm(i) = std::hypot(held.sigma_mm(i), f.prepared.added(block.device)) *
                               std::sqrt(f.judgement.floor) * f.noise.model.of(block.device).scale;
    held.before_mm = beside(table, held.replay, held.replay.predict(f.prepared.base.models));
    held.after_mm = beside(table, fitted, fitted.predict(effects::active_models(setup)));
    held.used = not_spoiled(held, table);
    free_means(held.zeros, held.used, held.sigma_mm, held.before_mm);
    free_means(held.zeros, held.used, held.sigma_mm, held.after_mm);
    return held;
}

/// Part of the noise that remains in each reading beside its zero.
std::vector<double> noise_left(const Separate& held) {
    std::vector<double> part(held.replay.size(), 1.0);
    for (const std::vector<std::size_t>& rows : held.zeros) {
        const auto used =
            std::count_if(rows.begin(), rows.end(), [&](std::size_t k) { return held.used[k]; });
        for (const std::size_t k : rows) part[k] -= 1.0 / std::max(1.0, static_cast<double>(used));
    }
    return part;
}

SquaredSums sums_of(const Outcome& f, const setup::Setup& setup,
                    const records::ReadingTable& table) {
    const Separate held = separate(f, setup, table);
    const std::vector<double> part = noise_left(held);
    SquaredSums sums;
    for (const NoiseBlock& block : held.blocks) {
        double b = 0, a = 0, n = 0, rows = 0;
        for (const Eigen::Index i : block.rows) {
            const auto k = static_cast<std::size_t>(i);
            if (!held.used[k]) {
                ++sums.set_aside;
                continue;
            }
            const double before = std::pow(held.before_mm(i), 2),
                         after = std::pow(held.after_mm(i), 2), own = std::pow(held.sigma_mm(i), 2);
            b += before;
            a += after;
            n += part[k] * own;
            sums.whitened_before += before / own;
            sums.whitened_after += after / own;
            sums.freedom += part[k];
            rows += 1.0;
        }
        if (rows == 0.0) continue;
        sums.before.push_back(b);
        sums.after.push_back(a);
        sums.noise.push_back(n);
        sums.independent += f.noise.model.of(block.device).independent(rows);
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
              0.0,
              sums.set_aside};
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
