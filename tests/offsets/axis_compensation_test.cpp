// 1851 and the pitch data against tables worked out by hand.
#include "offsets/axis_compensation.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"

namespace trunnion {

namespace {

const std::vector<Axis> order{Axis::X, Axis::Y, Axis::Z, Axis::B};

offsets::AxisCompensation of(const offsets::Parameters& parameters, Axis axis) {
    for (const auto& one : offsets::decode_compensation(parameters, order))
        if (one.axis == axis) return one;
    return {};
}

/// Axis X from -100 to 150 in steps of 50, reference position in point 40: the points 39 to 43 are
/// the steps that end at -50, 0, 50, 100 and 150.
offsets::Parameters linear_table() {
    offsets::Parameters p;
    p.entry[3620].by_axis = {{1, 40.0}};
    p.entry[3621].by_axis = {{1, 39.0}};
    p.entry[3622].by_axis = {{1, 43.0}};
    p.entry[3624].by_axis = {{1, 50.0}};
    const double step[] = {2.0, -1.0, 3.0, 1.0, -5.0};
    for (int i = 0; i < 5; ++i) p.set(10039 + i, step[i]);
    return p;
}

}  // namespace

TEST_CASE("backlash is counted in detection units: increment by 1013 and 1001, CMR by 1820") {
    offsets::Parameters p;
    p.entry[1851].by_axis = {{1, 12.0}, {4, 30.0}};
    CHECK(of(p, Axis::X).backlash == Approx(0.012).epsilon(1e-14));
    CHECK(of(p, Axis::B).backlash == Approx(rad_from_deg(0.030)).epsilon(1e-14));
    CHECK(of(p, Axis::Y).backlash == 0.0);
    CHECK(of(p, Axis::X).at_position(10.0, 1) == Approx(0.006));
    CHECK(of(p, Axis::X).at_position(10.0, -1) == Approx(-0.006));
    CHECK(of(p, Axis::X).at_position(10.0, 0) == 0.0);
    p.entry[1820].by_axis = {{1, 20.0}};  // CMR 10
    CHECK(of(p, Axis::X).backlash == Approx(0.0012).epsilon(1e-14));
    p.entry[1820].by_axis = {{1, 102.0}};  // CMR 1/2
    CHECK(of(p, Axis::X).backlash == Approx(0.024).epsilon(1e-14));
    p.entry.erase(1820);
    p.entry[1013].by_axis = {{1, 2.0}};  // ISC
    CHECK(of(p, Axis::X).backlash == Approx(0.0012).epsilon(1e-14));
    p.entry.erase(1013);
    p.set_bit(1001, 0, true);  // 0.0001 inch
    CHECK(of(p, Axis::X).backlash == Approx(0.03048).epsilon(1e-14));
    p.entry[1020].by_axis = {{1, 89.0}, {2, 88.0}};  // Y is axis 1 of this control
    CHECK(of(p, Axis::X).backlash == 0.0);
    CHECK(of(p, Axis::Y).backlash != 0.0);
}

TEST_CASE("pitch data add up from point to point, nothing at the reference position") {
    offsets::Parameters p = linear_table();
    // -100: -(2 - 1), -50: 1, 0: 0, 50: 3, 100: 4, 150: -1 (um)
    const double at[] = {-100, -50, 0, 50, 100, 150}, um[] = {-1, 1, 0, 3, 4, -1};
    const offsets::AxisCompensation x = of(p, Axis::X);
    REQUIRE(x.at.size() == 6);
    for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(x.pitch(at[i]) - 1e-3 * um[i]) < 1e-15);
    CHECK(x.pitch(25.0) == Approx(0.0015));
    CHECK(x.pitch(112.5) == Approx(0.00275));
    CHECK(x.pitch(500.0) == Approx(-0.001));
    CHECK(x.pitch(-500.0) == Approx(-0.001));
    p.entry[3623].by_axis = {{1, 4.0}};
    CHECK(of(p, Axis::X).pitch(50.0) == Approx(0.012));
    p.entry[1240].by_axis = {{1, 10.0}};  // the reference position stands at X10.
    CHECK(of(p, Axis::X).pitch(60.0) == Approx(0.012));
    CHECK(std::abs(of(p, Axis::X).pitch(10.0)) < 1e-15);
}

TEST_CASE("the pitch table of a rotary axis repeats with the turn") {
    offsets::Parameters p;
    p.entry[3620].by_axis = {{4, 60.0}};
    p.entry[3621].by_axis = {{4, 60.0}};
    p.entry[3622].by_axis = {{4, 64.0}};
    p.entry[3624].by_axis = {{4, 90.0}};
    const double step[] = {1.0, 4.0, -2.0, -3.0, 1.0};  // 61 to 64 add up to 0
    for (int i = 0; i < 5; ++i) p.set(10060 + i, step[i]);
    const offsets::AxisCompensation b = of(p, Axis::B);
    CHECK(b.at.size() == 5);  // the step before the first point is the last one of the turn
    const double mdeg[] = {0, 4, 2, -1, 0};
    for (int turn = -3; turn <= 3; ++turn)
        for (int i = 0; i < 5; ++i) {
            INFO(turn << " " << i);
            const double q = rad_from_deg(360.0 * turn + 90.0 * i);
            CHECK(std::abs(b.pitch(q) - rad_from_deg(1e-3 * mdeg[i])) < 1e-12);
        }
    CHECK(b.pitch(rad_from_deg(-315.0)) == Approx(rad_from_deg(0.002)));
    p.entry[1240].by_axis = {{4, 45.0}};  // the reference position stands at B45.
    for (const double turned : {-720.0, -360.0, 0.0, 360.0}) {
        const auto at = [&](double deg) {
            return of(p, Axis::B).pitch(rad_from_deg(turned + deg));
        };
        CHECK(at(60.0) == Approx(rad_from_deg(0.004 / 6.0)));
        CHECK(at(30.0) == Approx(rad_from_deg(-0.001 / 6.0)));  // before the first point
    }
}

TEST_CASE("the last point of the pitch data is 1535, behind it is no datum") {
    offsets::Parameters p = linear_table();
    p.entry[3620].by_axis = {{1, 1534.0}};
    p.entry[3621].by_axis = {{1, 1534.0}};
    p.entry[3622].by_axis = {{1, 1535.0}};
    for (int point = 1534; point <= 1536; ++point) p.set(10000 + point, 4.0);
    CHECK(of(p, Axis::X).pitch(50.0) == Approx(0.004));
    p.entry[3622].by_axis = {{1, 1536.0}};
    CHECK(offsets::decode_compensation(p, order).empty());
}

TEST_CASE("numbers that describe no table compensate nothing") {
    offsets::Parameters p = linear_table();
    p.entry[3624].by_axis = {{1, 0.0}};
    CHECK(offsets::decode_compensation(p, order).empty());
    p = linear_table();
    p.entry[3622].by_axis = {{1, 9999.0}};
    CHECK(offsets::decode_compensation(p, order).empty());
    p = linear_table();
    for (int n = 10039; n <= 10043; ++n) p.set(n, 0.0);
    CHECK(offsets::decode_compensation(p, order).empty());
}

TEST_CASE("points of a table that stand in no order compensate nothing") {
    const auto has_table = [](double reference, double first, double last) {
        offsets::Parameters p = linear_table();
        p.entry[3620].by_axis = {{1, reference}};
        p.entry[3621].by_axis = {{1, first}};
        p.entry[3622].by_axis = {{1, last}};
        return !offsets::decode_compensation(p, order).empty();
    };
    CHECK(has_table(40, 39, 43));
    CHECK(has_table(40, 41, 43));
    CHECK(has_table(43, 39, 43));
    CHECK_FALSE(has_table(40, -1, 43));
    CHECK_FALSE(has_table(40, 42, 43));  // begins behind the step at the reference
    CHECK_FALSE(has_table(44, 39, 43));  // ends before the reference
    CHECK_FALSE(has_table(40, 40, 40));
}

TEST_CASE("a rotary axis whose table repeats before the turn does, by 3625") {
    offsets::Parameters p;
    p.entry[3620].by_axis = {{4, 60.0}};
    p.entry[3621].by_axis = {{4, 61.0}};
    p.entry[3622].by_axis = {{4, 62.0}};
    p.entry[3624].by_axis = {{4, 60.0}};
    p.entry[3625].by_axis = {{4, 120.0}};
    p.set(10061, 3.0);
    p.set(10062, -3.0);
    for (const double at_deg : {60.0, 180.0, -60.0})
        CHECK(of(p, Axis::B).pitch(rad_from_deg(at_deg)) == Approx(rad_from_deg(0.003)));
    CHECK(std::abs(of(p, Axis::B).pitch(rad_from_deg(120.0))) < 1e-15);
}

}  // namespace trunnion
