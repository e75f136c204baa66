// The limits of a command that runs NC programs: --max-blocks, --max-print, --max-readings,
// --max-seconds.
#pragma once

#include <chrono>
#include <cstdint>

#include "base/budget.h"

namespace CLI {
class App;
}

namespace trunnion::cli {

/// 0: no limit. An endless program ends at the first limit reached, exit code 4.
struct BudgetOptions {
    std::uint64_t blocks = 100'000'000, printed_bytes = 100'000'000, rows = 10'000'000;
    double time_s = 0.0;
};

void add_budget(CLI::App& command, BudgetOptions& limits);
/// The budget, with Ctrl-C as an additional limit.
Budget budget_of(const BudgetOptions& limits);
/// --max-seconds of a command that fits: what is found until then is its result.
void add_fit_seconds(CLI::App& command, double& time_s);
/// That limit, and Ctrl-C. To be asked as long as an Interruption lives.
BudgetMeter fit_meter(double time_s);
/// The same two limits for several threads at once. Time counts from construction.
class SharedLimits {
  public:
    explicit SharedLimits(double time_s);
    BudgetLimit reached() const;

  private:
    double time_s_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};
/// --max-memory of a command, in MB of the program's own data; obeyed from where it is read.
void add_memory_limit(CLI::App& command);
/// "interrupted", "--max-seconds", ...: what ended the work, for a message.
const char* reason_of(BudgetLimit limit);
/// Says on stderr which limit ended the work; returns its exit code.
int report_limit(BudgetLimit limit, std::uint64_t blocks);

}  // namespace trunnion::cli
