#include "diagnosis/search/heldout.h"

#include <algorithm>
#include <cmath>

#include "diagnosis/rules/rules.h"
#include "estimation/inner_products.h"
#include "estimation/lower_triangle.h"
#include "estimation/quantiles.h"

namespace trunnion::diagnosis {
double BlockLoss::mean() const {
    double sum = 0.0, count = 0.0;
    for (std::size_t b = 0; b < square.size(); ++b) {
        sum += square[b];
        count += rows[b];
    }
    return count > 0.0 ? sum / count : 0.0;
}

namespace {

/// What each block saves, without those that hardly differ.
std::vector<double> saved_by_block(const BlockLoss& without, const BlockLoss& with) {
    std::vector<double> saved;
    double scale = 0.0;
    for (std::size_t b = 0; b < without.square.size(); ++b)
        scale = std::max(scale, std::abs(without.square[b] - with.square[b]));
    for (std::size_t b = 0; b < without.square.size(); ++b)
        if (const double d = without.square[b] - with.square[b]; std::abs(d) > 1e-6 * scale)
            saved.push_back(d);
    return saved;
}

Saving sum_of(const std::vector<double>& saved) {
    double sum = 0.0, square = 0.0;
    for (const double d : saved) sum += d;
    Saving result{0.0, static_cast<double>(saved.size()), sum, std::abs(sum)};
    if (saved.size() < 2) return result;
    const double mean = sum / result.blocks;
    for (const double d : saved) square += (d - mean) * (d - mean);
    const double error = std::sqrt(square / (result.blocks - 1.0) / result.blocks);
    // Blocks of readings that repeat to the last digit all save the same.
    constexpr double finest = 1e-6;  // of the mean: arithmetic
    if (mean != 0.0) result.t = mean / std::max(error, finest * std::abs(mean));
    result.spread = error * result.blocks;
    return result;
}

}  // namespace

Saving saving_of(const BlockLoss& without, const BlockLoss& with) {
    return sum_of(saved_by_block(without, with));
}

Saving steady_saving_of(const BlockLoss& without, const BlockLoss& with) {
    constexpr double most = 4.0;  // of the median size
    std::vector<double> saved = saved_by_block(without, with), sizes;
    if (saved.size() < 3) return sum_of(saved);
    const double sign = sum_of(saved).sum < 0.0 ? -1.0 : 1.0;
    for (const double d : saved) sizes.push_back(std::abs(d));
    const double limit = most * estimation::median(sizes);
    for (double& d : saved) d = sign * std::min(sign * d, limit);
    return sum_of(saved);
}

namespace {

constexpr std::size_t set_up = SIZE_MAX;  ///< in place of a group

std::vector<std::size_t> with_set_up(std::vector<std::size_t> members) {
    members.insert(members.begin(), set_up);
    return members;
}

}  // namespace

FoldColumns::FoldColumns(Design& design, const LeftOutRows& rows)
    : design_(design), left_out_(rows) {
    const Folds& folds = rows.folds;
    for (const int f : folds.fold)
        rows_.resize(std::max(rows_.size(), static_cast<std::size_t>(f) + 1));
    for (std::size_t i = 0; i < folds.group.size(); ++i)
        if (folds.group[i] >= 0)
            rows_[static_cast<std::size_t>(folds.fold[static_cast<std::size_t>(folds.group[i])])]
                .push_back(static_cast<Eigen::Index>(i));
}

const FoldColumns::ByFold& FoldColumns::of(std::size_t group) {
    ByFold& own = columns_[group];
    if (!own.empty()) return own;
    const Eigen::MatrixXd& all = group == set_up ? design_.known() : design_.columns(group);
    for (const auto& rows : rows_) own.push_back(all(rows, Eigen::all));
    return own;
}

/// The first not after the second; the set-up last.
const FoldColumns::ByFold& FoldColumns::products(std::size_t first, std::size_t second) {
    ByFold& own = products_[{first, second}];
    if (!own.empty()) return own;
    const ByFold &a = of(first), &b = of(second);
    for (std::size_t f = 0; f < rows_.size(); ++f)
        own.push_back(first == second ? estimation::inner_products(a[f])
                                      : estimation::inner_products(a[f], b[f]));
    return own;
}

Eigen::MatrixXd FoldColumns::columns(std::size_t fold, const std::vector<std::size_t>& members) {
    Eigen::Index count = 0;
    const std::vector<std::size_t> groups = with_set_up(members);
    for (const std::size_t g : groups) count += of(g)[fold].cols();
    Eigen::MatrixXd all(static_cast<Eigen::Index>(rows_[fold].size()), count);
    Eigen::Index at = 0;
    for (const std::size_t g : groups) {
        const Eigen::MatrixXd& own = of(g)[fold];
        all.middleCols(at, own.cols()) = own;
        at += own.cols();
    }
    return all;
}

Eigen::MatrixXd FoldColumns::gram(std::size_t fold, const std::vector<std::size_t>& members) {
    Eigen::Index count = 0, row = 0;
    const std::vector<std::size_t> groups = with_set_up(members);
    for (const std::size_t g : groups) count += of(g)[fold].cols();
    Eigen::MatrixXd gram(count, count);
    for (std::size_t a = 0; a < groups.size(); ++a) {
        const Eigen::Index height = of(groups[a])[fold].cols();
        Eigen::Index column = row;
        for (std::size_t b = a; b < groups.size(); ++b) {
            const bool ordered = groups[a] <= groups[b];
            const Eigen::MatrixXd& own = ordered ? products(groups[a], groups[b])[fold]
                                                 : products(groups[b], groups[a])[fold];
            const Eigen::Index width = of(groups[b])[fold].cols();
            auto part = gram.block(row, column, height, width);
            if (ordered)
                part = own;
            else
                part = own.transpose();
            if (b != a) gram.block(column, row, width, height) = part.transpose();
            column += width;
        }
        row += height;
    }
    return gram;
}

LeftOut::LeftOut(Design& design, const Model& model, const Folds& folds,
                 const std::vector<bool>& used) {
    FoldColumns columns(design, {folds, used});
    *this = LeftOut(columns, model);
}

LeftOut::LeftOut(FoldColumns& columns, const Model& model)
    : folds_(columns.left_out().folds),
      used_(columns.left_out().used),
      known_(columns.design().known().cols()),
      fold_(columns.rows().size()) {
    Design& design = columns.design();
    Eigen::Index count = known_;
    for (const std::size_t m : model.members) {
        first_.push_back(count);
        size_.push_back(design.group(m).columns());
        count += size_.back();
    }
    precision_.setConstant(count, 1.0 / (rules::set_up_range * rules::set_up_range));
    retune(std::vector<bool>(model.members.size(), true), model.variances);
    const Design::Normal whole = design.normal(model.members);
    for (std::size_t f = 0; f < fold_.size(); ++f) {
        Fold& fold = fold_[f];
        fold.rows = columns.rows()[f];
        fold.out = columns.columns(f, model.members);
        fold.data = design.data()(fold.rows);
        fold.gram = whole.gram;
        fold.product = whole.product;
        if (fold.rows.empty() || count == 0) continue;  // fewer blocks than folds; nothing to fit
        fold.gram -= columns.gram(f, model.members);
        fold.product -= fold.out.transpose() * fold.data;
    }
}

void LeftOut::retune(const std::vector<bool>& fitted, const estimation::Variances& variances) {
    const double noise = variances.nu * variances.nu;
    std::size_t next = 0;
    for (std::size_t m = 0; m < fitted.size(); ++m) {
        if (!fitted[m]) continue;
        const double tau = std::max(1e-9, variances.tau[next++]);
        precision_.segment(first_[m], size_[m]).setConstant(noise / (tau * tau));
    }
    for (Fold& fold : fold_) fold.mean.resize(0);
}

/// Column indices of the marked members, preceded by those of the set-up if `known`.
std::vector<Eigen::Index> LeftOut::columns_of(const std::vector<bool>& members, bool known) const {
    std::vector<Eigen::Index> columns;
    for (Eigen::Index k = 0; known && k < known_; ++k) columns.push_back(k);
    for (std::size_t m = 0; m < members.size(); ++m)
        for (Eigen::Index k = 0; members[m] && k < size_[m]; ++k) columns.push_back(first_[m] + k);
    return columns;
}

/// Coefficients without the rows of the fold; zero for members that are not fitted. If only a few
/// members are missing: the full fit under the condition that their coefficients are zero.
namespace {

/// L^-1, where L L' is the information: its square is the covariance.
Eigen::MatrixXd half_of_inverse(const Eigen::MatrixXd& gram, const Eigen::VectorXd& precision) {
    const Eigen::Index size = gram.rows(), rows = estimation::padded_rows(size);
    Eigen::MatrixXd a = Eigen::MatrixXd::Identity(rows, rows);
    a.topLeftCorner(size, size) = gram;
    a.diagonal().head(size) += precision;
    estimation::factor_in_place(a);
    return estimation::inverse_of_lower(a).topLeftCorner(size, size);
}

}  // namespace

Eigen::VectorXd LeftOut::fit(const Fold& fold, const std::vector<bool>& fitted) const {
    std::vector<bool> absent = fitted;
    absent.flip();
    const std::vector<Eigen::Index> own = columns_of(fitted, true),
                                    gone = columns_of(absent, false);
    if (gone.size() > own.size()) {
        Eigen::MatrixXd a = fold.gram(own, own);
        a.diagonal() += precision_(own);
        const Eigen::VectorXd right = fold.product(own), part = a.llt().solve(right);
        Eigen::VectorXd x = Eigen::VectorXd::Zero(precision_.size());
        x(own) = part;
        return x;
    }
    if (fold.mean.size() == 0) {
        fold.half = half_of_inverse(fold.gram, precision_);
        fold.mean = fold.half.transpose() * (fold.half * fold.product);
    }
    if (gone.empty()) return fold.mean;
    const Eigen::MatrixXd half_gone = fold.half(Eigen::all, gone);
    const Eigen::VectorXd held = fold.mean(gone),
                          force = estimation::inner_products(half_gone).llt().solve(held);
    Eigen::VectorXd x = fold.mean - fold.half.transpose() * (half_gone * force);
    x(gone).setZero();
    return x;
}

Eigen::VectorXd LeftOut::residual(const std::vector<bool>& fitted,
                                  const std::vector<bool>& predicting) const {
    std::vector<bool> silent = predicting;
    silent.flip();
    const std::vector<Eigen::Index> quiet = columns_of(silent, false);
    Eigen::VectorXd left = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(folds_.group.size()));
    for (const Fold& fold : fold_) {
        if (fold.rows.empty()) continue;
        Eigen::VectorXd x = fit(fold, fitted);
        x(quiet).setZero();
        left(fold.rows) = fold.data - fold.out * x;
    }
    return left;
}

double LeftOut::surprise() const {
    const std::vector<bool> all(first_.size(), true);
    double sum = 0.0;
    for (const Fold& fold : fold_) {
        if (fold.rows.empty()) continue;
        const Eigen::VectorXd left = fold.data - fold.out * fit(fold, all);
        sum += left.squaredNorm();
        if (fold.out.cols() == 0) continue;
        // (I + X P^-1 X')^-1 = I - X (P + X'X)^-1 X', P the information of the other rows.
        Eigen::MatrixXd whole = fold.gram;
        whole.diagonal() += precision_;
        whole += estimation::inner_products(fold.out);
        const Eigen::VectorXd product = fold.out.transpose() * left;
        sum -= whole.selfadjointView<Eigen::Lower>().llt().matrixL().solve(product).squaredNorm();
    }
    return sum;
}

BlockLoss LeftOut::loss_of(const Eigen::VectorXd& left) const {
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

BlockLoss LeftOut::loss(const std::vector<bool>& fitted,
                        const std::vector<bool>& predicting) const {
    return loss_of(residual(fitted, predicting));
}

/// What the rows outside of a fold tell of the set-up, beside the fitted members.
Eigen::MatrixXd LeftOut::information_on_set_up(const Fold& fold,
                                               const std::vector<bool>& fitted) const {
    Eigen::MatrixXd told = fold.gram.topLeftCorner(known_, known_);
    told.diagonal() += precision_.head(known_);
    const std::vector<Eigen::Index> members = columns_of(fitted, false);
    if (members.empty()) return told;
    Eigen::MatrixXd own = fold.gram(members, members);
    own.diagonal() += precision_(members);
    Eigen::MatrixXd taken = fold.gram(members, Eigen::all).leftCols(known_);
    own.llt().matrixL().solveInPlace(taken);
    return told - taken.transpose() * taken;
}

BlockLoss LeftOut::loss_beside_set_up(const std::vector<bool>& fitted,
                                      const std::vector<bool>& predicting) const {
    Eigen::VectorXd left = residual(fitted, predicting);
    for (const Fold& fold : fold_) {
        if (fold.rows.empty() || known_ == 0) continue;
        const auto set_up = fold.out.leftCols(known_);
        const Eigen::VectorXd own = left(fold.rows);
        const Eigen::MatrixXd told =
            information_on_set_up(fold, fitted) + set_up.transpose() * set_up;
        left(fold.rows) = own - set_up * told.llt().solve(set_up.transpose() * own);
    }
    return loss_of(left);
}

}  // namespace trunnion::diagnosis
