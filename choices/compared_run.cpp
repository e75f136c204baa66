#include "choices/compared_run.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "choices/row_losses.h"

namespace trunnion::choices {

ControlPath Comparer::outline(const setup::Setup& setup) const {
    PathOptions options = options_;
    options.chord_mm = std::numeric_limits<double>::infinity();
    return path_of(setup, program_, programs_, options);
}

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

namespace {

/// Most of the points are those of curves, and they are many.
bool has_long_curves(const ControlPath& path) {
    constexpr std::size_t many = 5000, an_end = 16;
    const auto ends = std::count_if(path.nodes.begin(), path.nodes.end(),
                                    [](const PathNode& node) { return node.end; });
    return path.nodes.size() > std::max(many, an_end * static_cast<std::size_t>(ends));
}

}  // namespace

SameWay::SameWay(const Comparer& comparer, const setup::Setup& setup, const ControlPath& path)
    : comparer_(comparer), path_(path) {
    if (has_long_curves(path)) outline_ = comparer.outline(setup);
}

bool SameWay::may_differ(const setup::Setup& setup) const {
    return !outline_ || !same_way(comparer_.outline(setup), *outline_);
}

std::optional<ControlPath> SameWay::other(const setup::Setup& setup) const {
    if (!may_differ(setup)) return std::nullopt;
    ControlPath path = comparer_.path(setup);
    if (same_way(path, path_)) return std::nullopt;
    return path;
}

double sum_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace trunnion::choices
