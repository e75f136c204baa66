// How much a piece of work may use before it ends in order, as one value.
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
    double time_s = 0.0;              ///< on the clock on the wall
    std::function<bool()> interrupted;
    /// Told how far the work is, every few thousand blocks.
    std::function<void(std::uint64_t blocks)> progress;
};

/// Which limit ended the work.
enum class BudgetLimit : unsigned char { none, blocks, printed_bytes, rows, time, interruption };
/// "blocks", "printed_bytes", "rows", "time", "interruption"; "" for none.
const char* name_of(BudgetLimit limit);

struct Spent {
    std::uint64_t blocks = 0, printed_bytes = 0, rows = 0;
};

/// Holds one piece of work to its budget. Time counts from the construction.
class BudgetMeter {
  public:
    explicit BudgetMeter(Budget budget) : budget_(std::move(budget)) {}

    /// False when a limit is reached; `reached` then says which.
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
