#include "base/random.h"

#include <cmath>

#include "base/units.h"

namespace trunnion::inline base {

std::uint64_t SeededNoise::bits() {
    state_ += 0x9E3779B97F4A7C15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
}

double SeededNoise::uniform() {
    return (static_cast<double>(bits() >> 11) + 0.5) * 0x1.0p-53;
}

double SeededNoise::normal() {
    if (has_spare_) {
        has_spare_ = false;
        return spare_;
    }
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    const double angle_rad = 2.0 * pi * uniform();
    spare_ = radius * std::sin(angle_rad);
    has_spare_ = true;
    return radius * std::cos(angle_rad);
}

}  // namespace trunnion::inline base
