#include "choices/store_fit.h"

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
constexpr double least_change = 1e-4;  ///< mm or deg: the smallest increment that is entered in
                                       ///< practice
constexpr double least_sigmas = 4.0;
constexpr double least_part = 1e-3;   ///< of the loss: minimum reduction by another number
constexpr double still_falls = 0.99;  ///< of the loss, from iteration to iteration
constexpr int most_rounds = 25;

/// Derivative of each pair's control position with respect to one stored number; empty where the
/// program then executes other moves.
using Column = std::vector<ControlPosition>;

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

/// The path with one number a step farther, and that step; 0 where every step changes the moves.
std::pair<ControlPath, double> stepped(const Comparer& comparer, const setup::Setup& setup,
                                       const ControlPath& path, const StoredNumber& number) {
    for (const double step : steps) {
        setup::Setup moved = setup;
        number.in(moved) += step;
        ControlPath other = comparer.path(moved);
        if (other.nodes.size() == path.nodes.size()) return {std::move(other), step};
    }
    return {{}, 0.0};
}

std::optional<Column> column_of(const Comparer& comparer, const setup::Setup& setup,
                                const ComparedRun& run, const StoredNumber& number) {
    const auto [path, step] = stepped(comparer, setup, run.path, number);
    if (step == 0.0) return std::nullopt;
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
    return most > least_influence ? std::optional(std::move(out)) : std::nullopt;
}

/// Normal equations of the pairs with rows in `use`.
struct Normal {
    MatrixXd matrix;
    VectorXd right;
};

template <class Use>
Normal normal_of(const Comparer& comparer, const ComparedRun& run,
                 const std::vector<Column>& columns, Use use) {
    const auto n = static_cast<Eigen::Index>(columns.size());
    Normal out{MatrixXd::Zero(n, n), VectorXd::Zero(n)};
    const std::vector<Axis>& axes = comparer.log().axes;
    for (std::size_t k = 0; k < run.pairs.size(); ++k) {
        const Pair& pair = run.pairs[k];
        if (!use(pair.row)) continue;
        const double weight = comparer.log().rows[pair.row].weight, w = weight * weight;
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

/// Solution with a ridge of 1e-9 of the trace towards `otherwise`. It does not change a number that
/// the pairs determine; a number on which no pair depends becomes `otherwise`.
VectorXd solved(Normal normal, const VectorXd& otherwise) {
    const double pull = 1e-9 * std::max(normal.matrix.trace(), 1e-12);
    normal.matrix.diagonal().array() += pull;
    return normal.matrix.ldlt().solve(normal.right + pull * otherwise);
}

/// With the same ridge, so that a number on which no pair depends has a very large sigma.
VectorXd sigmas(Normal normal, double scale) {
    const auto n = normal.matrix.rows();
    normal.matrix.diagonal().array() += 1e-9 * std::max(normal.matrix.trace(), 1e-12);
    const MatrixXd inverse = normal.matrix.ldlt().solve(MatrixXd::Identity(n, n));
    return (scale * inverse.diagonal().array().max(0.0)).sqrt();
}

Normal part_of(const Normal& all, const std::vector<Eigen::Index>& list) {
    return {all.matrix(list, list), all.right(list)};
}

class Fitter {
  public:
    Fitter(const Comparer& comparer, const setup::Setup& setup, const ComparedRun& before,
           const Store& store)
        : comparer_(comparer), start_(setup), before_(before), setup_(setup), run_(before) {
        for (const StoredNumber& number : store.numbers) seen_.push_back(&number);
    }

    StoreFit fit(const std::vector<int>& blocks) {
        StoreFit out;
        columns_ = keep_seen();
        out.seen = !seen_.empty();
        while (numbers_.size() < seen_.size() && add_number()) {
            for (int round = 1; round < most_rounds && improve(); ++round) {
            }
            columns_ = columns(seen_);
            if (columns_.size() != seen_.size()) break;
        }
        if (numbers_.empty()) return out;
        columns_ = columns(numbers_);
        if (columns_.size() != numbers_.size()) return out;
        tell(out);
        out.left_out = left_out(folds_for(before_.losses, run_.losses, blocks));
        out.setup = std::move(setup_);
        out.run = std::move(run_);
        return out;
    }

  private:
    using Numbers = std::vector<const StoredNumber*>;

    std::vector<Column> columns(const Numbers& numbers) const {
        std::vector<Column> out;
        for (const StoredNumber* number : numbers)
            if (auto column = column_of(comparer_, setup_, run_, *number))
                out.push_back(std::move(*column));
        return out;
    }
    /// Keeps in `seen_` the numbers that the path depends on, and returns their columns.
    std::vector<Column> keep_seen() {
        Numbers seen;
        std::vector<Column> out;
        for (const StoredNumber* number : seen_) {
            auto column = column_of(comparer_, setup_, run_, *number);
            if (!column) continue;
            out.push_back(std::move(*column));
            seen.push_back(number);
        }
        seen_ = std::move(seen);
        return out;
    }
    Normal whole() const {
        return normal_of(comparer_, run_, columns_, [](std::size_t) { return true; });
    }
    /// Residual of a fit, in units of the log's variance, at least one.
    double scale(double loss) const {
        const double count = static_cast<double>(comparer_.log().rows.size()) *
                             static_cast<double>(comparer_.log().axes.size());
        return std::max(1.0, loss / count);
    }
    /// `columns_` are those of `seen_`. Adds the number that, fitted together with those already
    /// included, reduces the loss most, if it is significant; false if there is none.
    bool add_number() {
        const Normal all = whole();
        std::vector<Eigen::Index> in;
        for (const StoredNumber* number : numbers_) in.push_back(place_of(number));
        Eigen::Index best = -1;
        double most = least_part * run_.loss;
        for (Eigen::Index k = 0; k < all.right.size(); ++k) {
            if (std::find(in.begin(), in.end(), k) != in.end()) continue;
            const double gain = gain_with(all, in, k);
            if (gain <= most) continue;
            most = gain;
            best = k;
        }
        if (best < 0) return false;
        numbers_.push_back(seen_[static_cast<std::size_t>(best)]);
        in.push_back(best);
        if (take(solved(part_of(all, in), VectorXd::Zero(count())))) return true;
        numbers_.pop_back();
        return false;
    }
    Eigen::Index place_of(const StoredNumber* number) const {
        return std::find(seen_.begin(), seen_.end(), number) - seen_.begin();
    }
    /// Loss removed by number `k` beside those included; 0 if it is not significant.
    double gain_with(const Normal& all, std::vector<Eigen::Index> in, Eigen::Index k) const {
        in.push_back(k);
        const Normal normal = part_of(all, in);
        const Eigen::Index last = normal.right.size() - 1;
        const VectorXd x = solved(normal, VectorXd::Zero(last + 1));
        const double gain = normal.right.dot(x);
        const double sigma = sigmas(normal, scale(std::max(0.0, run_.loss - gain)))[last];
        const bool stands_out = std::abs(x[last]) > std::max(least_change, least_sigmas * sigma);
        return stands_out ? gain : 0.0;
    }
    bool improve() {
        columns_ = columns(numbers_);
        if (columns_.size() != numbers_.size()) return false;
        const double before = run_.loss;
        return take(solved(whole(), VectorXd::Zero(count()))) && run_.loss < still_falls * before;
    }
    Eigen::Index count() const { return static_cast<Eigen::Index>(numbers_.size()); }
    /// Applies the step, or half or a quarter of it, if the loss decreases.
    bool take(const VectorXd& x) {
        for (double part = 1.0; part > 0.2; part *= 0.5) {
            setup::Setup moved = setup_;
            for (Eigen::Index k = 0; k < x.size(); ++k)
                numbers_[static_cast<std::size_t>(k)]->in(moved) += part * x[k];
            ComparedRun run = comparer_.run(moved);
            if (run.loss >= run_.loss * 0.9999) continue;
            setup_ = std::move(moved);
            run_ = std::move(run);
            return true;
        }
        return false;
    }
    double value(const setup::Setup& setup, const StoredNumber& number) const {
        setup::Setup copy = setup;
        return number.in(copy);
    }
    void tell(StoreFit& out) const {
        const VectorXd s = sigmas(whole(), scale(run_.loss));
        for (Eigen::Index k = 0; k < count(); ++k) {
            const StoredNumber& number = *numbers_[static_cast<std::size_t>(k)];
            const double from = value(start_, number), to = value(setup_, number);
            if (std::abs(to - from) > least_change)
                out.numbers.push_back({number.name, number.unit, from, to, s[k]});
        }
    }
    /// Each fold with the numbers fitted to the others; if these do not determine them, with the
    /// old ones.
    std::vector<double> left_out(const std::vector<int>& folds) const {
        VectorXd back(count());
        for (Eigen::Index k = 0; k < count(); ++k) {
            const StoredNumber& number = *numbers_[static_cast<std::size_t>(k)];
            back[k] = value(start_, number) - value(setup_, number);
        }
        std::vector<double> out(run_.losses.size(), 0.0);
        for (int fold = 0; fold < fold_count; ++fold) {
            const VectorXd x =
                solved(normal_of(comparer_, run_, columns_,
                                 [&](std::size_t row) { return folds[row] != fold; }),
                       back);
            for (std::size_t k = 0; k < run_.pairs.size(); ++k)
                if (folds[run_.pairs[k].row] == fold) out[run_.pairs[k].row] += loss_with(x, k);
        }
        return out;
    }
    double loss_with(const VectorXd& x, std::size_t k) const {
        const Pair& pair = run_.pairs[k];
        const double weight = comparer_.log().rows[pair.row].weight;
        double sum = 0.0;
        for (const Axis axis : comparer_.log().axes) {
            double apart = pair.apart[axis];
            for (Eigen::Index c = 0; c < x.size(); ++c)
                apart -= x[c] * columns_[static_cast<std::size_t>(c)][k][axis];
            sum += apart * apart;
        }
        return sum * weight * weight;
    }

    const Comparer& comparer_;
    const setup::Setup& start_;
    const ComparedRun& before_;
    setup::Setup setup_;
    ComparedRun run_;
    Numbers seen_, numbers_;  ///< numbers that the path depends on, and those of them that are
                              ///< fitted
    std::vector<Column> columns_;
};

}  // namespace

StoreFit fit_store(const Comparer& comparer, const setup::Setup& setup, const ComparedRun& before,
                   const Store& store, const std::vector<int>& blocks) {
    return Fitter(comparer, setup, before, store).fit(blocks);
}

}  // namespace trunnion::choices
