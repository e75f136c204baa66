// One step of a hash of numbers.
#pragma once

#include <cstdint>

namespace trunnion::regression {

/// Hash of what `h` stands for, followed by `n` (half of the finalizer of SplitMix64).
inline std::uint64_t mix(std::uint64_t h, std::uint64_t n) {
    h = (h ^ n) * 0xBF58476D1CE4E5B9ULL;
    return h ^ (h >> 29U);
}

}  // namespace trunnion::regression
