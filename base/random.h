// Seeded noise with the same numbers for every compiler and thread count.
#pragma once

#include <cstdint>

namespace trunnion::inline base {

/// SplitMix64 with Box-Muller for normal deviates, because the standard distributions differ
/// between libraries.
class SeededNoise {
  public:
    explicit SeededNoise(std::uint64_t seed) : state_(seed) {}

    std::uint64_t bits();
    double uniform();  ///< in (0, 1)
    double normal();   ///< mean 0, standard deviation 1

  private:
    std::uint64_t state_;
    double spare_ = 0.0;
    bool has_spare_ = false;
};

}  // namespace trunnion::inline base
