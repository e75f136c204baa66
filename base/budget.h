// Limits of resources for a piece of work, as one value.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

namespace trunnion::inline base {

/// Limits; 0: none.
struct Budget {
    std::uint64_t blocks = 0;         ///< NC blocks executed
    std::uint64_t printed_bytes = 0;  ///< by DPRNT and BPRNT
    std::uint64_t rows = 0;           ///< readings
    double time_s = 0.0;              ///< wall clock time
    std::function<bool()> interrupted;
    /// Called every few thousand blocks with the number of blocks.
    std::function<void(std::uint64_t blocks)> progress;
};

/// The limit that ended the work.
enum class BudgetLimit : unsigned char { none, blocks, printed_bytes, rows, time, interruption };
/// "blocks", "printed_bytes", "rows", "time", "interruption"; "" for none.
const char* name_of(BudgetLimit limit);

struct Spent {
    std::uint64_t blocks = 0, printed_bytes = 0, rows = 0;
};

/// Checks one piece of work against its budget. Time counts from construction.
class BudgetMeter {
  public:
    explicit BudgetMeter(Budget budget) : budget_(std::move(budget)) {}

    /// False when a limit is reached; `reached` then returns it.
    bool allows(const Spent& spent);
    BudgetLimit reached() const { return reached_; }

  private:
    using Clock = std::chrono::steady_clock;
    BudgetLimit limit_at(const Spent& spent) const;

    Budget budget_;
    Clock::time_point start_ = Clock::now();
    BudgetLimit reached_ = BudgetLimit::none;
};

}  // namespace trunnion::inline base
