// Axes that carry neither work nor tool.
#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"
#include "setup/control_axes.h"

namespace trunnion {

namespace {

const char* const machine =
    "schema = \"trunnion.setup/1\"\n[machine]\nchain = \"w C B b X Y Z t\"\n"
    "auxiliary = [\"W\", \"A\"]\n"
    "axis.B = { direction = [0, -1, 0], point_mm = [0, 0, 0] }\n"
    "axis.C = { direction = [0, 0, -1], point_mm = [0, 0, 0] }\n"
    "axis.W = { limits_mm = [-10, 500], max_mm_min = 6000 }\n"
    "axis.A = { limits_deg = [0, 90] }\n"
    "[control.clamps]\nW = { clamp = 70, release = 71 }\n";

setup::Setup load(const std::string& text) {
    std::vector<std::string> notes;
    return setup::parse_setup(text, "t.toml", notes);
}

emulator::RunLog run(const setup::Setup& setup, const std::string& program) {
    interpreter::ProgramFolders none({});
    const auto text = std::make_shared<const std::string>(program);
    emulator::RunOptions options;
    options.trace = true;
    return emulator::run_program(setup, none, interpreter::ProgramText{"t.nc", *text, text},
                                 options);
}

}  // namespace

TEST_CASE("NC words move an auxiliary axis, and the tip stays where it is") {
    const setup::Setup s = load(machine);
    const emulator::RunLog log = run(s, "G90G21G54\nG0X10.Y20.Z30.B15.C40.\nG0W400.A45.\nM30\n");
    REQUIRE_FALSE(log.result.alarm);
    CHECK(log.result.machine[Axis::W] == 400.0);
    CHECK(log.result.time_s > 4.0);  // 400 mm at 6 m/min
    const auto tips = log.trace_csv;
    CHECK(tips.find("w_mm") != std::string::npos);
    const setup::Setup plain = load(
        "schema = \"trunnion.setup/1\"\n[machine]\nchain = \"w C B b X Y Z t\"\n"
        "axis.B = { direction = [0, -1, 0], point_mm = [0, 0, 0] }\n"
        "axis.C = { direction = [0, 0, -1], point_mm = [0, 0, 0] }\n");
    CHECK((s.machine.tip_W(log.result.machine, {0, 0, -150}) -
           plain.machine.tip_W(log.result.machine, {0, 0, -150}))
              .norm() == 0.0);
}

TEST_CASE("the travel of an auxiliary axis holds, and so does its clamp") {
    const setup::Setup s = load(machine);
    CHECK(run(s, "G90G0W500.01\nM30\n").result.alarm->number == 500);
    CHECK(run(s, "G90G0A-0.01\nM30\n").result.alarm->number == 501);
    CHECK(run(s, "M70\nG90G0W1.\nM30\n").result.alarm.has_value());
    CHECK_FALSE(run(s, "M70\nM71\nG90G0W1.\nM30\n").result.alarm.has_value());
}

TEST_CASE("axes of the chain keep their numbers beside an auxiliary one") {
    const setup::Setup s = load(machine);
    // B and C are axes 4 and 5 as without it: 19681, 19686.
    CHECK(s.stores.parameters.get(19681) == 4.0);
    CHECK(s.stores.parameters.get(19686) == 5.0);
    const auto axes = setup::control_axes(s);
    REQUIRE(axes.size() == 7);
    CHECK(axes[5].axis == Axis::W);
    // TCP turns B and C about their lines: the tip stays on the point.
    const emulator::RunLog log =
        run(s, "G90G21G54\nG43.4H1X50.Y0Z100.\nG1B30.C20.W100.F500.\nM30\n");
    REQUIRE_FALSE(log.result.alarm);
    const Vector3 tip = s.machine.tip_W(log.result.machine, Vector3::Zero());
    CHECK((tip - Vector3(50.0, 0.0, 100.0)).norm() < 1e-9);
}

TEST_CASE("auxiliary axes are written and read again") {
    const setup::Setup s = load(machine);
    const setup::Setup again = load(setup::format_setup(s));
    REQUIRE(again.auxiliary.size() == 2);
    CHECK(again.auxiliary[0].name == "W");
    CHECK(again.auxiliary[0].max == 500.0);
    CHECK(again.auxiliary[0].max_speed == s.auxiliary[0].max_speed);
    CHECK(again.auxiliary[1].rotary);
    CHECK(setup::format_setup(again) == setup::format_setup(s));
}

TEST_CASE("what an auxiliary axis cannot have is refused at its place") {
    const std::string head = "schema = \"trunnion.setup/1\"\n[machine]\nchain = \"w b X Y Z t\"\n";
    CHECK_THROWS_AS(load(head + "auxiliary = [\"X\"]\n"), InputError);
    CHECK_THROWS_AS(load(head + "auxiliary = [\"W\", \"W\"]\n"), InputError);
    CHECK_THROWS_AS(load(head + "auxiliary = [\"J1\"]\n"), InputError);
    CHECK_THROWS_AS(load(head + "auxiliary = [\"W\"]\naxis.W = { direction = [0, 0, 1] }\n"),
                    InputError);
    CHECK_THROWS_AS(load(head + "auxiliary = [\"W\"]\naxis.W = { limits_deg = [0, 1] }\n"),
                    InputError);
    CHECK_THROWS_AS(load(head + "axis.W = { limits_mm = [0, 1] }\n"), InputError);
}

}  // namespace trunnion
