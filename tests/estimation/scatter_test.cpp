// The deviation of values of which some are spoiled.
#include "estimation/scatter.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

namespace trunnion {
namespace {

/// Root of the mean of the squares told of many samples of normal deviates with something added.
template <class Spoil>
double told_of(std::size_t size, Spoil spoil) {
    std::mt19937_64 engine(size);
    std::normal_distribution<double> normal(0.0, 0.3);
    constexpr int samples = 2000;
    double sum = 0.0;
    for (int k = 0; k < samples; ++k) {
        std::vector<double> values(size);
        for (std::size_t i = 0; i < size; ++i) values[i] = spoil(i, normal(engine));
        sum += std::pow(estimation::scatter_of(values, 0.0).deviation, 2);
    }
    return std::sqrt(sum / samples) / 0.3;
}

}  // namespace

TEST_CASE("the scatter of normal deviates is their deviation", "[estimation]") {
    for (const std::size_t size : {10, 20, 50, 200}) {
        INFO(size);
        CHECK(told_of(size, [](std::size_t, double e) { return e; }) == Approx(1.0).epsilon(0.015));
    }
}

TEST_CASE("spoiled values do not scatter, and what half of the values have is no accident",
          "[estimation]") {
    const auto wild = [](std::size_t i, double e) { return i % 10 == 3 ? e + 4.0 : e; };
    CHECK(told_of(20, wild) == Approx(1.0).epsilon(0.02));
    CHECK(told_of(100, wild) == Approx(1.0).epsilon(0.02));
    // Five to seven deviations off: one in nine. They must not make room for each other.
    const auto few = [](std::size_t i, double e) {
        return i % 9 == 4 ? e + 1.5 + 0.015 * static_cast<double>(i) : e;
    };
    CHECK(told_of(44, few) < 1.15);  // 1.30 where all are weighed against all
    const auto rough = [](std::size_t i, double e) { return i % 2 == 0 ? 5.0 * e : e; };
    CHECK(told_of(100, rough) > 3.2);  // the root of the mean square is 3.61

    std::vector<double> values(20, 1.0);
    values[4] = 50.0;
    const estimation::Scatter scatter = estimation::scatter_of(values, 0.0);
    CHECK(scatter.deviation == Approx(1.0));
    CHECK_FALSE(scatter.kept[4]);
    CHECK(std::count(scatter.kept.begin(), scatter.kept.end(), true) == 19);
}

// Three readings of four are the same: the steps of the scale.
TEST_CASE("steps of a coarse scale are not spoiled", "[estimation]") {
    std::vector<double> values(40, 0.0);
    for (std::size_t i = 0; i < values.size(); i += 4) values[i] = i % 8 == 0 ? 1.0 : -1.0;
    CHECK(estimation::scatter_of(values, 0.41).deviation == Approx(0.5));
    CHECK(estimation::scatter_of({}, 1.0).deviation == 0.0);
}

}  // namespace trunnion
