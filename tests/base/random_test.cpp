#include "base/random.h"

#include <catch2/catch.hpp>
#include <cmath>

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

TEST_CASE("normal noise is made in pairs of a radius and an angle (Box and Muller)") {
    SeededNoise uniform(11), normal(11);
    for (int pair = 0; pair < 100; ++pair) {
        const double radius = std::sqrt(-2.0 * std::log(uniform.uniform()));
        const double angle_rad = 2.0 * 3.14159265358979323846 * uniform.uniform();
        CHECK(normal.normal() == Approx(radius * std::cos(angle_rad)).margin(1e-12));
        CHECK(normal.normal() == Approx(radius * std::sin(angle_rad)).margin(1e-12));
    }
}
