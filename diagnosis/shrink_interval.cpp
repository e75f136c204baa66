#include "diagnosis/shrink_interval.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
namespace {

constexpr int draw_count = 400;
constexpr std::size_t probe_stretches =
    24;  ///< number of parts into which the probe poses are divided, in order

/// Effects with many parameters are often sparse: with this probability the undetermined parameters
/// are small, in units of their typical size.
constexpr double sparse_chance = 0.5, sparse_scale = 0.3;

/// Fresh readings are at the places of a table or between them, and its places show a part of its
/// curvature: up to twice the error that they show.
constexpr double most_between = 4.0;

/// Index of a model drawn by its weight.
std::size_t pick(const std::vector<PossibleTruth>& truths, double at) {
    double sum = 0.0;
    for (const PossibleTruth& t : truths) sum += t.weight;
    at *= sum;
    for (std::size_t k = 0; k < truths.size(); ++k)
        if ((at -= truths[k].weight) <= 0.0) return k;
    return truths.size() - 1;
}

/// Fresh readings are few and at other positions: squared exponential weights leave effectively a
/// sixth of the stretches.
double stretch_weight(SeededNoise& random) {
    const double even = -std::log(random.uniform());
    return even * even;
}

/// Probability that there is a remainder: evidence for a normal mean with unit information against
/// zero.
double chance_of_remainder(const std::vector<Missed>& missed) {
    double sum = 0.0, square = 0.0;
    for (const Missed& m : missed) {
        sum += m.square;
        square += m.square * m.square;
    }
    if (sum <= 0.0 || square <= 0.0) return 0.0;  // tiny squares underflow
    const double n = static_cast<double>(missed.size());
    // Of the evidence against it, which underflows for many stretches where the other overflows.
    const double against = std::exp(-0.5 * sum * sum / square * n / (n + 1.0)) * std::sqrt(n + 1.0);
    return 1.0 / (1.0 + against);
}

double remainder_per_row(const std::vector<Missed>& missed, double noise_factor,
                         SeededNoise& random) {
    double sum = 0.0, rows = 0.0;
    for (const Missed& m : missed) {
        const double weight = stretch_weight(random);
        sum += weight * (m.square - (noise_factor - 1.0) * m.noise);
        rows += weight * m.rows;
    }
    return rows > 0.0 ? sum / rows : 0.0;
}

/// Fraction of the squares that stays on left-out paths, in a draw of the paths.
double left_elsewhere(const Elsewhere& paths, SeededNoise& random) {
    double before = 0.0, after = 0.0;
    for (std::size_t k = 0; k < paths.before.size(); ++k) {
        const double weight = stretch_weight(random);
        before += weight * std::max(0.0, paths.before[k].square);
        after += weight * std::max(0.0, paths.after[k].square);
    }
    return before > 0.0 ? after / before : 1.0;
}

/// Directions of the set-up that the readings leave undetermined by more than a typical size.
Eigen::MatrixXd open_set_up(const Design& design) {
    Eigen::MatrixXd information = design.known().transpose() * design.known();
    if (information.size() == 0) return information;  // no free set-up quantity
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information);
    const auto open = (solver.eigenvalues().array() < 1.0).count();  // in ascending order
    return solver.eigenvectors().leftCols(open);
}

Model sparse(Model model) {
    for (double& tau : model.variances.tau) tau = std::min(tau, sparse_scale);
    return model;
}

}  // namespace

std::vector<std::vector<Eigen::Index>> stretches_of(const std::vector<NoiseBlock>& blocks) {
    std::vector<std::vector<Eigen::Index>> stretches;
    std::vector<const NoiseBlock*> poses;
    for (const NoiseBlock& block : blocks) {
        if (block.device == records::Device::ballbar)
            stretches.push_back(block.rows);
        else
            poses.push_back(&block);
    }
    const std::size_t parts = std::min(probe_stretches, poses.size());
    for (std::size_t k = 0; k < parts; ++k) {
        std::vector<Eigen::Index> rows;
        for (std::size_t p = k * poses.size() / parts; p < (k + 1) * poses.size() / parts; ++p)
            rows.insert(rows.end(), poses[p]->rows.begin(), poses[p]->rows.end());
        stretches.push_back(std::move(rows));
    }
    return stretches;
}

ShrinkDraws::ShrinkDraws(Design& design, const FreshReadings& fresh,
                         std::vector<PossibleTruth> truths, DrawSetting setting)
    : design_(design), truths_(std::move(truths)), setting_(std::move(setting)) {
    setting_.independent = std::max(1.0, setting_.independent);
    take_places(fresh);
    draw_all();
}

void ShrinkDraws::draw_all() {
    const double real = chance_of_remainder(setting_.missed);
    std::map<std::pair<std::size_t, bool>, Solution> solutions;  // by model and sparsity; computed
                                                                 // when drawn
    const auto solution_of = [&](std::size_t truth, bool narrow) -> const Solution& {
        const auto [at, is_new] = solutions.try_emplace({truth, narrow});
        const Model& model = truths_[truth].model;
        if (is_new) at->second = solved(design_, narrow ? sparse(model) : model);
        return at->second;
    };
    // Undetermined directions of the present set-up (e.g. a common shift of cup and pivot) are
    // fitted again by the next one.
    const Eigen::MatrixXd open = open_set_up(design_);
    SeededNoise random(setting_.seed);
    const auto count = static_cast<Eigen::Index>(rows_.size());
    Eigen::MatrixXd machines(places_, draw_count);
    weights_.resize(count, draw_count);
    for (Eigen::Index d = 0; d < draw_count; ++d) {
        const std::size_t k = pick(truths_, random.uniform());
        const double noise_factor = std::max(0.2, 1.0 + setting_.doubt * random.normal());
        const Solution& wide = solution_of(k, false);
        Eigen::VectorXd z(wide.mean.size());
        for (double& v : z) v = std::sqrt(noise_factor) * random.normal();
        Draw draw;
        Eigen::VectorXd off = solution_of(k, random.uniform() < sparse_chance).spread(z);
        off.head(wide.known) -= open * (open.transpose() * off.head(wide.known));
        machines.col(d) = over_places(truths_[k].model, wide.mean + off);
        double rows = 0.0;
        for (Eigen::Index b = 0; b < count; ++b) {
            weights_(b, d) = stretch_weight(random);
            rows += weights_(b, d) * static_cast<double>(rows_[static_cast<std::size_t>(b)]);
        }
        const double remainder = rows * remainder_per_row(setting_.missed, noise_factor, random);
        // A left-out stretch is farther from the others than fresh readings within it would be.
        if (random.uniform() < real) draw.remainder = random.uniform() * std::max(0.0, remainder);
        if (random.uniform() < setting_.unknown)
            draw.false_part = -std::log(random.uniform()) * random.uniform();
        draw.noise = rows * setting_.noise_per_row;
        draw.off = random.normal();
        draw.along_before = random.normal();
        draw.along_after = random.normal();
        draw.elsewhere = random.uniform();
        draw.left_there = left_elsewhere(setting_.elsewhere, random);
        if (setting_.between > 0.0)
            draw.between = most_between * setting_.between * random.uniform();
        draws_.push_back(draw);
    }
    read_.noalias() = columns_ * machines;
}

/// A mean square as estimated from noisy readings after subtracting the expected noise.
double ShrinkDraws::as_read(double square, const Draw& draw, double along) const {
    return std::max(0.0, square + draw.noise * std::sqrt(2.0 / setting_.independent) * draw.off +
                             2.0 * std::sqrt(square * draw.noise / setting_.independent) * along);
}

/// Squared prediction error of x for each drawn machine, weighted over the stretches.
std::vector<double> ShrinkDraws::squares_off(const Eigen::VectorXd& x) const {
    const Eigen::VectorXd said = columns_ * x;
    std::vector<double> sums;
    for (Eigen::Index d = 0; d < draw_count; ++d) {
        const Eigen::VectorXd square = (read_.col(d) - said).array().square();
        double sum = 0.0;
        Eigen::Index at = 0;
        for (std::size_t b = 0; b < rows_.size(); at += rows_[b++])
            sum += weights_(static_cast<Eigen::Index>(b), d) * square.segment(at, rows_[b]).sum();
        sums.push_back(sum);
    }
    return sums;
}

/// The columns of all models, once, in the order of the stretches of fresh readings.
void ShrinkDraws::take_places(const FreshReadings& fresh) {
    places_ = fresh.base().cols();
    for (const PossibleTruth& t : truths_)
        for (const std::size_t m : t.model.members)
            if (is_cause(design_.group(m).kind) && place_.try_emplace(m, places_).second)
                places_ += design_.group(m).columns();
    Eigen::MatrixXd all(fresh.base().rows(), places_);
    all.leftCols(fresh.base().cols()) = fresh.base();
    for (const auto& [group, at] : place_)
        all.middleCols(at, design_.group(group).columns()) = fresh.columns(design_.group(group));
    std::vector<Eigen::Index> order;
    for (const auto& rows : stretches_of(fresh.blocks())) {
        order.insert(order.end(), rows.begin(), rows.end());
        rows_.push_back(static_cast<Eigen::Index>(rows.size()));
    }
    columns_ = all(order, Eigen::all);
}

Eigen::VectorXd ShrinkDraws::over_places(const Model& model, const Eigen::VectorXd& x) const {
    const Eigen::Index known = design_.known().cols();
    Eigen::VectorXd all = Eigen::VectorXd::Zero(places_);
    all.head(known) = x.head(known);
    Eigen::Index at = known;
    for (const std::size_t m : model.members) {
        const Eigen::Index count = design_.group(m).columns();
        if (const auto it = place_.find(m); it != place_.end())
            all.segment(it->second, count) = x.segment(at, count);
        at += count;
    }
    return all;
}

std::pair<double, double> ShrinkDraws::interval(const Model& model) const {
    return ends(model, false);
}

std::pair<double, double> ShrinkDraws::interval_elsewhere(const Model& model) const {
    const auto here = ends(model, false), there = ends(model, true);
    return {std::min(here.first, there.first), std::max(here.second, there.second)};
}

std::pair<double, double> ShrinkDraws::ends(const Model& model, bool elsewhere) const {
    const Model nothing{{}, {{}, model.variances.nu}, 0.0};
    const std::vector<double> off_with =
        squares_off(over_places(model, solved(design_, model).mean));
    const std::vector<double> off_without =
        squares_off(over_places(nothing, solved(design_, nothing).mean));
    std::vector<double> shrink;
    for (std::size_t d = 0; d < draws_.size(); ++d) {
        const double before = draws_[d].remainder + off_without[d];
        double after = draws_[d].remainder + off_with[d];
        after += 2.0 * draws_[d].false_part * std::max(0.0, before - after);
        if (elsewhere) {
            after += draws_[d].elsewhere * std::max(0.0, before * draws_[d].left_there - after);
            after += before * draws_[d].between;
        }
        const double read = as_read(before, draws_[d], draws_[d].along_before);
        after = as_read(after, draws_[d], draws_[d].along_after);
        shrink.push_back(read > 0.0 ? 1.0 - std::sqrt(after / read) : 0.0);
    }
    return {estimation::quantile(shrink, 0.025), estimation::quantile(shrink, 0.975)};
}

}  // namespace trunnion::diagnosis
