#include "diagnosis/heldout.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "estimation/free_form.h"

namespace trunnion::diagnosis {
namespace {

/// Set-up quantities lie within so many typical sizes: directions that a fold does not see stay.
constexpr double set_up_range = 20.0;
constexpr std::size_t sectors = 24;  ///< of a whole turn

}  // namespace

double BlockLoss::mean() const {
    double sum = 0.0, count = 0.0;
    for (std::size_t b = 0; b < square.size(); ++b) {
        sum += square[b];
        count += rows[b];
    }
    return count > 0.0 ? sum / count : 0.0;
}

Saving saving_of(const BlockLoss& without, const BlockLoss& with) {
    std::vector<double> saved;
    double scale = 0.0, sum = 0.0, square = 0.0;
    for (std::size_t b = 0; b < without.square.size(); ++b)
        scale = std::max(scale, std::abs(without.square[b] - with.square[b]));
    for (std::size_t b = 0; b < without.square.size(); ++b)
        if (const double d = without.square[b] - with.square[b]; std::abs(d) > 1e-6 * scale)
            saved.push_back(d);
    Saving result{0.0, static_cast<double>(saved.size())};
    if (saved.size() < 2) return result;
    for (const double d : saved) sum += d;
    const double mean = sum / result.blocks;
    for (const double d : saved) square += (d - mean) * (d - mean);
    const double error = std::sqrt(square / (result.blocks - 1.0) / result.blocks);
    result.t = error > 0.0 ? mean / error : 0.0;
    return result;
}

LeftOut::LeftOut(const Design& design, const Model& model, const Folds& folds,
                 const std::vector<bool>& used)
    : folds_(folds), used_(used), data_(design.data()), known_(design.known().cols()) {
    Eigen::Index count = known_;
    for (const std::size_t m : model.members) {
        first_.push_back(count);
        size_.push_back(design.group(m).columns());
        count += size_.back();
    }
    all_.resize(data_.size(), count);
    all_.leftCols(known_) = design.known();
    precision_.resize(count);
    precision_.head(known_).setConstant(1.0 / (set_up_range * set_up_range));
    const double noise = model.variances.nu * model.variances.nu;
    for (std::size_t k = 0; k < model.members.size(); ++k) {
        all_.middleCols(first_[k], size_[k]) = design.columns(model.members[k]);
        const double tau = std::max(1e-9, model.variances.tau[k]);
        precision_.segment(first_[k], size_[k]).setConstant(noise / (tau * tau));
    }
    const Eigen::MatrixXd whole = all_.transpose() * all_;
    const Eigen::VectorXd product = all_.transpose() * data_;
    test_.resize(Folds::count);
    for (std::size_t i = 0; i < folds_.group.size(); ++i)
        if (folds_.group[i] >= 0)
            test_[static_cast<std::size_t>(folds_.fold[static_cast<std::size_t>(folds_.group[i])])]
                .push_back(static_cast<Eigen::Index>(i));
    for (const auto& rows : test_) {
        const Eigen::MatrixXd out = all_(rows, Eigen::all);
        gram_.push_back(whole - out.transpose() * out);
        product_.push_back(product - out.transpose() * data_(rows));
    }
}

std::vector<Eigen::Index> LeftOut::columns_of(const std::vector<bool>& members) const {
    std::vector<Eigen::Index> columns;
    for (Eigen::Index k = 0; k < known_; ++k) columns.push_back(k);
    for (std::size_t m = 0; m < members.size(); ++m)
        for (Eigen::Index k = 0; members[m] && k < size_[m]; ++k) columns.push_back(first_[m] + k);
    return columns;
}

Eigen::VectorXd LeftOut::residual(const std::vector<bool>& fitted,
                                  const std::vector<bool>& predicting) const {
    const std::vector<Eigen::Index> columns = columns_of(fitted);
    std::vector<bool> both = fitted;
    for (std::size_t k = 0; k < both.size(); ++k) both[k] = fitted[k] && predicting[k];
    const std::vector<Eigen::Index> used = columns_of(both);
    Eigen::VectorXd left = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(folds_.group.size()));
    for (std::size_t f = 0; f < test_.size(); ++f) {
        if (test_[f].empty()) continue;
        Eigen::MatrixXd a = gram_[f](columns, columns);
        a.diagonal() += precision_(columns);
        Eigen::VectorXd x = Eigen::VectorXd::Zero(all_.cols());
        const Eigen::VectorXd right = product_[f](columns), own = a.ldlt().solve(right);
        x(columns) = own;
        const Eigen::VectorXd off = data_(test_[f]) - all_(test_[f], used) * x(used);
        left(test_[f]) = off;
    }
    return left;
}

BlockLoss LeftOut::loss(const std::vector<bool>& fitted,
                        const std::vector<bool>& predicting) const {
    const Eigen::VectorXd left = residual(fitted, predicting);
    BlockLoss loss{std::vector<double>(folds_.fold.size()),
                   std::vector<double>(folds_.fold.size())};
    for (std::size_t i = 0; i < folds_.group.size(); ++i) {
        if (folds_.group[i] < 0 || !used_[i]) continue;
        const auto g = static_cast<std::size_t>(folds_.group[i]);
        loss.square[g] += std::pow(left(static_cast<Eigen::Index>(i)), 2);
        loss.rows[g] += 1.0;
    }
    return loss;
}

Folds place_folds(const emulator::Replay& replay, const TableForm& table) {
    std::vector<double> places = table.knots;
    if (places.empty())
        for (std::size_t k = 0; k <= sectors; ++k)
            places.push_back(-pi + 2.0 * pi * static_cast<double>(k) / sectors);
    Folds folds;
    for (std::size_t k = 0; k < places.size(); ++k)
        folds.fold.push_back(static_cast<int>(k % Folds::count));
    for (std::size_t i = 0; i < replay.size(); ++i) {
        const double at = replay.sample(i).position[table.axis.axis];
        const double q = table.knots.empty() ? std::remainder(at, 2.0 * pi) : at;
        const auto [before, weight] = estimation::place_between(places, q);
        const auto place = static_cast<int>(before) + (weight > 0.5 ? 1 : 0);
        const bool end =
            !table.knots.empty() && (place == 0 || place + 1 == static_cast<int>(places.size()));
        folds.group.push_back(end ? -1 : place);
    }
    return folds;
}

}  // namespace trunnion::diagnosis
