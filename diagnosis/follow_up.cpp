// After the verdict: readings that were held out, and what to measure next.
#include <algorithm>
#include <cmath>

#include "diagnosis/diagnoser.h"
#include "diagnosis/next_measurement.h"
#include "effects/settings.h"
#include "base/alarm.h"

namespace trunnion {

/// The first two rivals of each claim, with the measurement that would tell them from it.
void Diagnoser::ask_next() {
    std::vector<AmbiguousPair> pairs;
    const Eigen::VectorXd x = design_->solve(columns_of(*design_, set_.members), set_.scale);
    Eigen::Index at = design_->base_count();
    for (const std::size_t m : set_.members) {
        const Candidate& claimed = design_->candidates()[m];
        const auto cause =
            std::find_if(result_.causes.begin(), result_.causes.end(),
                         [&](const Cause& c) { return c.effect == claimed.effect->name; });
        for (std::size_t k = 0; k < 2 && cause != result_.causes.end() && k < cause->rivals.size();
             ++k)
            for (const Candidate& rival : design_->candidates()) {
                if (rival.effect->name != cause->rivals[k] || !rival.visible) continue;
                pairs.push_back({&claimed, x.segment(at, claimed.size()), &rival});
                break;
            }
        at += claimed.size();
    }
    watch("the next measurement (Ctrl-C: the verdict without it)");
    result_.next =
        plan_next(*design_, base_, catalogue_, pairs, table_.rows.back().time_s, options_.plan_on);
}

void Diagnoser::test_holdout() {
    const ReadingTable& table = *options_.holdout;
    const Replay replay(base_.setup, table);
    const std::vector<double> before = replay.predict(base_.models);
    const Replay fitted(result_.setup, table);
    const std::vector<double> after = fitted.predict(active_models(result_.setup));
    const RowNoise noise = row_noise(base_.setup, table, replay);
    SquaredSums sums;
    double independent = 0.0;
    for (const NoiseBlock& block : noise_blocks(replay, table)) {
        double b = 0, a = 0, n = 0;
        for (const Eigen::Index i : block.rows) {
            const auto k = static_cast<std::size_t>(i);
            const Reading& row = table.rows[replay.table_row(k)];
            const double scale = noise_.of(block.device).scale;
            b += std::pow(*row.value_mm - before[k], 2);
            a += std::pow(*row.value_mm - after[k], 2);
            n += std::pow(scale * noise.sigma_mm(i), 2);
        }
        sums.before.push_back(b);
        sums.after.push_back(a);
        sums.noise.push_back(n);
        sums.rows.push_back(static_cast<double>(block.rows.size()));
        independent += noise_.of(block.device).independent(sums.rows.back());
    }
    // The noise of these few readings may by chance be smaller or larger than its variance says.
    const double chance = std::sqrt(2.0 / std::max(1.0, independent));
    result_.after = summarise(sums, options_.seed, std::hypot(noise_doubt(), chance));
    if (result_.causes.size() == 1) result_.causes.front().heldout = result_.after;
}

}  // namespace trunnion
