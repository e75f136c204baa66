// The noise of each row, as stated, usual, or as the record shows, and its weight in a fit.
#pragma once

#include <Eigen/Core>

#include "emulator/replay.h"

namespace trunnion::identification {

/// Standard deviation of each device row, mm (rad for angular rows), and whether table or setup
/// gave it for every row.
struct RowNoise {
    Eigen::VectorXd sigma_mm;
    bool given = true;
};
/// True where the row or the setup gives the noise of the row.
bool states_noise(const setup::Setup& setup, const records::Reading& row);
/// As the rows or the setup state it, else the usual one: for readings that are simulated.
RowNoise stated_noise(const setup::Setup& setup, const records::ReadingTable& table,
                      const emulator::Replay& replay);
/// The same, or what the record itself shows, if that is more (identification/resolution.h).
RowNoise row_noise(const setup::Setup& setup, const records::ReadingTable& table,
                   const emulator::Replay& replay);

/// Weight of each row: 1 / sigma, reduced for outliers (Huber at 3 sigma of the median). More than
/// a tenth of the readings are no outliers, but part of what is fitted.
Eigen::VectorXd row_weights(const Eigen::VectorXd& residual_mm, const Eigen::VectorXd& sigma_mm);

}  // namespace trunnion::identification
