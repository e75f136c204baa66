#include "base/budget.h"

#include <array>

namespace trunnion::inline base {
namespace {

bool is_used_up(std::uint64_t limit, std::uint64_t spent) {
    return limit > 0 && spent >= limit;
}

}  // namespace

const char* name_of(BudgetLimit limit) {
    constexpr std::array<const char*, 6> names{"",     "blocks", "printed_bytes",
                                               "rows", "time",   "interruption"};
    return names[static_cast<std::size_t>(limit)];
}

BudgetLimit BudgetMeter::limit_at(const Spent& spent) const {
    if (is_used_up(budget_.blocks, spent.blocks)) return BudgetLimit::blocks;
    if (is_used_up(budget_.printed_bytes, spent.printed_bytes)) return BudgetLimit::printed_bytes;
    if (is_used_up(budget_.rows, spent.rows)) return BudgetLimit::rows;
    const std::chrono::duration<double> passed = Clock::now() - start_;
    if (budget_.time_s > 0.0 && passed.count() >= budget_.time_s) return BudgetLimit::time;
    if (budget_.interrupted && budget_.interrupted()) return BudgetLimit::interruption;
    return BudgetLimit::none;
}

bool BudgetMeter::allows(const Spent& spent) {
    if (budget_.progress) budget_.progress(spent.blocks);
    reached_ = limit_at(spent);
    return reached_ == BudgetLimit::none;
}

}  // namespace trunnion::inline base
