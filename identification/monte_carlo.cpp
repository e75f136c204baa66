#include "identification/monte_carlo.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

#include "base/random.h"
#include "effects/settings.h"

namespace trunnion::identification {

namespace {

/// Data that all repetitions read and none changes.
struct Repeated {
    const setup::Setup& setup;
    const std::vector<std::string>& effects;
    const Identification& fitted;
    records::ReadingTable exact;
    emulator::Replay replay;
    RowNoise noise;
    std::uint64_t seed;
};

/// `exact` plus noise with the sigma of each device row.
records::ReadingTable noisy(const Repeated& of, SeededNoise random) {
    records::ReadingTable table = of.exact;
    for (std::size_t i = 0; i < of.replay.size(); ++i)
        *table.rows[of.replay.table_row(i)].value_mm +=
            of.noise.sigma_mm[static_cast<Eigen::Index>(i)] * random.normal();
    return table;
}

/// The generator of one repetition. Each has its own seed, because repetitions that continue one
/// stream would share numbers.
SeededNoise noise_of(std::uint64_t seed, int index) {
    const std::uint64_t stream = SeededNoise(seed).bits();
    return SeededNoise(SeededNoise(stream + static_cast<std::uint64_t>(index)).bits());
}

Repetition repeat_once(const Repeated& of, int index) {
    const Identification again =
        identify(of.setup, noisy(of, noise_of(of.seed, index)), of.effects);
    Repetition result{index, {}};
    for (std::size_t k = 0; k < of.fitted.parameters.size(); ++k)
        result.off.push_back(again.parameters[k].value - of.fitted.parameters[k].value);
    return result;
}

/// Data shared by the threads.
struct Work {
    std::atomic<int> next = 0;
    std::atomic<bool> stop = false;
    std::mutex mutex;  ///< protects the following members
    std::vector<Repetition> done;
    std::exception_ptr failed;
};

void work_on(Work& work, const Repeated& of, const RepetitionPlan& plan) {
    while (!work.stop) {
        const int index = work.next.fetch_add(plan.step);
        if (index >= plan.runs) return;
        try {
            Repetition result = repeat_once(of, index);
            const std::lock_guard lock(work.mutex);
            work.done.push_back(std::move(result));
            if (plan.go_on && !plan.go_on(static_cast<int>(work.done.size()))) work.stop = true;
        } catch (...) {
            const std::lock_guard lock(work.mutex);
            work.failed = std::current_exception();
            work.stop = true;
        }
    }
}

}  // namespace

std::vector<Repetition> repeat_identification(const setup::Setup& setup,
                                              const records::ReadingTable& table,
                                              const std::vector<std::string>& effects,
                                              const RepetitionPlan& plan,
                                              const Identification& fitted) {
    emulator::Replay replay(setup, table);
    RowNoise noise = row_noise(setup, table, replay);
    const Repeated of{
        setup,
        effects,
        fitted,
        emulator::predicted(fitted.setup, table, effects::active_models(fitted.setup)),
        std::move(replay),
        std::move(noise),
        plan.seed};
    Work work;
    work.next = plan.first;
    {
        std::vector<std::jthread> others;
        for (unsigned i = 1; i < plan.threads; ++i)
            others.emplace_back([&] { work_on(work, of, plan); });
        work_on(work, of, plan);
    }
    if (work.failed) std::rethrow_exception(work.failed);
    std::sort(work.done.begin(), work.done.end(),
              [](const Repetition& a, const Repetition& b) { return a.index < b.index; });
    return std::move(work.done);
}

std::vector<double> spread(const std::vector<Repetition>& repetitions) {
    std::vector<double> sigma;
    const auto n = static_cast<double>(repetitions.size());
    for (std::size_t k = 0; !repetitions.empty() && k < repetitions.front().off.size(); ++k) {
        double sum = 0.0, square = 0.0;
        for (const Repetition& r : repetitions) {
            sum += r.off[k];
            square += r.off[k] * r.off[k];
        }
        sigma.push_back(std::sqrt(std::max(0.0, (square - sum * sum / n) / (n - 1.0))));
    }
    return sigma;
}

void enter_spread(const std::vector<Repetition>& repetitions, Identification& fitted) {
    if (repetitions.size() < 2) return;
    const std::vector<double> sigma = spread(repetitions);
    for (std::size_t k = 0; k < sigma.size(); ++k) {
        FitParameter& p = fitted.parameters[k];
        p.sigma_monte_carlo =
            std::isfinite(p.sigma) ? sigma[k] : std::numeric_limits<double>::quiet_NaN();
    }
}

}  // namespace trunnion::identification
