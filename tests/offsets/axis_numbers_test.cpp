// Numbers of axes in parameters: by 1020, by the order of the machine, by slot.
#include "offsets/axis_numbers.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "offsets/parameter_units.h"
#include "offsets/whole_parameter.h"

namespace trunnion {

namespace {

const std::vector<Axis> xyzbc{Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C};

}  // namespace

TEST_CASE("the axis of a number: 1020, then the order of the machine, then the slots") {
    offsets::Parameters p;
    CHECK(offsets::axis_of_number(p, 4, xyzbc) == Axis::B);
    CHECK(offsets::axis_of_number(p, 4, {}) == Axis::A);
    for (const int number : {0, -1, 6}) CHECK_FALSE(offsets::axis_of_number(p, number, xyzbc));
    CHECK_FALSE(offsets::axis_of_number(p, 10, {}));
    p.entry[1020].by_axis[4] = 'A';
    p.entry[1020].by_axis[5] = '7';
    CHECK(offsets::axis_of_number(p, 4, xyzbc) == Axis::A);
    CHECK(offsets::axis_of_number(p, 1, xyzbc) == Axis::X);  // 1020 does not name it
    CHECK_FALSE(offsets::axis_of_number(p, 5, xyzbc));       // it names no axis
    CHECK(offsets::number_of_named_axis(p, Axis::A, xyzbc) == 4);
    CHECK(offsets::number_of_named_axis(p, Axis::C, xyzbc) == 5);
}

TEST_CASE("the number of an axis that the machine does not have is 0") {
    CHECK(offsets::number_of_axis(Axis::C, xyzbc) == 5);
    CHECK(offsets::number_of_axis(Axis::A, xyzbc) == 0);
    CHECK(offsets::number_of_axis(Axis::A, {}) == 4);
}

TEST_CASE("a parameter by axis has no value for the axes it does not name") {
    offsets::Parameters p;
    CHECK_FALSE(offsets::value_of_axis(p, 1240, 1));
    p.set(1240, 7.0);
    CHECK(offsets::value_of_axis(p, 1240, 2) == 7.0);
    p.entry[1240].by_axis[1] = 3.0;
    CHECK(offsets::value_of_axis(p, 1240, 1) == 3.0);
    CHECK_FALSE(offsets::value_of_axis(p, 1240, 2));
}

TEST_CASE("1022: U, V and W beside X, Y or Z, and nothing else") {
    const std::vector<Axis> xyzuvw{Axis::X, Axis::Y, Axis::Z, Axis::U, Axis::V, Axis::W};
    offsets::Parameters p;
    const auto none = offsets::parallel_axes(p, xyzuvw);
    p.entry[1022].by_axis = {{4, 5.0}, {5, 7.0}, {6, 3.0}, {1, 6.0}, {9, 5.0}};
    auto some = offsets::parallel_axes(p, xyzuvw);
    CHECK(some.beside[0] == 0);               // U beside X
    CHECK(some.beside[1] == 2);               // V beside Z
    CHECK(some.beside[2] == none.beside[2]);  // 3 is no parallel axis
    p.entry[1022].by_axis = {{6, 8.0}};
    some = offsets::parallel_axes(p, xyzuvw);
    CHECK(some.beside == none.beside);
}

TEST_CASE("lengths of the five-axis group are inches on an inch machine, the rest is not") {
    offsets::Parameters p;
    CHECK(offsets::parameter_unit_mm(p, 19700) == 1.0);
    p.set_bit(1001, 0, true);
    for (const int number : {19666, 19700, 19705, 19709, 19714})
        CHECK(offsets::parameter_unit_mm(p, number) == 25.4);
    for (const int number : {19665, 19667, 19699, 19706, 19708, 19715, 1240})
        CHECK(offsets::parameter_unit_mm(p, number) == 1.0);
}

// A file may hold any number; to convert one beyond an int is undefined.
TEST_CASE("a parameter beyond nine digits is no whole number") {
    using offsets::bits_of_parameter;
    using offsets::whole_parameter;
    CHECK(whole_parameter(12.9) == 12);
    CHECK(whole_parameter(-7.0) == -7);
    CHECK(whole_parameter(999'999'999.0) == 999'999'999);
    for (const double none : {1e9, -1e9, 1e22, -1e308, std::nan(""), HUGE_VAL})
        CHECK(whole_parameter(none) == 0);
    CHECK((bits_of_parameter(6.0) & 2U) == 2U);
    CHECK((bits_of_parameter(-1.0) & 2U) == 2U);
    CHECK(bits_of_parameter(1e22) == 0U);
}

}  // namespace trunnion
