#include "base/random.h"

#include <catch2/catch.hpp>

using namespace trunnion;

TEST_CASE("seeded noise repeats and has mean 0, deviation 1") {
    SeededNoise a(7), b(7), c(8);
    double sum = 0.0, square = 0.0;
    for (int i = 0; i < 100000; ++i) {
        const double x = a.normal();
        REQUIRE(x == b.normal());
        sum += x;
        square += x * x;
    }
    CHECK(std::abs(sum / 1e5) < 0.013);
    CHECK(std::abs(square / 1e5 - 1.0) < 0.018);
    CHECK(SeededNoise(7).bits() != c.bits());
}

TEST_CASE("the noise of a seed is the published sequence of SplitMix64 on every computer") {
    SeededNoise noise(1234567);
    CHECK(noise.bits() == 6457827717110365317ULL);
    CHECK(noise.bits() == 3203168211198807973ULL);
    CHECK(noise.bits() == 9817491932198370423ULL);
}
