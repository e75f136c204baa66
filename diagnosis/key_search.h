// Where to look for keys: pitches, periods, time constants and moments that promise most.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <map>
#include <string_view>
#include <vector>

#include "identification/base_model.h"

namespace trunnion::diagnosis {

/// The key that counts periods to a turn of a rotary axis.
inline constexpr std::string_view periods_key = "periods_per_turn";

/// Columns that are fitted beside others and take their part of what those could explain.
class Beside {
  public:
    explicit Beside(Eigen::MatrixXd weighted);
    /// h of columns a, g of b: the fit beside leaves of a^T b only a^T b - h^T g.
    Eigen::MatrixXd half(const Eigen::MatrixXd& weighted) const;

  private:
    Eigen::MatrixXd columns_;
    Eigen::LLT<Eigen::MatrixXd> factor_;
};

/// Tries the grids of effects with keys on residuals. Columns of the effects depend on positions
/// only: they are worked out once, on a fixed scatter of rows, and serve every residual.
class KeySearch {
  public:
    KeySearch(const emulator::Replay& replay, const identification::BaseModel& base);

    /// A residual (mm) with the columns that left it (mm, base first) and that are fitted anew
    /// beside an effect.
    struct Remainder {
        Eigen::VectorXd rough, fine;  ///< of the scattered rows, in sigma
        Beside others;                ///< on the fine rows
        Eigen::VectorXd rough_half, fine_half;
    };
    Remainder remainder(const Eigen::VectorXd& left_mm, const Eigen::MatrixXd& fitted) const;

    /// The best few settings of an effect's keys by weighted least squares on a remainder; best
    /// first, none next to another on the grid.
    std::vector<std::vector<double>> best(const effects::Effect& effect, const Remainder& remainder,
                                          int count);

  private:
    struct Setting {
        std::vector<double> values;
        Eigen::MatrixXd rough;               ///< weighted columns on the rough scatter
        Eigen::MatrixXd half;                ///< of these beside the base
        Eigen::LLT<Eigen::MatrixXd> factor;  ///< of their information beside the base
        Eigen::MatrixXd fine;                ///< on the fine scatter, empty until asked for
    };
    std::vector<Setting>& settings_of(const effects::Effect& effect);
    std::vector<Setting> worked_out(const effects::Effect& effect) const;
    Eigen::MatrixXd first_orders(const effects::Effect& effect) const;
    Eigen::MatrixXd columns(const effects::Effect& effect, const std::vector<double>& keys,
                            const std::vector<std::size_t>& rows,
                            const Eigen::VectorXd& weight) const;

    const emulator::Replay& replay_;
    const identification::BaseModel& base_;
    std::vector<std::size_t> rough_rows_, fine_rows_;
    Eigen::VectorXd rough_weight_, fine_weight_;  ///< 1 / sigma of those rows
    Beside beside_;                               ///< the base on the rough ones
    std::map<const effects::Effect*, std::vector<Setting>> settings_;
};

}  // namespace trunnion::diagnosis
