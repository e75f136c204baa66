#include "choices/store_columns.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "choices/folds.h"

namespace trunnion::choices {

namespace {

using Eigen::MatrixXd, Eigen::VectorXd;
using offsets::ControlPosition;

/// mm or deg, for the derivatives; the next one is used if a step changes the sequence of moves.
constexpr double steps[] = {1e-3, -1e-3, 1e-2, -1e-2};
constexpr double least_influence = 1e-6;
constexpr double most_influence = 10.0;  ///< of a number on a point of the path, mm or deg
constexpr double still_falls = 0.99;     ///< of the loss, from iteration to iteration

ControlPosition at(const ControlPath& path, const Pair& pair) {
    const ControlPosition& end = path.nodes[pair.node].at;
    if (pair.fraction == 1.0 || pair.node == 0) return end;
    const ControlPosition& begin = path.nodes[pair.node - 1].at;
    ControlPosition out;
    for (std::size_t i = 0; i < axis_count; ++i)
        out.value[i] = begin.value[i] + pair.fraction * (end.value[i] - begin.value[i]);
    return out;
}

double dot(const ControlPosition& a, const ControlPosition& b, const std::vector<Axis>& axes) {
    double sum = 0.0;
    for (const Axis axis : axes) sum += a[axis] * b[axis];
    return sum;
}

/// Removes the component along the segment of the pair.
void take_out_travel(const ControlPath& path, const Pair& pair, const std::vector<Axis>& axes,
                     ControlPosition& v) {
    ControlPosition way;
    for (const Axis axis : axes)
        way[axis] = path.nodes[pair.node].at[axis] - path.nodes[pair.node - 1].at[axis];
    const double length = dot(way, way, axes);
    if (length == 0.0) return;
    const double along = dot(way, v, axes) / length;
    for (const Axis axis : axes) v[axis] -= along * way[axis];
}

double distance_of(const ControlPosition& a, const ControlPosition& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < axis_count; ++i)
        sum += (a.value[i] - b.value[i]) * (a.value[i] - b.value[i]);
    return std::sqrt(sum);
}

/// `other` without the moves that the step made of none: a move of no length is not in a path.
/// Nothing if the paths differ in more than that.
std::optional<ControlPath> without_new_moves(const ControlPath& path, ControlPath other,
                                             double step) {
    const double near = most_influence * std::abs(step);
    const std::size_t none = other.nodes.size();
    std::vector<PathNode> kept;
    // How far a node is from the next one of the path; more than `near`: it is another one.
    const auto apart = [&](std::size_t k) {
        if (k == none || kept.size() == path.nodes.size()) return 2.0 * near;
        const PathNode &node = other.nodes[k], &own = path.nodes[kept.size()];
        const PathBlock &block = other.blocks[node.block], &own_block = path.blocks[own.block];
        const bool same = block.line == own_block.line && block.program == own_block.program &&
                          node.end == own.end;
        return same ? distance_of(node.at, own.at) : 2.0 * near;
    };
    for (std::size_t k = 0; k < none; ++k) {
        // Of two nodes close to each other the new one is farther away, as an overrun is.
        if (apart(k) <= near && apart(k) <= apart(k + 1))
            kept.push_back(other.nodes[k]);
        else if (apart(k) > near &&
                 (k == 0 || distance_of(other.nodes[k].at, other.nodes[k - 1].at) > near))
            return std::nullopt;
    }
    if (kept.size() != path.nodes.size()) return std::nullopt;
    other.nodes = std::move(kept);
    return other;
}

struct Stepped {
    ControlPath path;
    double step = 0.0;       ///< 0: every step changes the moves
    bool new_moves = false;  ///< which are left out
};

Stepped stepped(const ControlPath& path, const SteppedPath& path_at) {
    Stepped out;
    for (const double step : steps) {
        ControlPath other = path_at(step);
        if (other.nodes.size() == path.nodes.size()) return {std::move(other), step, false};
        if (out.step != 0.0 || other.nodes.size() < path.nodes.size()) continue;
        if (auto same = without_new_moves(path, std::move(other), step))
            out = {std::move(*same), step, true};
    }
    return out;
}

/// Loss of a pair after a change `x` of the numbers.
double loss_with(const Comparer& comparer, const Pair& pair, const std::vector<Column>& columns,
                 const VectorXd& x, std::size_t k) {
    const double weight = comparer.log().rows[pair.row].weight;
    double sum = 0.0;
    for (const Axis axis : comparer.log().axes) {
        double apart = pair.apart[axis];
        for (Eigen::Index c = 0; c < x.size(); ++c)
            apart -= x[c] * columns[static_cast<std::size_t>(c)][k][axis];
        sum += apart * apart;
    }
    return sum * weight * weight;
}

}  // namespace

double value_of(const setup::Setup& setup, const StoredNumber& number) {
    setup::Setup copy = setup;
    return number.in(copy);
}

std::optional<Column> column_of(const Comparer& comparer, const setup::Setup& setup,
                                const ComparedRun& run, const StoredNumber& number,
                                bool* other_moves) {
    if (is_vacant(setup, number)) {
        if (other_moves != nullptr) *other_moves = true;
        return std::nullopt;
    }
    const auto moved = [&](double step) {
        setup::Setup out = setup;
        number.in(out) += step;
        return out;
    };
    if (!SameWay(comparer, setup, run.path).may_differ(moved(steps[0]))) return std::nullopt;
    const auto path_at = [&](double step) { return comparer.path(moved(step)); };
    return column_of(comparer, run, path_at, other_moves);
}

std::optional<Column> column_of(const Comparer& comparer, const ComparedRun& run,
                                const SteppedPath& path_at, bool* other_moves) {
    const auto [path, step, new_moves] = stepped(run.path, path_at);
    if (step == 0.0) {
        if (other_moves != nullptr) *other_moves = true;
        return std::nullopt;
    }
    const std::vector<Axis>& axes = comparer.log().axes;
    Column out(run.pairs.size());
    double most = 0.0;
    for (std::size_t k = 0; k < out.size(); ++k) {
        const Pair& pair = run.pairs[k];
        const ControlPosition here = at(run.path, pair), there = at(path, pair);
        for (const Axis axis : axes) out[k][axis] = (there[axis] - here[axis]) / step;
        most = std::max(most, dot(out[k], out[k], axes));
        if (pair.slides) take_out_travel(run.path, pair, axes, out[k]);
    }
    if (most > least_influence) return out;
    // Nothing but the new moves depends on it.
    if (new_moves && other_moves != nullptr) *other_moves = true;
    return std::nullopt;
}

std::vector<Column> columns_of(const Comparer& comparer, const setup::Setup& setup,
                               const ComparedRun& run, const Numbers& numbers) {
    std::vector<Column> out;
    for (const StoredNumber* number : numbers)
        if (auto column = column_of(comparer, setup, run, *number))
            out.push_back(std::move(*column));
    return out;
}

Normal normal_of(const Comparer& comparer, const ComparedRun& run,
                 const std::vector<Column>& columns,
                 const std::function<double(std::size_t)>& part) {
    const auto n = static_cast<Eigen::Index>(columns.size());
    Normal out{MatrixXd::Zero(n, n), VectorXd::Zero(n)};
    const std::vector<Axis>& axes = comparer.log().axes;
    for (std::size_t k = 0; k < run.pairs.size(); ++k) {
        const Pair& pair = run.pairs[k];
        const double weight = comparer.log().rows[pair.row].weight,
                     w = weight * weight * part(pair.row);
        if (w == 0.0) continue;
        for (Eigen::Index a = 0; a < n; ++a) {
            const ControlPosition& column = columns[static_cast<std::size_t>(a)][k];
            out.right[a] += w * dot(column, pair.apart, axes);
            for (Eigen::Index b = 0; b <= a; ++b)
                out.matrix(a, b) += w * dot(column, columns[static_cast<std::size_t>(b)][k], axes);
        }
    }
    out.matrix = out.matrix.selfadjointView<Eigen::Lower>();
    return out;
}

Normal normal_of(const Comparer& comparer, const ComparedRun& run,
                 const std::vector<Column>& columns) {
    return normal_of(comparer, run, columns, [](std::size_t) { return 1.0; });
}

Normal part_of(const Normal& all, const std::vector<Eigen::Index>& list) {
    return {all.matrix(list, list), all.right(list)};
}

VectorXd solved(Normal normal, const VectorXd& otherwise) {
    const double pull = 1e-9 * std::max(normal.matrix.trace(), 1e-12);
    normal.matrix.diagonal().array() += pull;
    return normal.matrix.ldlt().solve(normal.right + pull * otherwise);
}

VectorXd sigmas(Normal normal, double scale) {
    const auto n = normal.matrix.rows();
    normal.matrix.diagonal().array() += 1e-9 * std::max(normal.matrix.trace(), 1e-12);
    const MatrixXd inverse = normal.matrix.ldlt().solve(MatrixXd::Identity(n, n));
    return (scale * inverse.diagonal().array().max(0.0)).sqrt();
}

double scale_of(const Comparer& comparer, double loss) {
    const double count = static_cast<double>(comparer.log().rows.size()) *
                         static_cast<double>(comparer.log().axes.size());
    return std::max(1.0, loss / count);
}

std::vector<double> left_out_losses(const Comparer& comparer, const ComparedRun& run,
                                    const std::vector<Column>& columns, const VectorXd& back,
                                    const std::vector<int>& folds) {
    std::vector<double> out(run.losses.size(), 0.0);
    for (int fold = 0; fold < fold_count; ++fold) {
        const auto others = [&](std::size_t row) { return folds[row] != fold ? 1.0 : 0.0; };
        const VectorXd x = solved(normal_of(comparer, run, columns, others), back);
        for (std::size_t k = 0; k < run.pairs.size(); ++k)
            if (folds[run.pairs[k].row] == fold)
                out[run.pairs[k].row] += loss_with(comparer, run.pairs[k], columns, x, k);
    }
    return out;
}

bool take_step(const Comparer& comparer, const Numbers& numbers, const VectorXd& x,
               FittedControl& control) {
    for (double part = 1.0; part > 0.2; part *= 0.5) {
        setup::Setup moved = control.setup;
        for (Eigen::Index k = 0; k < x.size(); ++k)
            numbers[static_cast<std::size_t>(k)]->in(moved) += part * x[k];
        ComparedRun run = comparer.run(moved);
        if (run.loss >= control.run.loss * 0.9999) continue;
        control = {std::move(moved), std::move(run)};
        return true;
    }
    return false;
}

bool improve(const Comparer& comparer, const Numbers& numbers, FittedControl& control) {
    const auto columns = columns_of(comparer, control.setup, control.run, numbers);
    if (columns.size() != numbers.size()) return false;
    const double before = control.run.loss;
    const VectorXd none = VectorXd::Zero(static_cast<Eigen::Index>(numbers.size()));
    return take_step(comparer, numbers, solved(normal_of(comparer, control.run, columns), none),
                     control) &&
           control.run.loss < still_falls * before;
}

}  // namespace trunnion::choices
