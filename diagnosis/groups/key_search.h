// Search for the most promising keys: pitches, periods, time constants and times.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <map>
#include <vector>

#include "estimation/projection.h"
#include "identification/base_model.h"

namespace trunnion::diagnosis {

/// Evaluates the grids of effects with keys on residuals. The columns of an effect depend on
/// positions only, so they are computed once, on a fixed selection of rows, and used for every
/// residual.
class KeySearch {
  public:
    KeySearch(const emulator::Replay& replay, const identification::BaseModel& base);

    /// A residual (mm) with the columns (mm, base first) that are fitted again beside an effect.
    struct Remainder {
        Eigen::VectorXd rough, fine;  ///< of the selected rows, in sigma
        Eigen::MatrixXd fitted;       ///< these columns on the fine rows, of length 1
        Eigen::LLT<Eigen::MatrixXd> factor{Eigen::MatrixXd(0, 0)};  ///< L, of their products L L'
        Eigen::VectorXd along;                                      ///< L^-1 fitted' fine
    };
    Remainder remainder(const Eigen::VectorXd& left_mm, const Eigen::MatrixXd& fitted) const;

    /// The best local maxima on the key grid of an effect, by weighted least squares on a residual;
    /// best first.
    std::vector<std::vector<double>> best(const effects::Effect& effect, const Remainder& remainder,
                                          int count);

  private:
    struct Setting {
        std::vector<double> values;
        Eigen::MatrixXd rough;  ///< weighted columns on the rough rows, beside the base
        /// Of their information and prior.
        Eigen::LLT<Eigen::MatrixXd> factor{Eigen::MatrixXd(0, 0)};
        Eigen::MatrixXd fine;  ///< on the fine rows, empty until needed
    };
    Eigen::VectorXd fine_gains(const std::vector<Setting*>& finalists,
                               const Remainder& remainder) const;
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
    estimation::Projection base_columns_;         ///< on the rough rows
    std::map<const effects::Effect*, std::vector<Setting>> settings_;
};

}  // namespace trunnion::diagnosis
