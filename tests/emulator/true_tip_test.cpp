// run --truth: the tip of the tool in the spindle, of a spindle with errors, of extra axes.
#include <catch2/catch.hpp>
#include <sstream>

#include "base/alarm.h"
#include "effects/settings.h"
#include "emulator/run.h"

using namespace trunnion;

namespace {

const std::string mill = R"(
schema = "trunnion.setup/1"
[machine]
name = "horizontal mill"
chain = "w W b X Y Z t"
[control.tools]
1 = { length_mm = 150 }
2 = { length_mm = 100 }
[probe]
tool = 9
[machine.errors]
)";

setup::Setup setup_of(const std::string& text, std::vector<std::string>* notes = nullptr) {
    std::vector<std::string> own;
    return setup::parse_setup(text, "mill.toml", notes ? *notes : own);
}

/// Believed and true tip of the last row of a program's trace.
struct Ends {
    Vector3 believed_mm, true_mm;
    double length_mm = 0.0, path_mm = 0.0, time_s = 0.0;
};

Ends run_to_end(const setup::Setup& setup, const std::string& program) {
    emulator::RunOptions options;
    options.trace = options.truth = true;
    options.effects = effects::active_models(setup);
    interpreter::ProgramsInMemory none;
    const emulator::RunLog log = emulator::run_program(
        setup, none, interpreter::ProgramText{"t.nc", program, nullptr}, options);
    REQUIRE(log.result.status == controller::RunStatus::ok);
    std::istringstream lines(log.trace_csv);
    std::string header, line, last;
    std::getline(lines, header);
    while (std::getline(lines, line)) last = line;
    const auto cell = [&](const std::string& name) {
        std::istringstream names(header), cells(last);
        std::string column, value;
        while (std::getline(names, column, ',') && std::getline(cells, value, ','))
            if (column == name) return std::stod(value);
        FAIL("no column " << name);
        return 0.0;
    };
    return {{cell("tip_x_mm"), cell("tip_y_mm"), cell("tip_z_mm")},
            {cell("true_x_mm"), cell("true_y_mm"), cell("true_z_mm")},
            cell("length_mm"),
            log.result.path_mm,
            log.result.time_s};
}

const std::string head = "O1\nG21 G90 G94 G17 G54\n";

}  // namespace

TEST_CASE("the true tip is that of the tool in the spindle, whatever H says") {
    const setup::Setup setup = setup_of(mill);
    const Ends right = run_to_end(setup, head + "T1 M06\nG43 H1 Z50.\nG1 X10. F500.\nM30\n");
    CHECK((right.true_mm - right.believed_mm).norm() < 1e-12);
    CHECK(right.true_mm.z() == Approx(50.0));
    const Ends wrong = run_to_end(setup, head + "T1 M06\nG43 H2 Z50.\nG1 X10. F500.\nM30\n");
    CHECK(wrong.believed_mm.z() == Approx(50.0));
    CHECK(wrong.true_mm.z() == Approx(0.0).margin(1e-12));
    const Ends selected = run_to_end(setup, head + "T1 M06\nT2\nG43 H1 Z50.\nG1 X10. F500.\nM30\n");
    CHECK(selected.true_mm.z() == Approx(50.0));  // T2 waits in the changer
    const Ends changed =                          // the program's own table is belief
        run_to_end(setup, head + "G10 L10 P1 R140.\nT1 M06\nG43 H1 Z50.\nG1 X10. F500.\nM30\n");
    CHECK(changed.believed_mm.z() == Approx(50.0));
    CHECK(changed.true_mm.z() == Approx(40.0));
    const Ends none = run_to_end(setup, head + "T1 M06\nG1 X10. F500.\nM30\n");
    CHECK(none.true_mm.z() == Approx(-150.0));
}

TEST_CASE("effects of the tool act on its true tip") {
    setup::Setup setup = setup_of(mill);
    setup.effects = {{"tool.length", {{"error_mm", {0.05}}}}};
    const std::string cut = "G43 H1 Z50.\nG1 X10. F500.\nM30\n";
    CHECK(run_to_end(setup, head + "T1 M06\n" + cut).true_mm.z() == Approx(49.95).epsilon(1e-12));
    setup.effects = {{"probe.runout", {{"dx_mm", {0.01}}, {"dy_mm", {0.02}}}}};
    CHECK(run_to_end(setup, head + "T1 M06\n" + cut).true_mm.x() == Approx(10.0).epsilon(1e-12));
    setup.probe->tool = 1;
    const Ends probe = run_to_end(setup, head + "T1 M06\n" + cut);
    CHECK(probe.true_mm.x() == Approx(10.01).epsilon(1e-12));
    CHECK(probe.true_mm.y() == Approx(0.02).epsilon(1e-9));
}

TEST_CASE("errors of the spindle: by its angle while it stands, their mean while it turns") {
    const setup::Setup setup = setup_of(
        mill +
        "EXS_mm = { constant = 0.002, harmonics = [[1, 0.01, 0.003]] }\nEBS_rad = 1e-5\nEY0S_mm = "
        "0.02\n");
    const std::string cut = "G43 H1 Z50.\nG1 X10. F500.\n";
    const double tilt_mm = 150.0 * 1e-5;
    const Ends still = run_to_end(setup, head + "T1 M06\n" + cut + "M30\n");
    CHECK(still.true_mm.x() == Approx(10.012 - tilt_mm).epsilon(1e-9));
    CHECK(still.true_mm.y() == Approx(0.02).epsilon(1e-9));
    const Ends turning = run_to_end(setup, head + "T1 M06\nS1000 M03\n" + cut + "M30\n");
    CHECK(turning.true_mm.x() == Approx(10.002 - tilt_mm).epsilon(1e-9));
    const Ends oriented =
        run_to_end(setup, head + "T1 M06\nS1000 M03\n" + cut + "M19\nG1 X20.\nM30\n");
    CHECK(oriented.true_mm.x() == Approx(20.012 - tilt_mm).epsilon(1e-9));
}

TEST_CASE("what is no error of a spindle is refused with its place") {
    for (const char* line :
         {"ECS_rad = 1e-5\n", "EXS_rad = 1e-5\n", "EX0S_mm = [1, 2]\n",
          "EXS_mm = { slope = 1e-5 }\n", "EXS_mm = { at_deg = [0, 90], value = [0, 1] }\n"}) {
        INFO(line);
        try {
            setup_of(mill + line);
            FAIL("nothing thrown");
        } catch (const InputError& error) {
            CHECK(error.where.line == 12);
        }
    }
}

TEST_CASE("an extra axis W moves the believed tip as the true one") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup_of(mill, &notes);
    CHECK(setup.derived_parameters == 1);
    const auto& numbers = setup.stores.parameters.entry.at(1022).by_axis;
    CHECK(numbers == std::map<int, double>{{1, 1}, {2, 2}, {3, 3}, {4, 7}});  // X Y Z W
    const Ends end = run_to_end(
        setup, head + "T1 M06\nG43 H1 Z50.\nG0 W0\nG1 W-30. F600.\nG1 X40. Y30. W-30.\nM30\n");
    CHECK((end.believed_mm - Vector3(40, 30, 20)).norm() < 1e-12);
    CHECK((end.true_mm - end.believed_mm).norm() < 1e-12);
    CHECK(end.length_mm == Approx(50.0));
    const Ends alone = run_to_end(setup, head + "G1 W-30. F600.\nM30\n");
    CHECK(alone.path_mm == Approx(30.0));
    CHECK(alone.time_s == Approx(3.0));
}

TEST_CASE("an extra axis that runs against the basic one, or obliquely, is not believed") {
    std::vector<std::string> notes;
    const setup::Setup setup =
        setup_of(mill + "[machine.axis.W]\ndirection = [0, 0, 1]\n", &notes);  // of the table
    CHECK(setup.stores.parameters.entry.at(1022).by_axis.at(4) == 0.0);
    CHECK_THAT(notes.front(), Catch::Contains("how W runs"));
}

TEST_CASE("a quill W under tool centre point control: the tip is where it was programmed") {
    const std::string five = R"(
schema = "trunnion.setup/1"
[machine]
chain = "w C B b X Y Z W t"
[machine.axis.B]
direction = [0, -1, 0]
point_mm = [10, 0, -50]
[machine.axis.C]
direction = [0, 0, -1]
point_mm = [12, 1, -50]
[control.tools]
1 = { length_mm = 150 }
)";
    const setup::Setup setup = setup_of(five);
    CHECK(setup.stores.parameters.entry.at(1022).by_axis.at(6) == 7.0);
    const Ends tcp = run_to_end(setup, head +
                                           "T1 M06\nG0 W-20.\nG43.4 H1 X30. Y0 Z40.\nG1 X30. Y10. "
                                           "Z45. B30. C20. F900.\nM30\n");
    CHECK((tcp.believed_mm - Vector3(30, 10, 45)).norm() < 1e-9);
    CHECK((tcp.true_mm - tcp.believed_mm).norm() < 1e-9);
}
