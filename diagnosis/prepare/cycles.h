// The cycles of a laser or autocollimator test: to the far end and back, or there only.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "emulator/replay.h"

namespace trunnion::diagnosis {

/// The only axis that moves in the readings of a laser or an autocollimator; none if there are
/// several or other readings.
std::optional<Axis> measured_axis(const emulator::Replay& replay,
                                  const records::ReadingTable& table);

/// Number of the cycle of each device row, from 0 on over all tests. A new one begins with a test
/// and where the axis starts again from the side of the first reading, after half of the targets of
/// its test at least. Empty where other readings
/// are present, or more than one axis moves.
std::vector<Eigen::Index> cycles_of(const emulator::Replay& replay,
                                    const records::ReadingTable& table);

}  // namespace trunnion::diagnosis
