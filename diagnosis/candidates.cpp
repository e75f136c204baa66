#include "diagnosis/candidates.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>

namespace trunnion {
namespace {

/// A column that moves no reading by this many sigma when its parameter changes as usual is left
/// out.
constexpr double dead_column = 1e-6;
constexpr double visible_part = 0.02;

/// Prior precision of base parameters in units of their typical size: calibrated values sharp,
/// others wide (twenty times the usual size) so that unseen directions stay where they are.
double base_precision(const FitParameter& p) {
    const double sigma = p.prior_sigma > 0.0 ? p.prior_sigma : 20.0 * p.typical;
    return (p.typical / sigma) * (p.typical / sigma);
}

}  // namespace

bool has_keys(const Effect& effect) {
    return std::any_of(effect.parameters.begin(), effect.parameters.end(),
                       [](const EffectParameter& p) { return p.is_key(); });
}

Design::Design(const Replay& replay, const BaseModel& base, const Whitener& whitener)
    : replay_(replay),
      model_(base),
      whitener_(&whitener),
      base_(base.columns.cols()),
      base_rank_(base.rank),
      precision_(base_),
      known_(Eigen::VectorXd::Zero(base_)),
      raw_(base.columns) {
    for (std::size_t j = 0; j < base.parameters.size(); ++j) {
        const FitParameter& p = base.parameters[j];
        const auto k = static_cast<Eigen::Index>(j);
        precision_(k) = base_precision(p);
        if (p.prior_sigma <= 0.0) continue;
        known_(k) = (p.prior_value - p.value) / p.typical;
        calibrated_ += 1.0;
    }
}

std::vector<std::function<bool(const EffectParameter&)>> simpler_forms(const Effect& effect) {
    std::vector<std::function<bool(const EffectParameter&)>> forms;
    std::set<std::string> vectors;
    bool unusual = false;
    for (const EffectParameter& p : effect.parameters) {
        if (p.component >= 0 && !p.is_key()) vectors.insert(p.name);
        unusual = unusual || !p.usual;
    }
    if (unusual) forms.push_back([](const EffectParameter& p) { return p.usual; });
    // ISO 230-1: straightness is what departs from the mean line; the line is squareness.
    if (effect.name.ends_with(".straightness"))
        forms.push_back([](const EffectParameter& p) {
            return p.usual && p.name.find("_p1_") == std::string::npos;
        });
    if (vectors.size() > 1)
        for (const std::string& name : vectors)
            forms.push_back([name](const EffectParameter& p) { return p.name == name; });
    return forms;
}

std::size_t Design::add(const Effect& effect, std::vector<double> keys, double log_prior,
                        const std::function<bool(const EffectParameter&)>& takes) {
    Candidate candidate;
    candidate.effect = &effect;
    candidate.first = raw_.cols() - base_;
    candidate.log_prior = log_prior;
    for (std::size_t j = 0; j < effect.parameters.size(); ++j) {
        const EffectParameter& p = effect.parameters[j];
        if (p.is_key() || (takes && !takes(p))) continue;
        const Eigen::VectorXd column = effect_column(replay_, model_.gradient, effect, keys, j);
        if (column.cwiseQuotient(model_.sigma_mm).norm() < dead_column) continue;
        raw_.conservativeResize(Eigen::NoChange, raw_.cols() + 1);
        raw_.col(raw_.cols() - 1) = column;
        candidate.parameters.push_back(j);
    }
    candidate.values = std::move(keys);
    candidates_.push_back(std::move(candidate));
    return candidates_.size() - 1;
}

void Design::rewhiten(const Whitener& whitener) {
    whitener_ = &whitener;
    done_ = 0;
    update();
}

void Design::update() {
    const Eigen::Index all = raw_.cols(), fresh = all - done_;
    if (done_ == 0) data_ = whitener_->apply(model_.residual_mm);
    Eigen::MatrixXd part = raw_.rightCols(fresh);
    whitener_->apply(part);
    white_.conservativeResize(raw_.rows(), all);
    white_.rightCols(fresh) = part;
    full_.conservativeResize(all, all);
    cross_.conservativeResize(all);
    const auto old = white_.leftCols(done_);
    full_.bottomRightCorner(fresh, fresh).setZero();
    full_.bottomRightCorner(fresh, fresh)
        .selfadjointView<Eigen::Lower>()
        .rankUpdate(part.transpose());
    full_.bottomRightCorner(fresh, fresh).triangularView<Eigen::StrictlyUpper>() =
        full_.bottomRightCorner(fresh, fresh).transpose();
    full_.bottomLeftCorner(fresh, done_).noalias() = part.transpose() * old;
    full_.topRightCorner(done_, fresh) = full_.bottomLeftCorner(fresh, done_).transpose();
    cross_.tail(fresh).noalias() = part.transpose() * data_;
    if (done_ == 0) cross_.head(base_) += precision_.cwiseProduct(known_);
    done_ = all;

    Eigen::MatrixXd base = full_.topLeftCorner(base_, base_);
    base.diagonal() += precision_;
    const Eigen::LLT<Eigen::MatrixXd> llt(base);
    const Eigen::Index p = all - base_;
    const Eigen::MatrixXd half = llt.matrixL().solve(full_.topRightCorner(base_, p));
    const Eigen::VectorXd half_data = llt.matrixL().solve(cross_.head(base_));
    gram_ = full_.bottomRightCorner(p, p);
    gram_.noalias() -= half.transpose() * half;
    product_ = cross_.tail(p) - half.transpose() * half_data;
    for (Candidate& c : candidates_) {
        const double whole = full_.diagonal().segment(base_ + c.first, c.size()).sum();
        const double seen = gram_.diagonal().segment(c.first, c.size()).sum();
        c.visible = c.size() > 0 && seen > visible_part * visible_part * whole && seen > 1e-4;
    }
}

std::vector<Eigen::Index> Design::places(const std::vector<Eigen::Index>& columns) const {
    std::vector<Eigen::Index> place;
    for (Eigen::Index k = 0; k < base_; ++k) place.push_back(k);
    for (const Eigen::Index k : columns) place.push_back(base_ + k);
    return place;
}

void Design::normal_equations(const std::vector<Eigen::Index>& columns, double scale,
                              Eigen::MatrixXd& a, Eigen::VectorXd& b) const {
    const std::vector<Eigen::Index> place = places(columns);
    a = full_(place, place);
    b = cross_(place);
    a.diagonal().head(base_) += precision_;
    a.diagonal().tail(a.rows() - base_).array() += 1.0 / (scale * scale);
}

Eigen::VectorXd Design::solve(const std::vector<Eigen::Index>& columns, double scale) const {
    Eigen::MatrixXd a;
    Eigen::VectorXd b;
    normal_equations(columns, scale, a, b);
    return a.llt().solve(b);
}

Eigen::MatrixXd Design::covariance(const std::vector<Eigen::Index>& columns, double scale) const {
    Eigen::MatrixXd a;
    Eigen::VectorXd b;
    normal_equations(columns, scale, a, b);
    return a.llt().solve(Eigen::MatrixXd::Identity(a.rows(), a.cols()));
}

Eigen::VectorXd Design::fit_variance(const std::vector<Eigen::Index>& columns, double scale) const {
    Eigen::MatrixXd a;
    Eigen::VectorXd b;
    normal_equations(columns, scale, a, b);
    const Eigen::MatrixXd half =
        a.llt().matrixL().solve(raw_(Eigen::all, places(columns)).transpose());
    return half.colwise().squaredNorm().transpose();
}

Eigen::VectorXd Design::residual(const std::vector<Eigen::Index>& columns, double scale) const {
    const Eigen::VectorXd x = solve(columns, scale);
    Eigen::VectorXd left = model_.residual_mm - raw_.leftCols(base_) * x.head(base_);
    for (std::size_t k = 0; k < columns.size(); ++k)
        left -= raw_.col(base_ + columns[k]) * x(base_ + static_cast<Eigen::Index>(k));
    return left;
}

double Design::calibration_square(const std::vector<Eigen::Index>& columns, double scale) const {
    const Eigen::VectorXd off = solve(columns, scale).head(base_) - known_;
    double sum = 0.0;
    for (Eigen::Index k = 0; k < base_; ++k)
        if (model_.parameters[static_cast<std::size_t>(k)].prior_sigma > 0.0)
            sum += precision_(k) * off(k) * off(k);
    return sum;
}

Eigen::VectorXd Design::residual_without(const std::vector<Eigen::Index>& test,
                                         const std::vector<Eigen::Index>& columns, double scale,
                                         Eigen::VectorXd* fit_variance) const {
    Eigen::MatrixXd a;
    Eigen::VectorXd b;
    normal_equations(columns, scale, a, b);
    const std::vector<Eigen::Index> place = places(columns);
    const Eigen::MatrixXd out = white_(test, place);
    a.noalias() -= out.transpose() * out;
    b.noalias() -= out.transpose() * data_(test);
    const Eigen::MatrixXd raw = raw_(test, place);
    if (!fit_variance) return model_.residual_mm(test) - raw * a.ldlt().solve(b);
    const Eigen::LLT<Eigen::MatrixXd> llt(a);
    const Eigen::MatrixXd half = llt.matrixL().solve(raw.transpose());
    *fit_variance = half.colwise().squaredNorm().transpose();
    return model_.residual_mm(test) - raw * llt.solve(b);
}

Eigen::MatrixXd Design::open_base() const {
    Eigen::MatrixXd information = full_.topLeftCorner(base_, base_);
    information.diagonal() += precision_;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(information);
    const auto open = (solver.eigenvalues().array() < 1.0).count();  // they rise
    return solver.eigenvectors().leftCols(open);
}

Posterior Design::posterior(const std::vector<Eigen::Index>& columns, double scale) const {
    Eigen::MatrixXd a;
    Eigen::VectorXd b;
    normal_equations(columns, scale, a, b);
    const Eigen::LLT<Eigen::MatrixXd> llt(a);
    return {llt.solve(b), llt.matrixL()};
}

}  // namespace trunnion
