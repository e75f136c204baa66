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

/// The step of a counter: that of which all values are multiples from the first one on, within the
/// rounding of their last decimal digit. 0 where there is none, for fewer than five
/// different values, and where so few may be multiples of so few digits by chance (0.002). `seen`:
/// at how many places different values were read, if that is known.
double counter_step(std::vector<double> values, std::size_t seen = 0);

/// Standard deviation of each device row by the last digit or count of its values, mm or rad: step
/// / sqrt(12). Steps are looked for in mm and in degrees. Of a servo log the digit is that of
/// commanded and actual positions, the count that of actual ones. Each device and feature has a
/// step of its own; of a servo log each number of digits before the decimal point, because logs
/// keep so many digits, and of those of actual positions alone if they have fewer. Values that grow
/// in even steps with the position are no counts: each count must have been read at two places (of
/// a log: times) on average. 0 for rows without a value or a step.
Eigen::VectorXd rounding(const records::ReadingTable& table, const emulator::Replay& replay);

/// Raises the standard deviation of rows to that of their rounding, except where a row states its
/// own: what a setup states of a device may be kept with fewer digits.
void add_rounding(const records::ReadingTable& table, const emulator::Replay& replay,
                  Eigen::VectorXd& sigma_mm);

/// Raises the standard deviation of the rows of a servo log whose noise nobody states to what
/// successive rows of an axis scatter by while it is commanded to stand still, if that is twice as
/// much or more; at least ten differences, robust against the settling after a move. In motion the
/// noise may be larger: it is a lower limit.
void add_rest_scatter(const setup::Setup& setup, const records::ReadingTable& table,
                      const emulator::Replay& replay, Eigen::VectorXd& sigma_mm);

}  // namespace trunnion::identification
