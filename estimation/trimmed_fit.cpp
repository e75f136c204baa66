#include "estimation/trimmed_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "estimation/ranked_least_squares.h"

namespace trunnion::estimation {
namespace {

constexpr int most_starts = 300;
constexpr Eigen::Index few_rows = 400;  ///< of more rows a few cannot spoil the start
constexpr int first_steps = 2, most_steps = 30;

/// A fit to some rows, and the sum of the smallest squares of all rows.
struct Trimmed {
    Eigen::VectorXd left;
    std::vector<Eigen::Index> kept;
    double square = 0.0;
};

class TrimmedFit {
  public:
    TrimmedFit(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data, double spoiled)
        : columns_(columns),
          data_(data),
          count_(data.size() -
                 static_cast<Eigen::Index>(spoiled * static_cast<double>(data.size()))) {}

    /// The rows of smallest squares, in ascending order.
    Trimmed around(Eigen::VectorXd left) const {
        Trimmed t{std::move(left),
                  std::vector<Eigen::Index>(static_cast<std::size_t>(data_.size())), 0.0};
        std::iota(t.kept.begin(), t.kept.end(), Eigen::Index{0});
        const auto closer = [&](Eigen::Index a, Eigen::Index b) {
            return std::pair(std::abs(t.left(a)), a) < std::pair(std::abs(t.left(b)), b);
        };
        std::nth_element(t.kept.begin(), t.kept.begin() + (count_ - 1), t.kept.end(), closer);
        t.kept.resize(static_cast<std::size_t>(count_));
        std::sort(t.kept.begin(), t.kept.end());
        for (const Eigen::Index i : t.kept) t.square += t.left(i) * t.left(i);
        return t;
    }

    Trimmed fitted_to(const std::vector<Eigen::Index>& rows) const {
        const Eigen::MatrixXd own = columns_(rows, Eigen::all);
        const Eigen::VectorXd value = data_(rows);
        return around(
            data_ - columns_ * solve_ranked(own.transpose() * own, own.transpose() * value).value);
    }

    Trimmed settled(Trimmed t, int steps) const {
        for (int k = 0; k < steps; ++k) {
            Trimmed next = fitted_to(t.kept);
            if (!(next.square < t.square)) return t;
            t = std::move(next);
        }
        return t;
    }

  private:
    const Eigen::MatrixXd& columns_;
    const Eigen::VectorXd& data_;
    Eigen::Index count_;
};

}  // namespace

Eigen::VectorXd trimmed_residual(const Eigen::MatrixXd& columns, const Eigen::VectorXd& data,
                                 const Eigen::VectorXd& start, double spoiled) {
    if (columns.cols() == 0 || data.size() == 0) return data;
    const TrimmedFit fit(columns, data, spoiled);
    Trimmed best = fit.settled(fit.around(start), most_steps);
    const Eigen::Index size = columns.cols() + 1;
    if (data.size() > few_rows || data.size() <= 2 * size) return best.left;
    std::mt19937 draw;
    std::vector<Eigen::Index> rows(static_cast<std::size_t>(data.size()));
    std::iota(rows.begin(), rows.end(), Eigen::Index{0});
    for (int k = 0; k < most_starts; ++k) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(size); ++i)
            std::swap(rows[i], rows[i + draw() % (rows.size() - i)]);
        Trimmed trial =
            fit.settled(fit.fitted_to({rows.begin(), rows.begin() + size}), first_steps);
        if (trial.square < best.square) best = std::move(trial);
    }
    return fit.settled(std::move(best), most_steps).left;
}

}  // namespace trunnion::estimation
