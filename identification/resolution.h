// What a record itself shows of its noise: a reading is no better than the digits that were kept,
// and the log of an axis no better than its scatter at rest.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "emulator/replay.h"

namespace trunnion::identification {

/// The largest of 1, 0.1, .. 1e-6 of which 95 % of the values are multiples, within rounding; 0 is
/// no value. Returns 0 where no step is one, and for fewer than five values.
double decimal_step(const std::vector<double>& values);

/// Raises the standard deviation (mm, rad) of rows whose noise nobody states to 1 / sqrt(12) of the
/// last digit of their values, in mm or degrees. Of a servo log the digit is that of commanded and
/// actual positions, and counts beside what the setup states of the encoder, too: logs are kept
/// with fewer digits than encoders have. Each device and feature has a digit of its own; of a servo
/// log each number of digits before the decimal point, because logs keep so many digits.
void add_rounding(const setup::Setup& setup, const records::ReadingTable& table,
                  const emulator::Replay& replay, Eigen::VectorXd& sigma_mm);

/// Raises the standard deviation of the rows of a servo log whose noise nobody states to what
/// successive rows of an axis scatter by while it is commanded to stand still, if that is twice as
/// much or more; at least ten differences, robust against the settling after a move. In motion the
/// noise may be larger: it is a lower limit.
void add_rest_scatter(const setup::Setup& setup, const records::ReadingTable& table,
                      const emulator::Replay& replay, Eigen::VectorXd& sigma_mm);

}  // namespace trunnion::identification
