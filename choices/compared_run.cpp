#include "choices/compared_run.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "choices/row_losses.h"

namespace trunnion::choices {

ComparedRun Comparer::compared(ControlPath path) const {
    ComparedRun out{std::move(path), {}, {}, 0.0};
    out.pairs = pair_up(log_, out.path);
    out.losses = row_losses(log_, out.pairs);
    out.loss = sum_of(out.losses);
    return out;
}

namespace {

bool is_same(const PathNode& p, const PathNode& q) {
    constexpr double same = 1e-7;
    for (std::size_t i = 0; i < axis_count; ++i)
        if (!(std::abs(p.at.value[i] - q.at.value[i]) <= same)) return false;
    return true;
}

}  // namespace

bool same_way(const ControlPath& a, const ControlPath& b) {
    return std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), is_same);
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace trunnion::choices
