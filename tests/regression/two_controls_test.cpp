// One program on two controls: told is where they would move differently, and only there.
#include "regression/two_controls.h"

#include <catch2/catch.hpp>

namespace trunnion {

namespace {

regression::ControlReading reading(const std::string& name) {
    regression::ControlReading out;
    out.name = name;
    out.config.dialect =
        name == "hurco" ? interpreter::hurco_dialect() : interpreter::fanuc_dialect();
    for (const Axis axis : {Axis::X, Axis::Y, Axis::Z, Axis::B, Axis::C}) {
        controller::ControlAxis entry;
        entry.axis = axis;
        entry.rotary = is_rotary(axis);
        out.config.axes.push_back(entry);
    }
    out.stores.tools.tool[1].length_geometry_mm = 100.0;
    out.stores.parameters.set(3401, 1);
    return out;
}

std::vector<regression::ReadingDifference> compared(const std::string& text,
                                                    const regression::ControlReading& a,
                                                    const regression::ControlReading& b) {
    return regression::compare_controls(a, b, interpreter::ProgramText{"t.nc", text, nullptr}, [] {
        return std::make_unique<interpreter::ProgramsInMemory>();
    });
}

std::vector<regression::ReadingDifference> fanuc_and_hurco(const std::string& text) {
    return compared(text, reading("fanuc"), reading("hurco"));
}

}  // namespace

TEST_CASE("what both read alike is not told") {
    CHECK(fanuc_and_hurco("G90 G21 G17\nG0 X10.\nG1 Y5. F100.\nG2 X20. R5.\nM30\n").empty());
}

TEST_CASE("a tool length that moves on one control is told where it arises and where it ends") {
    const auto found = fanuc_and_hurco("G90 G21\nG43 H1\nX5.\nG0 Z50.\nM30\n");
    REQUIRE(found.size() == 2);
    CHECK(found[0].line == 2);
    CHECK(found[0].text == "ends at Z100.0000 on fanuc, Z0.0000 on hurco: 100.0000 mm apart");
    CHECK(found[0].apart == 100.0);
    CHECK(found[1].line == 4);
    CHECK(found[1].text.find("alike again") != std::string::npos);
}

TEST_CASE("a dogleg and a dwell of the same end: the way is told") {
    const auto found = fanuc_and_hurco("G90 G21\nG0 X100. Y20.\nM30\n");
    REQUIRE(found.size() == 1);
    CHECK(found[0].line == 2);
    CHECK(found[0].text == "is half way at Y10.0000 on fanuc, Y20.0000 on hurco: 10.0000 mm apart");
}

TEST_CASE("every move of a cycle is compared") {
    const std::string program =
        "G90 G21 G17\nG0 Z50.\nG73 X10. Z-8. R2. Q3. F100.\nX20.\nG80\nM30\n";
    regression::ControlReading other = reading("5114=3");
    other.stores.parameters.set(5114, 3.0);
    const auto found = compared(program, reading("fanuc"), other);
    REQUIRE(found.size() == 2);
    CHECK(found[0].line == 3);
    CHECK(found[0].text.starts_with("passes Z"));
    CHECK(found[1].line == 4);
    CHECK(compared(program, reading("fanuc"), reading("same")).empty());
}

TEST_CASE("turns that bring both together half way do not hide the way between") {
    const std::string program = "G90 G21\nG0 C0\nG1 X40. C720. F500.\nM30\n";
    const std::string arc = "G90 G21 G17\nG0 X0 Y0\nG2 X20. R10. F100.\nM30\n";
    CHECK(compared(program, reading("fanuc"), reading("same")).empty());
    CHECK(compared(arc, reading("fanuc"), reading("same")).empty());
}

TEST_CASE("an alarm of one control and another way through the program are told") {
    const auto alarm = fanuc_and_hurco("G90 G21\nG53.1\nM30\n");
    REQUIRE(alarm.size() == 2);
    CHECK(alarm[1].text.find("hurco stops here: PS0010") == 0);
    auto other = reading("old");
    other.stores.parameters.set(5006, 64);
    const auto way = compared("G90 G21\nG43 H1\nIF[#5023GT50.]GOTO5\nG0 X1.\nN5 X2.\nM30\n",
                              reading("new"), other);
    REQUIRE(way.size() == 2);
    CHECK(way[1].text == "from here new goes on at line 5, old at line 4");
}

TEST_CASE("the same alarm at the same place is told by nobody, any other by its control") {
    CHECK(fanuc_and_hurco("G90 G21\nG0 X10.\n#3000=1(STOP)\n").empty());
    const auto alarms = [](const char* a, const char* b) {
        auto with = reading("a"), without = reading("b");
        with.stores.variables[500] = 1.0;
        without.stores.variables[500] = 2.0;
        return compared(
            std::string("G90 G21\nIF[#500EQ2.]GOTO5\n") + a + "\nM30\nN5" + b + "\nM30\n", with,
            without);
    };
    const auto other_alarms = alarms("#3000=1", "#3000=2");
    REQUIRE(other_alarms.size() == 2);
    CHECK(other_alarms[0].text.find("a stops here: ") == 0);
    CHECK(other_alarms[0].line == 3);
    CHECK(other_alarms[1].text.find("b stops here: ") == 0);
    CHECK(other_alarms[1].line == 5);
    auto small = reading("small"), large = reading("large");
    small.stores.tools.tool.resize(5);
    const auto one = compared("G90 G21\nG43 H20 Z0.\nM30\n", small, large);
    REQUIRE_FALSE(one.empty());
    CHECK(one.back().text.find("small stops here: ") == 0);
    const auto other = compared("G90 G21\nG43 H20 Z0.\nM30\n", large, small);
    REQUIRE_FALSE(other.empty());
    CHECK(other.back().text.find("small stops here: ") == 0);
}

TEST_CASE("a rotary axis that differs most is told in degrees") {
    auto old = reading("old");
    old.stores.work.external[Axis::B] = 30.0;
    const auto found = compared("G90 G21\nG0 X10. B40.\nM30\n", reading("new"), old);
    REQUIRE(found.size() == 1);
    CHECK(found[0].text == "ends at B40.0000 on new, B70.0000 on old: 30.0000 deg apart");
}

}  // namespace trunnion
