// Outliers: excluded when they are few and scattered, kept when they are clustered.
#pragma once

#include "diagnosis/prepare/prepare.h"

namespace trunnion::diagnosis {

/// The device of each row.
std::vector<records::Device> devices_of(const emulator::Replay& replay);

/// Probe readings far from a fit of the set-up alone, the worst first, with a new fit each time.
/// Not for the ballbar, where a single reading at each reversal may be the only sign of a spike.
/// Returns device rows in ascending order; empty when there are more than 4 % of them or they are
/// clustered among those of their device.
std::vector<std::size_t> lone_probe_readings(const Prepared& prepared,
                                             const std::vector<bool>& used);

/// One count of the last digit of each row, in its sigma; both arguments are in mm or rad,
/// `rounding_mm` is the deviation by that digit (identification/resolution.h), 0 without one. A
/// reading is spoiled only if it is off by a digit more: of a display coarser than the noise nearly
/// all values agree, and the others show the next digit.
Eigen::VectorXd last_digit(const Eigen::VectorXd& rounding_mm, const Eigen::VectorXd& sigma_mm);

/// Residuals of rows and one digit of each, both divided by its noise, and the devices.
struct NoisyResiduals {
    Eigen::VectorXd left, digit;
    std::vector<records::Device> devices;
};

/// How many of so many readings may be spoiled beside chance: 4 % and two deviations of that
/// number.
double most_by_chance(std::size_t readings);

/// Readings of `used` far from the prediction of a model, by the same rule; none if they are more
/// than `most`.
std::vector<std::size_t> wild_readings(const NoisyResiduals& rows, const std::vector<bool>& used,
                                       double most);

/// True for more spoiled readings than an instrument has (4 %), beyond chance: of 60 readings more
/// than five, of 2,000 more than 97. Then there is a gap of some kind.
bool are_spoiled(const std::vector<bool>& used);
/// True where those readings of a probe, a tracker or a CMM that were set aside are along one
/// direction more often than by chance: an error of the machine has a direction, a spoiled reading
/// has none.
bool are_along_one(const std::vector<bool>& used, const emulator::Replay& replay);
/// Either of both.
bool are_spoiled(const std::vector<bool>& used, const emulator::Replay& replay);

}  // namespace trunnion::diagnosis
