#include "diagnosis/groups/key_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdint>
#include <optional>

#include "estimation/inner_products.h"
#include "identification/key_settings.h"

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t rough_count = 600, fine_count = 2400;  ///< maximum number of rows
constexpr std::size_t finalists = 12;
/// A ripple of typical size and its alias count as equal where they differ by less in chi-squared,
/// and by less than this part of the ripple: one that the readings hardly see at its typical size
/// may be larger than that.
constexpr double alias_square = 4.0, alias_part = 0.2;

/// A fixed selection of about `count` rows without the periodicity of poses and passes.
std::vector<std::size_t> scattered_rows(std::size_t all, std::size_t count) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < all; ++i) {
        const std::uint64_t mixed = (i + 1) * 0x9E3779B97F4A7C15ULL;
        if ((mixed >> 33) % all < count) rows.push_back(i);
    }
    return rows;
}

constexpr double least_square = 1e-9;  ///< columns below this move no reading

/// Directions of the fitted columns below the root of this are rounding: they take nothing away.
constexpr double rounding = 1e-12;

/// Information from the products of columns beside others, with the prior of an effect: its
/// parameters are normally distributed with variance 1 in typical sizes, so the matrix gets the
/// identity. That is a statement on machines, no ridge.
Eigen::LLT<Eigen::MatrixXd> information(Eigen::MatrixXd square) {
    square.diagonal().array() += 1.0;
    return square.llt();
}

}  // namespace

KeySearch::KeySearch(const emulator::Replay& replay, const identification::BaseModel& base)
    : replay_(replay),
      base_(base),
      rough_rows_(scattered_rows(replay.size(), rough_count)),
      fine_rows_(scattered_rows(replay.size(), fine_count)),
      rough_weight_(base.sigma_mm(rough_rows_).cwiseInverse()),
      fine_weight_(base.sigma_mm(fine_rows_).cwiseInverse()),
      base_columns_(rough_weight_.asDiagonal() * base.columns(rough_rows_, Eigen::all)) {}

Eigen::MatrixXd KeySearch::columns(const effects::Effect& effect, const std::vector<double>& keys,
                                   const std::vector<std::size_t>& rows,
                                   const Eigen::VectorXd& weight) const {
    const auto count = std::count_if(effect.parameters.begin(), effect.parameters.end(),
                                     [](const effects::EffectParameter& p) { return !p.is_key(); });
    Eigen::MatrixXd a(static_cast<Eigen::Index>(rows.size()), count);
    Eigen::Index at = 0;
    for (std::size_t j = 0; j < effect.parameters.size(); ++j)
        if (!effect.parameters[j].is_key())
            a.col(at++) =
                identification::effect_column(replay_, base_.gradient, {effect, keys, j}, rows)
                    .cwiseProduct(weight);
    return a;
}

/// The first two orders of a ripple. On equidistant positions a fine ripple may be the alias of one
/// of them, which is a positioning error and no ripple. Empty for effects without a period.
Eigen::MatrixXd KeySearch::first_orders(const effects::Effect& effect) const {
    Eigen::MatrixXd all(static_cast<Eigen::Index>(rough_rows_.size()), 0);
    for (std::size_t j = 0; j < effect.parameters.size(); ++j) {
        if (!effect.parameters[j].counts_periods) continue;
        for (const double order : {0.0, 1.0, 2.0}) {
            std::vector<double> values = effect.zeros();
            values[j] = order;
            const Eigen::MatrixXd a = columns(effect, values, rough_rows_, rough_weight_);
            all.conservativeResize(Eigen::NoChange, all.cols() + a.cols());
            all.rightCols(a.cols()) = a;
        }
    }
    return all;
}

std::vector<KeySearch::Setting> KeySearch::worked_out(const effects::Effect& effect) const {
    const Eigen::MatrixXd orders = first_orders(effect);
    const estimation::Projection first(orders);
    std::vector<Setting> list;
    for (std::vector<double>& values : identification::key_settings(effect, effect.zeros())) {
        const Eigen::MatrixXd rough = columns(effect, values, rough_rows_, rough_weight_);
        const double seen = rough.squaredNorm();
        const bool alias = orders.cols() > 0 && first.beside(rough).squaredNorm() <=
                                                    std::min(alias_square, alias_part * seen);
        if (alias || seen < least_square) continue;
        Eigen::MatrixXd own = base_columns_.beside(rough);
        auto factor = information(own.transpose() * own);
        list.push_back({std::move(values), std::move(own), std::move(factor), {}});
    }
    return list;
}

std::vector<KeySearch::Setting>& KeySearch::settings_of(const effects::Effect& effect) {
    const auto at = settings_.find(&effect);
    return at != settings_.end() ? at->second : settings_[&effect] = worked_out(effect);
}

KeySearch::Remainder KeySearch::remainder(const Eigen::VectorXd& left_mm,
                                          const Eigen::MatrixXd& fitted) const {
    Remainder r{left_mm(rough_rows_).cwiseProduct(rough_weight_),
                left_mm(fine_rows_).cwiseProduct(fine_weight_),
                fine_weight_.asDiagonal() * fitted(fine_rows_, Eigen::all),
                {},
                {}};
    for (auto column : r.fitted.colwise())
        if (const double length = column.norm(); length > 0.0) column /= length;
    const Eigen::Index count = r.fitted.cols();
    // Without columns Eigen would multiply by way of a null pointer.
    if (count == 0) return r;
    Eigen::MatrixXd square = estimation::inner_products(r.fitted);
    square.diagonal().array() += rounding;
    r.factor.compute(square);
    r.along = r.factor.matrixL().solve(r.fitted.transpose() * r.fine);
    return r;
}

/// Chi-squared that each setting explains beside the fitted columns, on the fine rows.
Eigen::VectorXd KeySearch::fine_gains(const std::vector<Setting*>& finalists,
                                      const Remainder& remainder) const {
    Eigen::Index count = 0;
    for (const Setting* s : finalists) count += s->fine.cols();
    Eigen::MatrixXd all(remainder.fine.size(), count);
    Eigen::Index at = 0;
    for (const Setting* s : finalists) {
        all.middleCols(at, s->fine.cols()) = s->fine;
        at += s->fine.cols();
    }
    Eigen::MatrixXd taken = estimation::inner_products(remainder.fitted, all);
    // Without columns Eigen would solve by way of a null pointer.
    if (taken.size() > 0) remainder.factor.matrixL().solveInPlace(taken);
    Eigen::VectorXd gain(static_cast<Eigen::Index>(finalists.size()));
    at = 0;
    for (std::size_t k = 0; k < finalists.size(); ++k) {
        const Eigen::MatrixXd& fine = finalists[k]->fine;
        const auto own = taken.middleCols(at, fine.cols());
        const Eigen::VectorXd product =
            fine.transpose() * remainder.fine - own.transpose() * remainder.along;
        const auto factor = information(fine.transpose() * fine - own.transpose() * own);
        gain(static_cast<Eigen::Index>(k)) =
            fine.squaredNorm() < least_square ? 0.0 : factor.matrixL().solve(product).squaredNorm();
        at += fine.cols();
    }
    return gain;
}

std::vector<std::vector<double>> KeySearch::best(const effects::Effect& effect,
                                                 const Remainder& remainder, int count) {
    struct Found {
        std::size_t order;
        double gain;
    };
    const auto better = [](const Found& a, const Found& b) { return a.gain > b.gain; };
    std::vector<Setting>& settings = settings_of(effect);
    std::vector<Found> found;
    for (std::size_t k = 0; k < settings.size(); ++k) {
        const Setting& s = settings[k];
        const Eigen::VectorXd product = s.rough.transpose() * remainder.rough;
        found.push_back({k, s.factor.matrixL().solve(product).squaredNorm()});
    }
    std::stable_sort(found.begin(), found.end(), better);
    if (found.size() > finalists) found.resize(finalists);
    std::vector<Setting*> finalists;
    for (const Found& f : found) {
        Setting& s = settings[f.order];
        if (s.fine.size() == 0) s.fine = columns(effect, s.values, fine_rows_, fine_weight_);
        finalists.push_back(&s);
    }
    const Eigen::VectorXd gain = fine_gains(finalists, remainder);
    for (std::size_t k = 0; k < found.size(); ++k)
        found[k].gain = gain(static_cast<Eigen::Index>(k));
    std::stable_sort(found.begin(), found.end(), better);
    std::vector<std::vector<double>> best;
    std::vector<std::size_t> taken;
    for (const Found& f : found) {
        if (static_cast<int>(best.size()) == count) break;
        const bool near = std::any_of(taken.begin(), taken.end(), [&](std::size_t o) {
            return f.order + 1 >= o && f.order <= o + 1;
        });
        if (near) continue;
        best.push_back(settings[f.order].values);
        taken.push_back(f.order);
    }
    return best;
}

}  // namespace trunnion::diagnosis
