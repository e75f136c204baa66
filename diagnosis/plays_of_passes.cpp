#include "diagnosis/plays_of_passes.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "diagnosis/prepare/cycles.h"
#include "diagnosis/rules/rules.h"
#include "estimation/distributions.h"

namespace trunnion::diagnosis {
namespace {

/// One way of an axis over targets of a test. Lengths in mm, angles in rad.
struct Pass {
    Eigen::Index test = 0;     ///< number of its test
    double readings = 0.0;     ///< number of them
    double play = 0.0;         ///< mean of what the claim does
    double value = 0.0;        ///< mean of the readings beside the other causes
    double within = 0.0;       ///< squares of what the claim does about that mean
    double information = 0.0;  ///< 1 / variance of the mean by the noise of the readings
};

bool begins_test(const Prepared& p, std::size_t row) {
    const auto test = [&](std::size_t i) -> const std::string& {
        return p.table.rows[p.replay.table_row(i)].test;
    };
    return row == 0 || p.replay.session(row) != p.replay.session(row - 1) ||
           test(row) != test(row - 1);
}

/// True where a row begins a pass: in a test of its own, after a turn, or at the start again.
bool begins_pass(const Prepared& p, std::size_t row, Axis axis) {
    if (begins_test(p, row)) return true;
    const AxisSample &own = p.replay.sample(row), &before = p.replay.sample(row - 1);
    const int travel = own.travel[index_of(axis)];
    double step = own.position[axis] - before.position[axis];
    if (is_rotary(axis)) step = std::remainder(step, 2.0 * pi);
    return travel != before.travel[index_of(axis)] || step * travel < 0.0;
}

/// The passes of an axis, from the whitened columns of the claim and of the readings.
std::vector<Pass> passes_of(const Prepared& p, Axis axis, const Eigen::MatrixXd& own_and_value) {
    std::vector<Pass> passes;
    Eigen::Index test = -1;
    for (std::size_t i = 0; i < p.replay.size(); ++i) {
        if (begins_test(p, i)) ++test;
        if (begins_pass(p, i, axis)) passes.push_back({test});
        Pass& pass = passes.back();
        const auto row = static_cast<Eigen::Index>(i);
        const double sigma = p.base.sigma_mm(row);
        const double own = sigma * own_and_value(row, 0);
        pass.readings += 1.0;
        pass.play += own;
        pass.within += own * own;
        pass.value += sigma * own_and_value(row, 1);
        pass.information += sigma * sigma;
    }
    for (Pass& pass : passes) {
        pass.play /= pass.readings;
        pass.value /= pass.readings;
        pass.within -= pass.readings * pass.play * pass.play;
        pass.information = pass.readings * pass.readings / pass.information;
    }
    return passes;
}

/// True where the claim does the same at all targets of a pass.
bool is_constant_within(const std::vector<Pass>& passes) {
    constexpr double most = 0.05;  // of the squares of what the claim does (assumed)
    double within = 0.0, whole = 0.0;
    for (const Pass& pass : passes) {
        within += pass.within;
        whole += pass.within + pass.readings * pass.play * pass.play;
    }
    return whole > 0.0 && within < most * whole;
}

/// Probability of an effect that chance alone would show with probability `p`, at even odds before:
/// the most that any prior of its size allows (Sellke, Bayarri and Berger, 2001). 0.71 at 0.05.
double most_against_chance(double p) {
    const double least_odds =
        p > 0.0 && p < std::exp(-1.0) ? -std::exp(1.0) * p * std::log(p) : 1.0;
    return p <= 0.0 ? 1.0 : std::min(1.0 - std::min(1.0, p), 1.0 / (1.0 + least_odds));
}

/// The size of the play relative to the claim, by means of passes or by their differences.
struct Slope {
    double t = 0.0, freedom = 0.0;
    Eigen::VectorXd left;  ///< mm or rad
    /// Probability that it is more than zeros make, whatever its sign, at even odds before; 0 where
    /// too few passes tell.
    double probability() const {
        if (freedom < 1.0) return 0.0;
        return most_against_chance(2.0 * (1.0 - estimation::student_probability(t, freedom)));
    }
};

/// The last column of `columns` is what the claim does.
Slope slope_of(const Eigen::MatrixXd& columns, const Eigen::VectorXd& value) {
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
    Slope slope;
    slope.freedom = static_cast<double>(value.size() - qr.rank());
    if (qr.rank() < columns.cols() || slope.freedom < 1.0) return {};
    const Eigen::VectorXd size = qr.solve(value);
    slope.left = value - columns * size;
    const Eigen::MatrixXd inverse = (columns.transpose() * columns).inverse();
    const Eigen::Index last = columns.cols() - 1;
    const double deviation =
        std::sqrt(slope.left.squaredNorm() / slope.freedom * inverse(last, last));
    slope.t = size(last) / std::max(1e-300, deviation);
    return slope;
}

/// By the means of all passes, each test with a zero of its own.
Slope by_means(const std::vector<Pass>& passes) {
    const auto count = static_cast<Eigen::Index>(passes.size());
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(count, passes.back().test + 2);
    Eigen::VectorXd value(count);
    for (Eigen::Index k = 0; k < count; ++k) {
        const Pass& pass = passes[static_cast<std::size_t>(k)];
        columns(k, pass.test) = 1.0;
        columns(k, columns.cols() - 1) = pass.play;
        value(k) = pass.value;
    }
    return slope_of(columns, value);
}

/// By the differences of there and back, which share their zero where it wanders slowly.
Slope by_differences(const std::vector<Pass>& passes) {
    std::vector<double> play, value;
    for (std::size_t k = 0; k + 1 < passes.size(); ++k) {
        const Pass &there = passes[k], &back = passes[k + 1];
        if (there.test != back.test || there.play * back.play >= 0.0) continue;
        play.push_back(there.play - back.play);
        value.push_back(there.value - back.value);
        ++k;
    }
    const auto count = static_cast<Eigen::Index>(play.size());
    if (count < 2) return {};
    return slope_of(Eigen::Map<const Eigen::VectorXd>(play.data(), count),
                    Eigen::Map<const Eigen::VectorXd>(value.data(), count));
}

/// Probability that the means of the passes differ as much by the noise of their readings alone.
double chance_of_means(const std::vector<Pass>& passes, const Slope& means, double variance) {
    double squares = 0.0;
    for (std::size_t k = 0; k < passes.size(); ++k) {
        const double left = means.left(static_cast<Eigen::Index>(k));
        squares += left * left * passes[k].information / variance;
    }
    return estimation::chi_squared_tail(squares, means.freedom);
}

/// What a claim is worth by its passes; 1 where they do not differ by more than noise.
double worth_by_passes(const Outcome& f, Axis axis, const Eigen::MatrixXd& own_and_value) {
    const std::vector<Pass> passes = passes_of(f.prepared, axis, own_and_value);
    if (!is_constant_within(passes)) return 1.0;
    const Slope means = by_means(passes);
    if (means.freedom < 1.0) return 1.0;
    const double variance = f.model.variances.nu * f.model.variances.nu;
    if (chance_of_means(passes, means, variance) >= rules::zeros_chance) return 1.0;
    return std::max(means.probability(), by_differences(passes).probability());
}

/// What a claim does, and the readings beside the causes but this one; zeros stay in.
Eigen::MatrixXd own_and_value(const Outcome& f, const Claim& claim) {
    const Eigen::MatrixXd parts = contributions(f.design, f.model, fit_of(f.design, f.model));
    Eigen::MatrixXd list = Eigen::MatrixXd::Zero(parts.rows(), 2);
    list.col(1) = f.design.projection().beside(f.design.data());
    for (std::size_t k = 0; k < f.model.members.size(); ++k) {
        const ColumnGroup& group = f.design.group(f.model.members[k]);
        const auto column = static_cast<Eigen::Index>(k);
        if (!is_cause(group.kind)) continue;
        list.col(group.name == claim.name ? 0 : 1) +=
            (group.name == claim.name ? 1.0 : -1.0) * parts.col(column);
    }
    return list;
}

}  // namespace

void doubt_plays_of_passes(const Outcome& f, std::vector<Claim>& claims) {
    const std::optional<Axis> axis = measured_axis(f.prepared.replay, f.prepared.table);
    if (!axis) return;
    for (Claim& claim : claims) {
        const ColumnGroup& group = f.design.group(f.model.members[claim.position]);
        if (!is_cause(group.kind) || group.is_change()) continue;
        claim.probability =
            std::min(claim.probability, worth_by_passes(f, *axis, own_and_value(f, claim)));
    }
}

}  // namespace trunnion::diagnosis
