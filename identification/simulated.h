// Simulated readings of the devices of a setup.
#pragma once

#include <cstdint>

#include "emulator/replay.h"

namespace trunnion::identification {

/// The table with value_mm of every device row replaced by its prediction plus one normal sample of
/// the row's noise (RowNoise). The same seed gives the same table.
records::ReadingTable simulated(const setup::Setup& setup, const records::ReadingTable& table,
                                std::uint64_t seed);

}  // namespace trunnion::identification
