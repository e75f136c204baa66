#include "ballbar/test/ballbar_fit.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "estimation/ranked_least_squares.h"
#include "kinematics/forward.h"

namespace trunnion::ballbar::test {

/// One set of parameter values, prepared for evaluation.
struct BallbarState {
    kinematics::ForwardModel machine;
    Vector3 cup_S_mm, pivot_W_mm;
    double length_mm;
    std::vector<double> test_constant_mm;
};

namespace {

using Kind = BallbarParameter::Kind;

constexpr std::size_t blocks_per_pass = 400;
constexpr double arm_mm = 100.0;         // a tilt is scaled by its effect at this lever arm
constexpr double step = 1e-3;            // of the central differences, in scaled units (mm)
constexpr double null_threshold = 1e-8;  // for eigenvalues of the column-scaled normal matrix

/// Two positions and two tilts perpendicular to the nominal direction of the axis.
void add_location(std::vector<BallbarParameter>& out, const kinematics::AxisGeometry& axis) {
    Eigen::Index along = 0;
    axis.direction.cwiseAbs().maxCoeff(&along);
    for (const char* letters : {"XYZ", "ABC"})
        for (int k = 0; k < 3; ++k) {
            if (k == along) continue;
            const kinematics::ErrorName error{letters[k], true, axis.axis};
            out.push_back({Kind::location, error, k, to_string(error)});
        }
}

void add_vector(std::vector<BallbarParameter>& out, Kind kind, const std::string& name) {
    for (int k = 0; k < 3; ++k) out.push_back({kind, {}, k, name + "." + "xyz"[k]});
}

/// Reduced row echelon form with full pivoting: the sparsest groups that span the null space.
std::vector<InseparableGroup> groups_of(Eigen::MatrixXd basis,
                                        const std::vector<BallbarParameter>& parameters,
                                        const Eigen::VectorXd& scale) {
    Eigen::MatrixXd rows = basis.transpose();
    std::vector<bool> done(static_cast<std::size_t>(rows.rows()), false);
    for (Eigen::Index n = 0; n < rows.rows(); ++n) {
        Eigen::Index r = 0, c = 0;
        double best = 0.0;
        for (Eigen::Index i = 0; i < rows.rows(); ++i)
            for (Eigen::Index j = 0; j < rows.cols() && !done[static_cast<std::size_t>(i)]; ++j)
                if (std::abs(rows(i, j)) > best * (1.0 + 1e-6))
                    best = std::abs(rows(i, j)), r = i, c = j;
        rows.row(r) /= rows(r, c);
        for (Eigen::Index i = 0; i < rows.rows(); ++i)
            if (i != r) rows.row(i) -= rows(i, c) * rows.row(r);
        done[static_cast<std::size_t>(r)] = true;
    }
    std::vector<InseparableGroup> groups;
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        InseparableGroup group;
        const double largest = rows.row(i).cwiseAbs().maxCoeff();
        for (Eigen::Index j = 0; j < rows.cols(); ++j) {
            if (std::abs(rows(i, j)) < 1e-4 * largest) continue;
            group.names.push_back(parameters[static_cast<std::size_t>(j)].name);
            group.direction.push_back(rows(i, j) / largest * scale(j));
        }
        groups.push_back(group);
    }
    return groups;
}

}  // namespace

int BallbarFit::find(const std::string& name) const {
    for (std::size_t k = 0; k < parameters.size(); ++k)
        if (parameters[k].name == name) return static_cast<int>(k);
    return -1;
}

bool BallbarFit::determined(int parameter) const {
    const std::string& name = parameters[static_cast<std::size_t>(parameter)].name;
    for (const InseparableGroup& group : inseparable)
        if (std::find(group.names.begin(), group.names.end(), name) != group.names.end())
            return false;
    return true;
}

BallbarModel::BallbarModel(const kinematics::Machine& nominal, const BallbarLayout& layout,
                           const std::vector<records::Reading>& rows,
                           const BallbarUnknowns& unknowns)
    : nominal_(nominal),
      layout_(layout),
      pivot_place_(unknowns.pivot),
      passes_(ballbar_passes(rows)) {
    const auto [first, second] = table_axes(nominal.chain);
    add_location(parameters_, first);
    add_location(parameters_, second);
    if (unknowns.cup) add_vector(parameters_, Kind::cup, "ballbar.cup");
    if (pivot_place_ == PivotPlace::unknown) add_vector(parameters_, Kind::pivot, "ballbar.pivot");
    if (unknowns.constant == BarConstant::length)
        parameters_.push_back({Kind::length, {}, 0, "ballbar.length"});
    std::vector<std::string> tests;
    for (const BallbarPass& pass : passes_) {
        const std::string name = to_string(pass.test);
        auto at = std::find(tests.begin(), tests.end(), name);
        const int number = static_cast<int>(at - tests.begin());
        if (at == tests.end()) {
            tests.push_back(name);
            if (unknowns.constant == BarConstant::per_test)
                parameters_.push_back({Kind::test_constant, {}, number, "constant." + name});
        }
        for (std::size_t i = pass.begin; i < pass.end; ++i) {
            row_.push_back(i);
            poses_.push_back(rows[i].commanded);
            test_of_.push_back(number);
        }
        const std::size_t count = pass.end - pass.begin, begin = poses_.size() - count;
        const std::size_t blocks = std::min(count, blocks_per_pass);
        for (std::size_t b = 0; b < blocks; ++b)
            blocks_.push_back({begin + count * b / blocks, begin + count * (b + 1) / blocks});
        pass_end_.push_back(poses_.size());
    }
    scale_.resize(static_cast<Eigen::Index>(parameters_.size()));
    for (Eigen::Index k = 0; k < scale_.size(); ++k)
        scale_(k) = parameters_[static_cast<std::size_t>(k)].angular() ? 1.0 / arm_mm : 1.0;
    start_ = linearise(Eigen::VectorXd::Zero(scale_.size()));
}

BallbarState BallbarModel::state(const Eigen::VectorXd& scaled) const {
    kinematics::Machine machine = nominal_;
    Vector3 cup = layout_.cup_S_mm, pivot = layout_.pivot_W_mm;
    double length = layout_.length_mm;
    std::vector<double> constant(parameters_.size(), 0.0);
    for (std::size_t k = 0; k < parameters_.size(); ++k) {
        const BallbarParameter& p = parameters_[k];
        const double value =
            scaled(static_cast<Eigen::Index>(k)) * scale_(static_cast<Eigen::Index>(k));
        switch (p.kind) {
            case Kind::location: machine.errors.location(p.error) += value; break;
            case Kind::cup: cup(p.component) += value; break;
            case Kind::pivot: pivot(p.component) += value; break;
            case Kind::length: length += value; break;
            case Kind::test_constant:
                constant[static_cast<std::size_t>(p.component)] = value;
                break;
        }
    }
    if (pivot_place_ == PivotPlace::at_spindle) pivot = machine.poses({}).pose_MW.inverse() * pivot;
    return {kinematics::ForwardModel(machine), cup, pivot, length, constant};
}

double BallbarModel::reading(const BallbarState& state, std::size_t i) const {
    const kinematics::MachinePose pose = state.machine.poses(poses_[i]);
    const Vector3 bar = pose.pose_MS * state.cup_S_mm - pose.pose_MW * state.pivot_W_mm;
    return bar.norm() - state.length_mm +
           state.test_constant_mm[static_cast<std::size_t>(test_of_[i])];
}

Eigen::MatrixXd BallbarModel::jacobian(const Eigen::VectorXd& scaled) const {
    const auto rows = static_cast<Eigen::Index>(blocks_.size());
    Eigen::MatrixXd out(rows, scaled.size());
    for (Eigen::Index k = 0; k < scaled.size(); ++k) {
        Eigen::VectorXd at = scaled;
        at(k) += step;
        const BallbarState up = state(at);
        at(k) -= 2.0 * step;
        const BallbarState down = state(at);
        for (Eigen::Index b = 0; b < rows; ++b) {
            const Block& block = blocks_[static_cast<std::size_t>(b)];
            const std::size_t middle = (block.begin + block.end - 1) / 2;
            out(b, k) = (reading(up, middle) - reading(down, middle)) / (2.0 * step);
        }
    }
    return out;
}

BallbarModel::Linear BallbarModel::linearise(const Eigen::VectorXd& scaled) const {
    Linear linear{jacobian(scaled), {}, {}};
    Eigen::VectorXd weight(static_cast<Eigen::Index>(blocks_.size()));
    for (Eigen::Index b = 0; b < weight.size(); ++b) {
        const Block& block = blocks_[static_cast<std::size_t>(b)];
        weight(b) = static_cast<double>(block.end - block.begin);
    }
    const Eigen::MatrixXd normal =
        linear.jacobian.transpose() * weight.asDiagonal() * linear.jacobian;
    // Symmetries are exact at zero errors only, so the dimension of the null space is determined
    // there.
    const estimation::Directions d =
        start_.null.rows() > 0 ? estimation::directions_beside(normal, start_.null.cols())
                               : estimation::directions_above(normal, 0.0, null_threshold);
    linear.null = d.unseen;
    linear.inverse = d.inverse();
    return linear;
}

std::vector<double> BallbarModel::predict(const Eigen::VectorXd& value) const {
    const BallbarState at = state(value.cwiseQuotient(scale_));
    std::vector<double> out(poses_.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = reading(at, i);
    return out;
}

BallbarFit BallbarModel::fit(const std::vector<double>& reading_mm) const {
    BallbarFit fit;
    fit.parameters = parameters_;
    Eigen::VectorXd scaled = Eigen::VectorXd::Zero(scale_.size());
    Linear linear = start_;
    std::vector<double> residual(poses_.size());
    const auto measure = [&] {
        const BallbarState at = state(scaled);
        for (std::size_t i = 0; i < residual.size(); ++i)
            residual[i] = reading_mm[i] - reading(at, i);
    };
    measure();
    for (fit.iterations = 1; fit.iterations <= 20; ++fit.iterations) {
        Eigen::VectorXd sum(static_cast<Eigen::Index>(blocks_.size()));
        for (Eigen::Index b = 0; b < sum.size(); ++b) {
            const Block& block = blocks_[static_cast<std::size_t>(b)];
            sum(b) = 0.0;
            for (std::size_t i = block.begin; i < block.end; ++i) sum(b) += residual[i];
        }
        const Eigen::VectorXd change = linear.inverse * (linear.jacobian.transpose() * sum);
        scaled += change;
        measure();
        if (change.norm() < 1e-12) break;
        // The Jacobian is nearly constant: one update near the solution is enough.
        if (fit.iterations == 1) linear = linearise(scaled);
    }
    fit.value = scaled.cwiseProduct(scale_);
    fit.cofactor = scale_.asDiagonal() * linear.inverse * scale_.asDiagonal();
    fit.rank = static_cast<int>(scale_.size() - start_.null.cols());
    fit.inseparable = groups_of(start_.null, parameters_, scale_);
    fit.residual_mm = residual;
    fit.dof = static_cast<int>(residual.size()) - fit.rank;
    double square = 0.0, neighbour = 0.0;
    std::size_t pairs = 0, begin = 0;
    for (const std::size_t end : pass_end_) {
        for (std::size_t i = begin; i < end; ++i) square += residual[i] * residual[i];
        for (std::size_t i = begin + 1; i < end; ++i, ++pairs)
            neighbour += std::pow(residual[i] - residual[i - 1], 2);
        begin = end;
    }
    if (fit.dof > 0) fit.rms_mm = std::sqrt(square / fit.dof);
    if (pairs > 0) fit.noise_mm = std::sqrt(0.5 * neighbour / static_cast<double>(pairs));
    return fit;
}

double reading_sigma_mm(const BallbarFit& fit, double declared_mm) {
    return std::max(fit.rms_mm, declared_mm);
}

ResidualVerdict judge_residuals(const BallbarModel& model, const BallbarFit& fit) {
    ResidualVerdict verdict;
    const double noise_square = fit.noise_mm * fit.noise_mm;
    const double excess = fit.rms_mm * fit.rms_mm - noise_square;
    verdict.excess_um = um_from_mm(std::sqrt(std::max(0.0, excess)));
    // Scatter of both variance estimates from n readings: about 2.5 / sqrt(n) of the variance. 0.01
    // um is below the resolution of any ballbar.
    const double scatter =
        noise_square * 2.5 / std::sqrt(static_cast<double>(std::max(1, fit.dof)));
    verdict.structured = excess > 4.0 * scatter && verdict.excess_um > 0.01;
    std::size_t i = 0;
    for (const BallbarPass& pass : model.passes()) {
        double square = 0.0;
        const std::size_t count = pass.end - pass.begin;
        for (std::size_t k = 0; k < count; ++k, ++i)
            square += fit.residual_mm[i] * fit.residual_mm[i];
        const double rms_um = um_from_mm(std::sqrt(square / static_cast<double>(count)));
        if (rms_um > verdict.worst_rms_um)
            verdict.worst_rms_um = rms_um, verdict.worst_test = pass.name;
    }
    return verdict;
}

}  // namespace trunnion::ballbar::test
