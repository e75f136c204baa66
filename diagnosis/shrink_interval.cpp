#include "diagnosis/shrink_interval.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "diagnosis/statistics.h"
#include "base/random.h"

namespace trunnion {
namespace {

constexpr int draw_count = 400;
constexpr std::size_t probe_stretches =
    24;  ///< into which the poses of the probe are cut, in order

/// Effects with many parameters often have few of them: with this chance those that the readings
/// leave open are small, in units of their typical size.
constexpr double sparse_chance = 0.5, sparse_scale = 0.3;

/// Index of a truth drawn with its weight.
std::size_t pick(const std::vector<PossibleTruth>& truths, double at) {
    double sum = 0.0;
    for (const PossibleTruth& t : truths) sum += t.weight;
    at *= sum;
    for (std::size_t k = 0; k < truths.size(); ++k)
        if ((at -= truths[k].weight) <= 0.0) return k;
    return truths.size() - 1;
}

/// Fresh readings are few and elsewhere: squared exponential weights leave as much as a sixth of
/// the stretches.
double stretch_weight(SeededNoise& random) {
    const double even = -std::log(random.uniform());
    return even * even;
}

/// Rows of stretches: every pass of the ballbar; the poses of the probe, in order, in parts.
std::vector<std::vector<Eigen::Index>> stretches_of(const std::vector<NoiseBlock>& blocks) {
    std::vector<std::vector<Eigen::Index>> stretches;
    std::vector<const NoiseBlock*> poses;
    for (const NoiseBlock& block : blocks) {
        if (block.device == Device::ballbar)
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

}  // namespace

ShrinkDraws::ShrinkDraws(const Design& design, const std::vector<NoiseBlock>& blocks,
                         const FreshReadings& fresh, const Eigen::VectorXd& noise_mm,
                         const std::vector<bool>& used, std::vector<PossibleTruth> truths,
                         double unknown, std::uint64_t seed, double doubt, double independent)
    : design_(design), truths_(std::move(truths)), independent_(std::max(1.0, independent)) {
    take_places(fresh);
    const double noise_per_row = noise_mm.squaredNorm() / static_cast<double>(noise_mm.size());
    const std::vector<Missed> missed_here = missed(blocks, noise_mm, used);
    const double real = chance_of_remainder(missed_here);
    std::vector<Posterior> posterior, sparse;
    for (const PossibleTruth& t : truths_) {
        posterior.push_back(design.posterior(t.columns, t.scale));
        sparse.push_back(design.posterior(t.columns, std::min(t.scale, sparse_scale)));
    }
    // What the set-up leaves open here (cup and pivot shifted together) the next one fits anew.
    const Eigen::MatrixXd open = design.open_base();
    SeededNoise random(seed);
    const auto count = static_cast<Eigen::Index>(square_.size());
    machines_.resize(static_cast<Eigen::Index>(places_.size()), draw_count);
    weights_.resize(count, draw_count);
    for (Eigen::Index d = 0; d < draw_count; ++d) {
        const std::size_t k = pick(truths_, random.uniform());
        const double noise_factor = std::max(0.2, 1.0 + doubt * random.normal());
        Eigen::VectorXd z(posterior[k].mean.size());
        for (double& v : z) v = std::sqrt(noise_factor) * random.normal();
        Draw draw;
        const Posterior& around = random.uniform() < sparse_chance ? sparse[k] : posterior[k];
        Eigen::VectorXd off = around.spread(z);
        off.head(design.base_count()) -= open * (open.transpose() * off.head(design.base_count()));
        machines_.col(d) = over_places(truths_[k].columns, posterior[k].mean + off);
        double rows = 0.0;
        for (Eigen::Index b = 0; b < count; ++b) {
            weights_(b, d) = stretch_weight(random);
            rows += weights_(b, d) * rows_[static_cast<std::size_t>(b)];
        }
        const double remainder = rows * remainder_per_row(missed_here, noise_factor, random);
        if (random.uniform() < real) draw.remainder = std::max(0.0, remainder);
        if (random.uniform() < unknown)
            draw.false_part = -std::log(random.uniform()) * random.uniform();
        draw.noise = rows * noise_per_row;
        draw.off = random.normal();
        draw.along_before = random.normal();
        draw.along_after = random.normal();
        draws_.push_back(draw);
    }
    for (const Eigen::MatrixXd& square : square_)
        moved_.push_back((square * machines_).cwiseProduct(machines_).colwise().sum().transpose());
}

/// Is there a remainder at all? Evidence for a normal mean of unit information against zero.
double ShrinkDraws::chance_of_remainder(const std::vector<Missed>& missed) {
    double sum = 0.0, square = 0.0;
    for (const Missed& m : missed) {
        sum += m.square;
        square += m.square * m.square;
    }
    if (sum <= 0.0 || square <= 0.0) return 0.0;
    const double n = static_cast<double>(missed.size());
    const double factor = std::exp(0.5 * sum * sum / square * n / (n + 1.0)) / std::sqrt(n + 1.0);
    return factor / (1.0 + factor);
}

double ShrinkDraws::remainder_per_row(const std::vector<Missed>& missed, double noise_factor,
                                      SeededNoise& random) {
    double sum = 0.0, rows = 0.0;
    for (const Missed& m : missed) {
        const double weight = stretch_weight(random);
        sum += weight * (m.square - (noise_factor - 1.0) * m.noise);
        rows += weight * m.rows;
    }
    return rows > 0.0 ? sum / rows : 0.0;
}

/// A mean square as noisy readings show it once the expected noise is taken off.
double ShrinkDraws::as_read(double square, const Draw& draw, double along) const {
    return std::max(0.0, square + draw.noise * std::sqrt(2.0 / independent_) * draw.off +
                             2.0 * std::sqrt(square * draw.noise / independent_) * along);
}

/// Squares of what a prediction x misses of each drawn machine, weighted over the stretches:
/// (m - x)' S (m - x) with the part of m alone known already.
std::vector<double> ShrinkDraws::squares_off(const Eigen::VectorXd& x) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(draw_count);
    for (std::size_t b = 0; b < square_.size(); ++b) {
        const Eigen::VectorXd turned = square_[b] * x;
        const Eigen::VectorXd off = moved_[b] - 2.0 * machines_.transpose() * turned +
                                    Eigen::VectorXd::Constant(draw_count, turned.dot(x));
        sum +=
            off.cwiseMax(0.0).cwiseProduct(weights_.row(static_cast<Eigen::Index>(b)).transpose());
    }
    return {sum.begin(), sum.end()};
}

/// The columns of all truths once, and their squares over each stretch of fresh readings.
void ShrinkDraws::take_places(const FreshReadings& fresh) {
    for (Eigen::Index k = 0; k < design_.base_count(); ++k) places_.push_back(k);
    std::vector<Eigen::Index> effects;
    for (const PossibleTruth& t : truths_)
        effects.insert(effects.end(), t.columns.begin(), t.columns.end());
    std::sort(effects.begin(), effects.end());
    effects.erase(std::unique(effects.begin(), effects.end()), effects.end());
    for (const Eigen::Index k : effects) places_.push_back(design_.base_count() + k);
    const Eigen::MatrixXd all = fresh.columns(design_, places_);
    for (const auto& rows : stretches_of(fresh.blocks())) {
        const Eigen::MatrixXd a = all(rows, Eigen::all);
        square_.push_back(a.transpose() * a);
        rows_.push_back(static_cast<double>(rows.size()));
    }
}

Eigen::VectorXd ShrinkDraws::over_places(const std::vector<Eigen::Index>& columns,
                                         const Eigen::VectorXd& x) const {
    const Eigen::Index base = design_.base_count();
    Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(places_.size()));
    all.head(base) = x.head(base);
    for (std::size_t k = 0; k < columns.size(); ++k) {
        const auto at = std::lower_bound(places_.begin() + base, places_.end(), base + columns[k]);
        all(at - places_.begin()) = x(base + static_cast<Eigen::Index>(k));
    }
    return all;
}

/// By stretch: what predictions without it miss, squared, beyond noise and the fit's own error.
std::vector<ShrinkDraws::Missed> ShrinkDraws::missed(const std::vector<NoiseBlock>& blocks,
                                                     const Eigen::VectorXd& noise_mm,
                                                     const std::vector<bool>& used) const {
    std::vector<Missed> list;
    for (const auto& rows : stretches_of(blocks)) {
        Eigen::VectorXd fit_variance;
        const Eigen::VectorXd left = design_.residual_without(rows, truths_.front().columns,
                                                              truths_.front().scale, &fit_variance);
        Missed missed;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            if (!used[static_cast<std::size_t>(rows[k])]) continue;
            const auto at = static_cast<Eigen::Index>(k);
            const double own = noise_mm(rows[k]) * noise_mm(rows[k]);
            missed.square += left(at) * left(at) - own - fit_variance(at);
            missed.noise += own;
            missed.rows += 1.0;
        }
        list.push_back(missed);
    }
    return list;
}

std::pair<double, double> ShrinkDraws::interval(const std::vector<Eigen::Index>& columns,
                                                double scale) const {
    const Eigen::VectorXd with = over_places(columns, design_.solve(columns, scale));
    const Eigen::VectorXd without = over_places({}, design_.solve({}, scale));
    const std::vector<double> off_with = squares_off(with), off_without = squares_off(without);
    std::vector<double> shrink;
    for (std::size_t d = 0; d < draws_.size(); ++d) {
        const double before = draws_[d].remainder + off_without[d];
        double after = draws_[d].remainder + off_with[d];
        after += 2.0 * draws_[d].false_part * std::max(0.0, before - after);
        const double read = as_read(before, draws_[d], draws_[d].along_before);
        after = as_read(after, draws_[d], draws_[d].along_after);
        shrink.push_back(read > 0.0 ? 1.0 - std::sqrt(after / read) : 0.0);
    }
    return {quantile(shrink, 0.025), quantile(shrink, 0.975)};
}

}  // namespace trunnion
