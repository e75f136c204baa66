#include "geometry/axis_names.h"

#include <catch2/catch.hpp>

using namespace trunnion;

TEST_CASE("columns of readings are the axis in lower case with its unit") {
    AxisNames names;
    CHECK(lower_case("AZaz09_[@") == "azaz09_[@");
    CHECK(names.column(Axis::X) == "x_mm");
    CHECK(names.column(Axis::C) == "c_deg");
    names.name[index_of(Axis::U)] = "J1";
    names.rotary[index_of(Axis::U)] = true;
    CHECK(names.column(Axis::U) == "j1_deg");
    CHECK(names.find("J1") == Axis::U);
    CHECK(names.find_column("j1_deg") == Axis::U);
    CHECK_FALSE(names.find_column("j1_mm"));
}

TEST_CASE("an axis that the machine does not have is not found") {
    AxisNames names;
    names.name[index_of(Axis::B)] = "";
    CHECK_FALSE(names.has(Axis::B));
    CHECK_FALSE(names.find("B"));
    CHECK_FALSE(names.find(""));
    CHECK_FALSE(names.find_column("_deg"));
    CHECK(names.find("C") == Axis::C);
}
