#include "cli/budget_options.h"

#include <CLI/CLI.hpp>
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
