#include "choices/far_starts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace trunnion::choices {

namespace {

constexpr double beside = 1e-3;  ///< mm or deg from a value without a derivative
constexpr double alone = 1e-3;   ///< of a derivative: most along the other axes
constexpr double least_derivative = 0.5;
constexpr double least_far = 0.5;       ///< mm or deg: Gauss-Newton comes nearer by itself
constexpr double same = 8.0;            ///< sigmas between distances that are alike
constexpr std::size_t least_moves = 3;  ///< that have one distance
constexpr std::size_t most_starts = 2;  ///< of a number

/// The only axis that a number shifts.
std::optional<Axis> axis_of(const std::vector<Axis>& axes, const Column& column) {
    std::map<Axis, double> most;
    for (const auto& by : column)
        for (const Axis axis : axes) most[axis] = std::max(most[axis], std::abs(by[axis]));
    const auto own = std::max_element(
        most.begin(), most.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
    for (const auto& [axis, size] : most)
        if (axis != own->first && size > alone) return std::nullopt;
    return own->second >= least_derivative ? std::optional(own->first) : std::nullopt;
}

/// What a number lacks if a node stands where a row of it does in one axis.
struct Lack {
    double value;
    std::uint32_t node;
};

/// The lacks shared by most moves, the most frequent first.
std::vector<double> frequent(std::vector<Lack> lacks, double width) {
    std::sort(lacks.begin(), lacks.end(),
              [](const Lack& a, const Lack& b) { return a.value < b.value; });
    std::vector<std::pair<std::size_t, double>> found;  // moves, value
    for (std::size_t from = 0, to = 0; from < lacks.size(); from = to) {
        std::set<std::uint32_t> moves;
        for (to = from; to < lacks.size() && lacks[to].value <= lacks[from].value + width; ++to)
            moves.insert(lacks[to].node);
        const double middle = lacks[(from + to) / 2].value;
        if (moves.size() >= least_moves && std::abs(middle) > least_far)
            found.emplace_back(moves.size(), middle);
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    std::vector<double> out;
    for (std::size_t k = 0; k < std::min(most_starts, found.size()); ++k)
        out.push_back(found[k].second);
    return out;
}

bool is_level(const ControlPath& path, const Pair& pair, Axis axis) {
    return pair.node > 0 &&
           std::abs(path.nodes[pair.node].at[axis] - path.nodes[pair.node - 1].at[axis]) <= beside;
}

}  // namespace

/// The other axes alone tell which row belongs to which move.
std::vector<double> FarStarts::lacks(const FittedControl& here, const StoredNumber& number) const {
    const auto all = column_of(comparer_, here.setup, here.run, number);
    const auto axis = all ? axis_of(comparer_.log().axes, *all) : std::nullopt;
    LogView view = comparer_.log();
    if (!axis || view.axes.size() < 2) return {};
    std::erase(view.axes, *axis);
    const ComparedRun run = comparer_.on(view).compared(here.run.path);
    const auto column = column_of(comparer_, here.setup, run, number);
    if (!column) return {};
    std::vector<Lack> out;
    double sigma = 0.0;
    for (std::size_t k = 0; k < run.pairs.size(); ++k) {
        const Pair& pair = run.pairs[k];
        const double by = (*column)[k][*axis];
        // A stroke along the axis has no place in the others.
        if (std::abs(by) < least_derivative || !is_level(here.run.path, pair, *axis)) continue;
        const double apart =
            view.rows[pair.row].at[*axis] - here.run.path.nodes[pair.node].at[*axis];
        out.push_back({apart / by, pair.node});
        sigma = std::max(sigma, 1.0 / view.rows[pair.row].weight);
    }
    return frequent(std::move(out), same * sigma);
}

std::vector<FarStart> FarStarts::of(const StoredNumber& number, bool has_derivative) const {
    std::vector<FarStart> out;
    FittedControl here = now_;
    if (!has_derivative) {
        number.in(here.setup) += beside;
        here.run = comparer_.run(here.setup);
        out.push_back({&number, here});
    }
    if (comparer_.log().keys > 0) return out;
    for (const double lack : lacks(here, number)) {
        FittedControl other{here.setup, {}};
        number.in(other.setup) += lack;
        other.run = comparer_.run(other.setup);
        if (other.run.loss < now_.run.loss) out.push_back({&number, std::move(other)});
    }
    return out;
}

std::vector<FarStart> FarStarts::of_vacant(const Numbers& numbers) const {
    Numbers vacant;
    for (const StoredNumber* number : numbers)
        if (is_vacant(now_.setup, *number)) vacant.push_back(number);
    if (vacant.size() < 2) return {};
    FarStart out{vacant.front(), {now_.setup, {}}};
    for (const StoredNumber* number : vacant) number->in(out.control.setup) = beside;
    out.control.run = comparer_.run(out.control.setup);
    return {std::move(out)};
}

}  // namespace trunnion::choices
