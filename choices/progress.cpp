#include "choices/progress.h"

namespace trunnion::choices {

namespace {

constexpr std::size_t rows_around = 2;  ///< on each side

}  // namespace

Strides::Strides(const LogView& log, const Space& space) {
    const std::size_t n = log.rows.size();
    even_ = log.even;
    lost_ = log.lost;
    next_.assign(n, 0.0);
    for (std::size_t i = 0; i + 1 < n; ++i)
        next_[i] = std::sqrt(space.square(log.rows[i].at, log.rows[i + 1].at));
    for (std::size_t i = 0; i < n; ++i) {
        double most = log.spacing;
        const std::size_t last = std::min(n - 1, i + rows_around);
        for (std::size_t k = i > rows_around ? i - rows_around : 0; k < last; ++k)
            if (!log.rows[k].cut) most = std::max(most, next_[k]);
        around_.push_back(most);
    }
}

}  // namespace trunnion::choices
