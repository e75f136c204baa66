// The cycles of a laser or autocollimator test: to the far end and back, or there only.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "emulator/replay.h"

namespace trunnion::diagnosis {

/// Number of the cycle of each device row, from 0 on over all tests. A new one begins with a test
/// and where the axis starts again from the side of the first reading. Empty where other readings
/// are present, or more than one axis moves.
std::vector<Eigen::Index> cycles_of(const emulator::Replay& replay,
                                    const records::ReadingTable& table);

}  // namespace trunnion::diagnosis
