#include "regression/run_states.h"

#include <cmath>

namespace trunnion::regression {

bool same_value(const std::array<double, 3>& p, const std::array<double, 3>& q) {
    for (std::size_t k = 0; k < 3; ++k)
        if (std::abs(p[k] - q[k]) > 1e-3 + 1e-6 * std::abs(p[k])) return false;
    return true;
}

std::uint64_t RunStates::at(std::uint64_t segment) {
    std::uint64_t low = 0, high = rows_.size();
    while (low + 1 < high) {
        const std::uint64_t middle = (low + high) / 2;
        (rows_[middle].first_segment <= segment ? low : high) = middle;
    }
    return low;
}

std::uint64_t RunStates::entry(const SnapshotField& field, std::uint64_t index) {
    const auto value = field.value(rows_[index].state);
    constexpr std::uint64_t farthest = 20000;
    const std::uint64_t stop = index > farthest ? index - farthest : 0;
    while (index > stop && same_value(field.value(rows_[index - 1].state), value)) --index;
    return index;
}

}  // namespace trunnion::regression
