#include "cli/budget_options.h"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>

#include "base/console.h"
#include "cli/command.h"
#include "cli/long_work.h"
#include "cli/options.h"

namespace trunnion::cli {

void add_budget(CLI::App& command, BudgetOptions& limits) {
    command.add_option("--max-blocks", limits.blocks,
                       "stop after this number of blocks (1e8; 0: never)");
    command.add_option("--max-print", limits.printed_bytes,
                       "stop when DPRNT has printed this number of bytes (1e8; 0: never)");
    command.add_option("--max-readings", limits.rows,
                       "stop after this number of readings (1e7; 0: never)");
    not_negative(
        command.add_option("--max-seconds", limits.time_s, "stop after this time, s (0: never)"));
}

Budget budget_of(const BudgetOptions& limits) {
    return {limits.blocks, limits.printed_bytes, limits.rows,
            limits.time_s, Interruption::asked,  {}};
}

void add_fit_seconds(CLI::App& command, double& time_s) {
    not_negative(command.add_option(
        "--max-seconds", time_s,
        "end the search after this time, s, with the best result so far (0: never)"));
}

BudgetMeter fit_meter(double time_s) {
    Budget budget;
    budget.time_s = time_s;
    budget.interrupted = Interruption::asked;
    return BudgetMeter(std::move(budget));
}

SharedLimits::SharedLimits(double time_s) : time_s_(time_s) {}

BudgetLimit SharedLimits::reached() const {
    if (Interruption::asked()) return BudgetLimit::interruption;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
    return time_s_ > 0.0 && passed.count() >= time_s_ ? BudgetLimit::time : BudgetLimit::none;
}

void add_memory_limit(CLI::App& command) {
    command.add_option_function<std::uint64_t>(
        "--max-memory",
        [](std::uint64_t megabytes) {
            if (megabytes == 0) return;
            constexpr std::uint64_t most = RLIM_INFINITY / 1'000'000;
            const rlim_t bytes = std::min(megabytes, most) * 1'000'000;
            rlimit limit{};
            if (::getrlimit(RLIMIT_DATA, &limit) != 0) return;
            limit.rlim_cur = std::min(bytes, limit.rlim_max);
            ::setrlimit(RLIMIT_DATA, &limit);
        },
        "end when it needs more memory than so many MB (0: no limit of its own)");
}

const char* reason_of(BudgetLimit limit) {
    constexpr std::array<const char*, 6> reasons{
        "", "--max-blocks", "--max-print", "--max-readings", "--max-seconds", "interrupted"};
    return reasons[static_cast<std::size_t>(limit)];
}

int report_limit(BudgetLimit limit, std::uint64_t blocks) {
    print_error("trunnion: stopped after {} blocks ({})\n", blocks, reason_of(limit));
    return exit_limit;
}

}  // namespace trunnion::cli
