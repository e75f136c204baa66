#include "choices/row_losses.h"

namespace trunnion::choices {

std::vector<double> row_losses(const LogView& log, const std::vector<Pair>& pairs) {
    std::vector<double> loss(log.rows.size(), 0.0);
    for (const Pair& pair : pairs) {
        const double weight = log.rows[pair.row].weight;
        for (const Axis axis : log.axes)
            loss[pair.row] += weight * weight * pair.apart[axis] * pair.apart[axis];
    }
    return loss;
}

}  // namespace trunnion::choices
