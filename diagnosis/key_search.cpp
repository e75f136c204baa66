#include "diagnosis/key_search.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cstdint>

namespace trunnion::diagnosis {
namespace {

constexpr std::size_t rough_count = 1000, fine_count = 3200;  ///< rows at most
constexpr std::size_t finalists = 16;
/// Chi-squared by which a ripple of typical size differs from its alias; less is no difference.
constexpr double alias_square = 4.0;

/// A fixed scatter of about `count` rows, without the rhythm of poses and passes.
std::vector<std::size_t> scattered_rows(std::size_t all, std::size_t count) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < all; ++i) {
        const std::uint64_t mixed = (i + 1) * 0x9E3779B97F4A7C15ULL;
        if ((mixed >> 33) % all < count) rows.push_back(i);
    }
    return rows;
}

/// Fall of the weighted squared sum of `left` (already over its sigma) by columns fitted beside
/// others; negative when the columns move nothing. `half`: Beside::half of the columns.
double gain(const Eigen::MatrixXd& weighted, const Eigen::MatrixXd& half,
            const Eigen::VectorXd& left, const Eigen::VectorXd& half_left) {
    Eigen::MatrixXd information = weighted.transpose() * weighted;
    if (information.trace() < 1e-9) return -1.0;
    information -= half.transpose() * half;
    information.diagonal().array() += 1.0;
    const Eigen::VectorXd h = weighted.transpose() * left - half.transpose() * half_left;
    return h.dot(information.ldlt().solve(h));
}

struct Weighted {
    Eigen::VectorXd weight, left;
    Weighted(const Eigen::VectorXd& left_mm, const Eigen::VectorXd& sigma_mm,
             const std::vector<std::size_t>& rows) {
        weight = sigma_mm(rows).cwiseInverse();
        left = left_mm(rows).cwiseProduct(weight);
    }
};

}  // namespace

Beside::Beside(Eigen::MatrixXd weighted) : columns_(std::move(weighted)) {
    Eigen::MatrixXd square = columns_.transpose() * columns_;
    square.diagonal().array() += 1e-9 * square.trace() + 1e-300;
    factor_.compute(square);
}

Eigen::MatrixXd Beside::half(const Eigen::MatrixXd& weighted) const {
    return factor_.matrixL().solve(columns_.transpose() * weighted);
}

KeySearch::KeySearch(const emulator::Replay& replay, const identification::BaseModel& base)
    : replay_(replay),
      base_(base),
      rough_rows_(scattered_rows(replay.size(), rough_count)),
      fine_rows_(scattered_rows(replay.size(), fine_count)),
      weight_(base.sigma_mm(rough_rows_).cwiseInverse()),
      beside_(weight_.asDiagonal() * base.columns(rough_rows_, Eigen::all)) {}

Eigen::MatrixXd KeySearch::columns(const effects::Effect& effect, const std::vector<double>& keys,
                                   const std::vector<std::size_t>& rows) const {
    std::vector<Eigen::VectorXd> list;
    for (std::size_t j = 0; j < effect.parameters.size(); ++j)
        if (!effect.parameters[j].is_key())
            list.push_back(
                identification::effect_column(replay_, base_.gradient, effect, keys, j, rows));
    Eigen::MatrixXd a(static_cast<Eigen::Index>(rows.size()),
                      static_cast<Eigen::Index>(list.size()));
    for (std::size_t c = 0; c < list.size(); ++c) a.col(static_cast<Eigen::Index>(c)) = list[c];
    return a;
}

/// The first two orders of a ripple: on positions in whole steps a fine ripple may be the alias of
/// one of them, which is positioning and no ripple. Empty for effects that count no periods.
Eigen::MatrixXd KeySearch::first_orders(const effects::Effect& effect) const {
    Eigen::MatrixXd all(static_cast<Eigen::Index>(rough_rows_.size()), 0);
    for (std::size_t j = 0; j < effect.parameters.size(); ++j) {
        if (effect.parameters[j].name != periods_key) continue;
        for (const double order : {0.0, 1.0, 2.0}) {
            std::vector<double> values = effect.zeros();
            values[j] = order;
            const Eigen::MatrixXd a = columns(effect, values, rough_rows_);
            all.conservativeResize(Eigen::NoChange, all.cols() + a.cols());
            all.rightCols(a.cols()) = a;
        }
    }
    return all;
}

/// Every point of the grid of the effect's keys, the first key fastest.
std::vector<KeySearch::Setting>& KeySearch::settings_of(const effects::Effect& effect) {
    std::vector<Setting>& list = settings_[&effect];
    if (!list.empty()) return list;
    std::vector<std::size_t> key;
    for (std::size_t j = 0; j < effect.parameters.size(); ++j)
        if (effect.parameters[j].is_key()) key.push_back(j);
    const Eigen::MatrixXd orders = first_orders(effect);
    const Beside first(weight_.asDiagonal() * orders);
    std::vector<std::size_t> at(key.size(), 0);
    for (std::size_t k = 0; k < key.size();) {
        std::vector<double> values = effect.zeros();
        for (std::size_t i = 0; i < key.size(); ++i)
            values[key[i]] = effect.parameters[key[i]].grid[at[i]];
        Eigen::MatrixXd rough = columns(effect, values, rough_rows_);
        const Eigen::MatrixXd weighted = weight_.asDiagonal() * rough;
        const bool alias =
            orders.cols() > 0 &&
            weighted.squaredNorm() - first.half(weighted).squaredNorm() <= alias_square;
        if (!alias)
            list.push_back({std::move(values), std::move(rough), beside_.half(weighted), {}});
        for (k = 0; k < key.size() && ++at[k] == effect.parameters[key[k]].grid.size(); ++k)
            at[k] = 0;
    }
    return list;
}

std::vector<std::vector<double>> KeySearch::best(const effects::Effect& effect,
                                                 const Eigen::VectorXd& left_mm,
                                                 const Eigen::VectorXd& sigma_mm,
                                                 const Eigen::MatrixXd& fitted, int count) {
    struct Found {
        std::size_t order;
        double gain;
    };
    const auto better = [](const Found& a, const Found& b) { return a.gain > b.gain; };
    std::vector<Setting>& settings = settings_of(effect);
    const Weighted rough(left_mm, sigma_mm, rough_rows_), fine(left_mm, sigma_mm, fine_rows_);
    const Eigen::VectorXd rough_half = beside_.half(rough.left);
    std::vector<Found> found;
    for (std::size_t k = 0; k < settings.size(); ++k) {
        const Setting& s = settings[k];
        const double g = gain(rough.weight.asDiagonal() * s.rough, s.half, rough.left, rough_half);
        if (g >= 0.0) found.push_back({k, g});
    }
    std::stable_sort(found.begin(), found.end(), better);
    if (found.size() > finalists) found.resize(finalists);
    const Beside others(fine.weight.asDiagonal() * fitted(fine_rows_, Eigen::all));
    const Eigen::VectorXd fine_half = others.half(fine.left);
    for (Found& f : found) {
        Setting& s = settings[f.order];
        if (s.fine.size() == 0) s.fine = columns(effect, s.values, fine_rows_);
        const Eigen::MatrixXd weighted = fine.weight.asDiagonal() * s.fine;
        f.gain = gain(weighted, others.half(weighted), fine.left, fine_half);
    }
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
