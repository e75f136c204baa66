// Trapezoids of speed: closed forms, splitting changes nothing, and numbers made another way.
#include "motion/speed_chain.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "base/random.h"

namespace trunnion {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

motion::SpeedLink link(double way, double speed, double acceleration, double entry = no_limit) {
    return {way, speed, acceleration, entry};
}

double time_of(const std::vector<motion::SpeedLink>& links) {
    motion::SpeedChain chain;
    double sum_s = 0.0;
    for (const motion::SpeedLink& l : links) sum_s += chain.add(l);
    return sum_s;
}

/// The same by the phase plane: squared speed at many places, limited from both ends, summed up.
double integrated(const std::vector<motion::SpeedLink>& links, int steps_a_link) {
    std::vector<double> top, step, acceleration;
    for (std::size_t k = 0; k < links.size(); ++k)
        for (int i = 0; i < steps_a_link; ++i) {
            const double before = i == 0 && k > 0 ? links[k - 1].speed : no_limit;
            top.push_back(std::min({links[k].speed, before, i == 0 ? links[k].entry : no_limit}));
            step.push_back(links[k].way / steps_a_link);
            acceleration.push_back(links[k].acceleration);
        }
    top.front() = 0.0;
    top.push_back(0.0);
    for (std::size_t i = 0; i < step.size(); ++i)
        top[i + 1] =
            std::min(top[i + 1], std::sqrt(top[i] * top[i] + 2.0 * acceleration[i] * step[i]));
    for (std::size_t i = step.size(); i-- > 0;)
        top[i] =
            std::min(top[i], std::sqrt(top[i + 1] * top[i + 1] + 2.0 * acceleration[i] * step[i]));
    double sum_s = 0.0;
    for (std::size_t i = 0; i < step.size(); ++i) sum_s += 2.0 * step[i] / (top[i] + top[i + 1]);
    return sum_s;
}

}  // namespace

TEST_CASE("one move: short of its speed, just reaching it, running at it") {
    const double v = 50.0, a = 1000.0, enough = v * v / a;
    for (const double way : {0.001, 0.5 * enough, 0.999 * enough})
        CHECK(time_of({link(way, v, a)}) == Approx(2.0 * std::sqrt(way / a)).epsilon(1e-14));
    CHECK(time_of({link(enough, v, a)}) == Approx(2.0 * v / a).epsilon(1e-14));
    for (const double way : {1.001 * enough, 10.0, 3000.0})
        CHECK(time_of({link(way, v, a)}) == Approx(way / v + v / a).epsilon(1e-14));
    CHECK(time_of({link(10.0, v, no_limit)}) == Approx(10.0 / v).epsilon(1e-14));
    CHECK(time_of({link(10.0, no_limit, a)}) == Approx(0.2).epsilon(1e-14));
}

TEST_CASE("a stop between two moves costs v / a, a joint with entry u costs (v - u)^2 / (v a)") {
    const double v = 40.0, a = 800.0;
    motion::SpeedChain stopped;
    double sum_s = stopped.add(link(100.0, v, a));
    stopped.stop();
    sum_s += stopped.add(link(60.0, v, a));
    CHECK(sum_s == Approx(160.0 / v + 2.0 * v / a).epsilon(1e-14));
    CHECK(time_of({link(100.0, v, a), link(60.0, v, a)}) ==
          Approx(160.0 / v + v / a).epsilon(1e-14));
    for (const double u : {0.0, 1.0, 25.0, 39.999})
        CHECK(time_of({link(100.0, v, a), link(60.0, v, a, u)}) ==
              Approx(160.0 / v + v / a + (v - u) * (v - u) / (v * a)).epsilon(1e-14));
}

TEST_CASE("other feed behind the joint: one ramp between the two speeds") {
    const double a = 500.0, v = 60.0, w = 20.0;
    // From 60 to 20 on the first move, so that the second begins with its own speed.
    const double expected = v / a + (v - w) / a + w / a +
                            (100.0 - v * v / (2 * a) - (v * v - w * w) / (2 * a)) / v +
                            (30.0 - w * w / (2 * a)) / w;
    CHECK(time_of({link(100.0, v, a), link(30.0, w, a)}) == Approx(expected).epsilon(1e-14));
}

TEST_CASE("a line in any number of pieces takes the time of the line") {
    SeededNoise noise(31);
    for (const int pieces : {2, 7, 100, 400}) {
        std::vector<motion::SpeedLink> links;
        double way = 0.0;
        for (int i = 0; i < pieces; ++i) {
            links.push_back(link(20.0 / pieces * (0.1 + noise.uniform()), 100.0, 600.0));
            way += links.back().way;
        }
        CHECK(time_of(links) == Approx(time_of({link(way, 100.0, 600.0)})).epsilon(1e-12));
    }
}

TEST_CASE("400 random chains against the phase plane") {
    SeededNoise noise(32);
    for (int k = 0; k < 400; ++k) {
        std::vector<motion::SpeedLink> links;
        const int count = 1 + k % 12;
        const bool one_acceleration = k % 2 == 0;
        const double acceleration = 300.0 + 2000.0 * noise.uniform();
        for (int i = 0; i < count; ++i)
            links.push_back(link(0.05 + 8.0 * noise.uniform() * noise.uniform(),
                                 5.0 + 95.0 * noise.uniform(),
                                 one_acceleration ? acceleration : 300.0 + 2000.0 * noise.uniform(),
                                 noise.uniform() < 0.3 ? no_limit : 100.0 * noise.uniform()));
        // The mean of two speeds is exact at constant acceleration, whatever the step.
        const double expected_s = integrated(links, 4000);
        if (one_acceleration)
            CHECK(time_of(links) == Approx(expected_s).epsilon(1e-5));
        else  // a chain that ends where a strong link saved a weak one its stop may owe some
            CHECK(time_of(links) > expected_s * (1 - 1e-5));
    }
}

TEST_CASE("the clock never runs backwards, even when a strong axis follows a weak one") {
    motion::SpeedChain chain;
    double sum_s = chain.add(link(100.0, 50.0, 50.0));
    const double growth_s = chain.add(link(0.05, 50.0, 50000.0));
    CHECK(growth_s == 0.0);
    sum_s += growth_s;
    for (int i = 0; i < 1000; ++i) {
        const double more_s = chain.add(link(0.05, 50.0, 50000.0));
        CHECK(more_s >= 0.0);
        sum_s += more_s;
    }
    // 25 mm to speed up in 1 s, 75 mm and 1001 short moves at speed, 0.025 mm of them to stop.
    CHECK(sum_s == Approx(1.0 + (75.0 + 1001 * 0.05 - 0.025) / 50.0 + 0.001).epsilon(1e-12));
}

}  // namespace trunnion
