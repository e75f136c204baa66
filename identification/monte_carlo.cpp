#include "identification/monte_carlo.h"

#include <cmath>
#include <limits>

#include "base/random.h"
#include "effects/settings.h"

namespace trunnion::identification {

namespace {

/// `exact` with noise of each device row's sigma.
records::ReadingTable noisy(const records::ReadingTable& exact, const emulator::Replay& replay,
                            const RowNoise& noise, SeededNoise& random) {
    records::ReadingTable table = exact;
    for (std::size_t i = 0; i < replay.size(); ++i)
        *table.rows[replay.table_row(i)].value_mm +=
            noise.sigma_mm[static_cast<Eigen::Index>(i)] * random.normal();
    return table;
}

}  // namespace

int add_monte_carlo(const setup::Setup& setup, const records::ReadingTable& table,
                    const std::vector<std::string>& effects, int runs, std::uint64_t seed,
                    Identification& fitted, const std::function<bool(int done)>& go_on) {
    const records::ReadingTable exact =
        emulator::predicted(fitted.setup, table, effects::active_models(fitted.setup));
    const emulator::Replay replay(setup, table);
    const RowNoise noise = row_noise(setup, table, replay);
    const std::size_t count = fitted.parameters.size();
    std::vector<double> sum(count, 0.0), square(count, 0.0);
    SeededNoise random(seed);
    int done = 0;
    for (bool more = true; more && done < runs; more = !go_on || go_on(done)) {
        const Identification again = identify(setup, noisy(exact, replay, noise, random), effects);
        for (std::size_t k = 0; k < count; ++k) {
            const double off = again.parameters[k].value - fitted.parameters[k].value;
            sum[k] += off;
            square[k] += off * off;
        }
        ++done;
    }
    if (done < 2) return done;
    for (std::size_t k = 0; k < count; ++k)
        fitted.parameters[k].sigma_monte_carlo =
            std::isfinite(fitted.parameters[k].sigma)
                ? std::sqrt(std::max(0.0, (square[k] - sum[k] * sum[k] / done) / (done - 1)))
                : std::numeric_limits<double>::quiet_NaN();
    return done;
}

}  // namespace trunnion::identification
