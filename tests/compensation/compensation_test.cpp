#include "compensation/compensation.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

#include "base/alarm.h"
#include "base/random.h"
#include "base/units.h"
#include "effects/settings.h"

using namespace trunnion;

namespace {

/// 41 errors of realistic size: 30 error motions, 8 location errors, 3 squarenesses.
setup::Setup setup_with_errors() {
    std::vector<std::string> notes;
    setup::Setup setup = setup::load_setup(TRUNNION_SOURCE_DIR "/machines/bc_table.toml", notes);
    for (const int number : {19700, 19701, 19702, 19703, 19704, 19705})
        setup.stores.parameters.set(number, 0.0);
    setup.stores.work.standard[0] = {};
    SeededNoise noise(4);
    kinematics::GeometricErrors& errors = setup.machine.errors;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        for (std::size_t k = 0; k < 6; ++k) {
            kinematics::ErrorCurve& curve = errors.axis[index_of(axis.axis)].motion[k];
            curve.interpolation = kinematics::ErrorCurve::Interpolation::cubic;
            for (int i = -4; i <= 4; ++i) {
                curve.at.push_back(axis.rotary ? 0.8 * i : 125.0 * i);
                curve.value.push_back((k < 3 ? 0.004 : 1.5e-5) * noise.normal());
            }
        }
    for (const char* name : {"EX0B", "EZ0B", "EX0C", "EY0C"})
        errors.location(*kinematics::parse_error_name(name)) = 0.015 * noise.normal();
    for (const char* name : {"EA0B", "EC0B", "EA0C", "EB0C", "EC0Y", "EA0Z", "EB0Z"})
        errors.location(*kinematics::parse_error_name(name)) = 3e-5 * noise.normal();
    return setup;
}

compensation::CompensatedProgram compensate(const setup::Setup& setup, const std::string& text,
                                            const compensation::CompensationOptions& options = {}) {
    interpreter::ProgramsInMemory programs;
    return compensation::compensate_program(setup, programs,
                                            interpreter::ProgramText{"p.nc", text, nullptr},
                                            effects::active_models(setup), options);
}

setup::Setup setup_with_backlash(double linear_mm, double rotary_rad, bool other_errors) {
    setup::Setup setup = setup_with_errors();
    if (!other_errors) setup.machine.errors = {};
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        setup.effects.push_back(
            axis.rotary ? setup::EffectSetting{axis.name + ".backlash", {{"gap_rad", {rotary_rad}}}}
                        : setup::EffectSetting{axis.name + ".backlash", {{"gap_mm", {linear_mm}}}});
    return setup;
}

const std::string rotary_reversals =
    "O1\nG21 G17 G90 G54\nT1 M06\nG0 B5. C0\nG0 X100. Y0.\nG43.4 H1 Z60.\n"
    "G1 X100. Y20. Z40. C30. B10. F2000.\nC10.\nC10.05\nC10.\nX80. B25.\nB20. C12.\n"
    "X60. Y-20. C-30.\nX61.\nX60.\nB20.1 C-29.\nB10. C-30.\nG49\nG53 G0 Z400.\nM30\n";

const std::string linear_reversals =
    "O1\nG21 G17 G90 G54\nT1 M06\nG0 X-60. Y-60. Z250.\nG43 H1 Z50.\nG1 X60. F1000.\nY60.\n"
    "X-60.\nY-60.\nX0\nX60. Z40.\nX-60. Y-20. Z45.\nG0 Z100.\nX60. Y0.\nZ50.\nG3 I-60.\n"
    "G2 X0. Y60. I-60. J0.\nG0 Z200.\nM30\n";

/// Largest distance of the true tip from the believed one where the tool feeds, every 0.5 mm, of
/// the compensated program against what the original meant: the circle of 60 mm about (0, 0).
struct CirclePath {
    double worst_um = 0.0;
    int off = 0, rows = 0;  ///< off by more than 0.2 um
};
CirclePath circle_path(const setup::Setup& setup, const std::string& program) {
    interpreter::ProgramsInMemory none;
    emulator::RunOptions options;
    options.trace = options.truth = true;
    options.trace_step_mm = 0.5;
    options.effects = effects::active_models(setup);
    const emulator::RunLog log = emulator::run_program(
        setup, none, interpreter::ProgramText{"c.nc", program, nullptr}, options);
    CirclePath path;
    std::istringstream lines(log.trace_csv);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        if (line.find(",1,0,") != std::string::npos) continue;  // tool 1, feed 0: rapid
        const std::size_t z = line.rfind(','), y = line.rfind(',', z - 1),
                          x = line.rfind(',', y - 1);
        const double off_um = um_from_mm(std::abs(
            std::hypot(std::stod(line.substr(x + 1)), std::stod(line.substr(y + 1))) - 60.0));
        path.worst_um = std::max(path.worst_um, off_um);
        path.off += off_um > 0.2;
        ++path.rows;
    }
    return path;
}

}  // namespace

TEST_CASE("a three-axis program lands where it meant, with 41 errors") {
    const setup::Setup setup = setup_with_errors();
    const compensation::CompensatedProgram c = compensate(
        setup,
        "O1\nG21 G17 G90 G54\nT1 M06\nS3000 M03\nM08\nG0 X-80. Y-60. Z250.\nG43 H1 Z120.\n"
        "G1 Z60. F800.\n#1=0\nWHILE [#1 LT 3] DO1\nG1 X[80.-#1] F1200.\nG1 Y60.\nG3 X-80. "
        "I[#1/2-80.] J0.\n"
        "G1 Y-60.\n#1=#1+1\nEND1\nG18 G2 X20. I50. K0.\nG19 G3 Y-20. J20. K0.\nG4 P500\nG0 "
        "Z200.\nM05\nM30\n");
    REQUIRE(c.original.status == controller::RunStatus::ok);
    INFO(c.program);
    for (const std::string& note : c.notes) UNSCOPED_INFO(note);
    REQUIRE(c.executed.status == controller::RunStatus::ok);
    CHECK(c.notes.empty());
    CHECK(c.before.tip_mm > 0.01);
    CHECK(c.after.tip_mm < 1e-4);
    CHECK(c.executed.time_s == Approx(c.original.time_s).epsilon(0.01));
    for (const char* word :
         {"T1 M06", "S3000. M03", "M08", "G43 H1", "G4 X0.5", "M05", "G18 G2", "G19 G3"})
        CHECK_THAT(c.program, Catch::Contains(word));
}

TEST_CASE("on a Hurco a program lands where it meant, in the units and arcs of ISNC and BNC") {
    setup::Setup setup = setup_with_errors();
    setup.dialect = interpreter::hurco_dialect();
    for (const bool bnc : {false, true}) {
        CAPTURE(bnc);
        setup.hurco.bnc = bnc;
        const std::string arcs =
            bnc ? "G3 X-80. Y60. I0. J60.\nG1 Y-60.\nG18 G3 X20. Z60. I-30. K60.\nG19 G3 Y-20. "
                  "Z60. J-40. K60.\n"
                : "G3 X-80. Y60. I-80. J0.\nG1 Y-60.\nG18 G2 X20. Z60. I50. K0.\nG19 G3 Y-20. "
                  "Z60. J20. K0.\n";
        const compensation::CompensatedProgram c =
            compensate(setup, std::string("O1\n") + (bnc ? "G71 G75" : "G21") +
                                  " G17 G90 G54\nT1 M06\nS3000 M03\nG0 X-80. Y-60. Z250.\nG43 H1 "
                                  "Z120.\nG1 Z60. F800.\nX80. Y60.\n" +
                                  arcs + "G4 P.5\nG0 Z200.\nM05\nM30\n");
        REQUIRE(c.original.status == controller::RunStatus::ok);
        CAPTURE(c.program);
        REQUIRE(c.executed.status == controller::RunStatus::ok);
        CHECK(c.before.tip_mm > 0.01);
        CHECK(c.after.tip_mm < 1e-4);
        CHECK(c.executed.time_s == Approx(c.original.time_s).epsilon(0.01));
    }
}

TEST_CASE("the whole path lands where it meant, not only the ends of blocks") {
    const setup::Setup setup = setup_with_errors();
    // a circle of 60 mm about (0, 0) at Z 50: every sample of the physical path lies on it
    const std::string circle =
        "O1\nG21 G17 G90 G54\nT1 M06\nG0 X60. Y0.\nG43 H1 Z50.\nG3 I-60. F1000.\nM30\n";
    const compensation::CompensatedProgram c = compensate(setup, circle);
    REQUIRE(c.executed.status == controller::RunStatus::ok);
    const auto worst_um = [&](const std::string& program) {
        interpreter::ProgramsInMemory none;
        emulator::RunOptions options;
        options.trace = options.truth = true;
        options.trace_step_mm = 1.0;
        const emulator::RunLog log = emulator::run_program(
            setup, none, interpreter::ProgramText{"c.nc", program, nullptr}, options);
        double worst = 0.0;
        std::size_t start = log.trace_csv.find('\n') + 1;
        while (start < log.trace_csv.size()) {
            const std::size_t end = log.trace_csv.find('\n', start);
            const std::string line = log.trace_csv.substr(start, end - start);
            start = end + 1;
            if (line.find(",1,0,") != std::string::npos) continue;  // tool 1, feed 0: rapid
            const std::size_t z = line.rfind(','), y = line.rfind(',', z - 1),
                              x = line.rfind(',', y - 1);
            const double px = std::stod(line.substr(x + 1)), py = std::stod(line.substr(y + 1)),
                         pz = std::stod(line.substr(z + 1));
            worst = std::max({worst, std::abs(std::hypot(px, py) - 60.0), std::abs(pz - 50.0)});
        }
        return um_from_mm(worst);
    };
    CHECK(worst_um(circle) > 5.0);
    CHECK(worst_um(c.program) < 0.1);
    CHECK(c.blocks.size() < 60);  // arcs stay arcs
}

TEST_CASE("five axes under tool centre point control land where they meant") {
    const setup::Setup setup = setup_with_errors();
    const compensation::CompensatedProgram c =
        compensate(setup,
                   "O1\nG21 G17 G90 G54\nT1 M06\nG0 B0 C0\nG0 X100. Y0.\nG43.4 H1 Z60.\n"
                   "G1 X100. Y20. Z40. B30. C40. F2000.\nG1 X80. Y-20. Z45. B-20. C90.\n"
                   "G49\nG53 G0 Z400.\nM30\n");
    REQUIRE(c.original.status == controller::RunStatus::ok);
    INFO(c.program);
    INFO((c.notes.empty() ? "" : c.notes.back()));
    if (c.executed.alarm) INFO(c.executed.alarm->where.line << ' ' << c.executed.alarm->block);
    REQUIRE(c.executed.status == controller::RunStatus::ok);
    CHECK(c.before.tip_mm > 0.01);
    CHECK(c.after.tip_mm < 1e-4);
    CHECK(c.blocks.size() > 20);
    CHECK(c.before.turned_rad > 2e-5);
    CHECK(c.after.turned_rad <= c.before.turned_rad);  // it begins in the singular direction
}

TEST_CASE("the tool's direction: corrected where the rotaries work, kept where they stand") {
    const setup::Setup setup = setup_with_errors();
    // A positioned plane first: its rotaries keep their words; then a swarf cut.
    const std::string program =
        "O1\nG21 G17 G90 G54\nT1 M06\nG0 B25. C60.\nG43 H1 X20. Y0. Z120.\nG1 X60. F1000.\n"
        "G49\nG0 B20. C0\nG43.4 H1 X100. Y0. Z60.\nG1 X100. Y20. Z40. B40. C40. F2000.\n"
        "X80. Y-20. Z45. B35. C90.\nG49\nG53 G0 Z400.\nM30\n";
    const compensation::CompensatedProgram c = compensate(setup, program);
    REQUIRE(c.executed.status == controller::RunStatus::ok);
    CHECK(c.notes == c.original.notes);
    CHECK(c.after.tip_mm < 1e-4);
    CHECK(c.after.turned_rad < 5e-8);
    CHECK(c.after.kept_rad == Approx(c.before.kept_rad).epsilon(0.05));
    CHECK_THAT(c.program, Catch::Contains("B25. C60."));
    const compensation::CompensatedProgram kept = compensate(setup, program, {5e-5, 6, 0.0});
    CHECK(kept.after.tip_mm < 1e-4);
    CHECK(kept.after.turned_rad == 0.0);
    CHECK(kept.after.kept_rad > 2e-5);
}

TEST_CASE("near the singular direction the rotaries turn no further than allowed") {
    const setup::Setup setup = setup_with_errors();
    const std::string program =
        "O1\nG21 G17 G90 G54\nT1 M06\nG0 B0 C0\nG0 X100. Y0.\nG43.4 H1 X50. Y0. Z60.\n"
        "G1 X100. Y20. Z40. B0.01 C10. F2000.\nX80. B-0.01 C20.\nG49\nM30\n";
    const compensation::CompensatedProgram c = compensate(setup, program, {5e-5, 6, 1e-3});
    REQUIRE(c.executed.status == controller::RunStatus::ok);
    CHECK(c.after.tip_mm < 1e-4);
    CHECK(c.after.turned_rad <= c.before.turned_rad);
    CHECK(c.after.turned_rad > 1e-7);  // about the tilt axis's square nothing can be done
    // Unlimited, C would turn by tens of degrees; it stays within 0.06 deg of 10 and of 20.
    CHECK_THAT(c.program, Catch::Contains(" C10.0") || Catch::Contains(" C9.9"));
    CHECK_THAT(c.program, !Catch::Contains(" C30") && !Catch::Contains(" C-1"));
}

TEST_CASE("G31 goes out with a corrected target unless the program asks where it touched") {
    const setup::Setup setup = setup_with_errors();
    const compensation::CompensatedProgram c =
        compensate(setup,
                   "O1\nG21 G17 G90 G54\nT1 M06\nG0 X-80. Y-60. Z250.\nG43 H1 Z120.\n"
                   "G31 Z80. F300.\nG0 Z120.\nM30\n");
    REQUIRE(c.executed.status == controller::RunStatus::ok);
    CHECK_THAT(c.program, Catch::Contains("G31 "));
    CHECK(c.before.tip_mm > 0.005);
    CHECK(c.after.tip_mm < 1e-4);
    try {
        compensate(setup, "O1\nG90 G54\nG31 X10. F100.\n#1=#5061\nM30\n");
        FAIL("nothing thrown");
    } catch (const InputError& error) {
        CHECK(error.where.line == 3);
        CHECK_THAT(error.message, Catch::Contains("position of a G31 touch"));
    }
}

TEST_CASE("cycles become their moves, tapping says so") {
    const setup::Setup setup = setup_with_errors();
    const std::string head =
        "O1\nG21 G17 G90 G54 G98\nT1 M06\nS500 M03\nG0 X-80. Y-60. Z250.\nG43 H1 Z120.\n";
    const compensation::CompensatedProgram drilled =
        compensate(setup, head + "G83 X0 Y0 Z20. R60. Q10. F200.\nX40.\nG80\nM30\n");
    REQUIRE(drilled.executed.status == controller::RunStatus::ok);
    CHECK(drilled.notes.empty());
    CHECK(drilled.after.tip_mm < 1e-4);
    const compensation::CompensatedProgram tapped =
        compensate(setup, head + "G84 X0 Y0 Z40. R60. F500.\nG80\nM30\n");
    REQUIRE(tapped.notes.size() == 1);
    CHECK_THAT(tapped.notes[0], Catch::Contains("line 7: tapping"));
    CHECK(tapped.after.tip_mm < 1e-4);
}

TEST_CASE("a machine without errors gets its program back in other words") {
    std::vector<std::string> notes;
    setup::Setup setup =
        setup::load_setup(TRUNNION_SOURCE_DIR "/machines/mill_xy_table.toml", notes);
    const compensation::CompensatedProgram c = compensate(
        setup, "O1\nG90 G54 G0 X10. Y20. Z30.\nG1 X50. F500.\nG2 X70. Y40. I0. J20.\nM30\n");
    REQUIRE(c.executed.status == controller::RunStatus::ok);
    CHECK(c.after.tip_mm < 2e-6);
    CHECK_THAT(c.program, Catch::Contains("G1 X50. F500."));
}

TEST_CASE("what cannot be compensated says so") {
    const setup::Setup setup = setup_with_errors();
    const compensation::CompensatedProgram c =
        compensate(setup, "O1\nG90 G54 G1 X10.\nG777\nM30\n");
    CHECK(c.original.status == controller::RunStatus::alarm);
    CHECK(c.program.empty());
}

TEST_CASE("backlash of the rotaries follows the corrected axes: the tip lands where it meant") {
    const compensation::CompensatedProgram plain =
        compensate(setup_with_backlash(0.0, 0.0, false), rotary_reversals);
    CHECK(plain.after.tip_mm < 2e-6);
    for (const double gap_rad : {6e-5, -6e-5}) {
        INFO(gap_rad);
        const setup::Setup setup = setup_with_backlash(0.0, gap_rad, false);
        const compensation::CompensatedProgram c = compensate(setup, rotary_reversals);
        REQUIRE(c.executed.status == controller::RunStatus::ok);
        CHECK(c.notes == c.original.notes);
        CHECK(c.before.tip_mm > 0.002);
        CHECK(c.after.tip_mm < 1e-4);
        CHECK(c.after.turned_rad < 5e-8);
        // A gap that overshoots leaves half of itself where an axis has just turned round.
        CHECK(c.in_gap.tip_mm < 1e-4);
        CHECK(c.in_gap.turned_rad < (gap_rad > 0 ? 0.51 * gap_rad : 1e-8));
        CHECK(c.blocks.size() < plain.blocks.size() + 150);
    }
}

TEST_CASE("backlash of X, Y and Z: blocks end where they meant, whichever way the axes came") {
    for (const double gap_mm : {0.005, -0.005}) {
        INFO(gap_mm);
        const setup::Setup setup = setup_with_backlash(gap_mm, 0.0, false);
        const compensation::CompensatedProgram c = compensate(setup, linear_reversals);
        REQUIRE(c.executed.status == controller::RunStatus::ok);
        CHECK(c.before.tip_mm > 0.003);
        CHECK(c.after.tip_mm < 1e-4);
        CHECK(c.in_gap.tip_mm < (gap_mm > 0 ? 0.0026 : 1e-9));
        CHECK(c.blocks.size() < 250);
    }
}

TEST_CASE("a circle on a machine with backlash is round but for the gap at its quadrants") {
    const std::string circle =
        "O1\nG21 G17 G90 G54\nT1 M06\nG0 X60. Y0.\nG43 H1 Z50.\nG3 I-60. F1000.\nM30\n";
    for (const double gap_mm : {0.005, -0.005}) {
        INFO(gap_mm);
        const setup::Setup setup = setup_with_backlash(gap_mm, 0.0, false);
        const compensation::CompensatedProgram c = compensate(setup, circle);
        REQUIRE(c.executed.status == controller::RunStatus::ok);
        const CirclePath before = circle_path(setup, circle), after = circle_path(setup, c.program);
        CHECK(before.off > 0.8 * before.rows);
        CHECK(after.off < 0.03 * after.rows);
        CHECK(after.worst_um < (gap_mm > 0 ? 2.6 : 0.2));  // half the gap where it must be crossed
    }
}

TEST_CASE("41 errors and backlash of every axis at once") {
    for (const double sign : {1.0, -1.0}) {
        const setup::Setup setup = setup_with_backlash(sign * 0.005, sign * 6e-5, true);
        for (const std::string& program : {rotary_reversals, linear_reversals}) {
            const compensation::CompensatedProgram c = compensate(setup, program);
            REQUIRE(c.executed.status == controller::RunStatus::ok);
            CHECK(c.before.tip_mm > 0.02);
            CHECK(c.after.tip_mm < 1e-4);
            // Small corrections to and fro end inside a gap that overshoots: half of it is left.
            CHECK(c.in_gap.tip_mm < (sign > 0 ? 0.0045 : 2e-5));
        }
    }
}

TEST_CASE("an axis that moves the tool the other way is refused, as a mirror of the part") {
    for (const char* direction : {"[machine.axis.Z]\ndirection = [0, 0, -1]\n",
                                  "[machine.axis.Y]\ndirection = [0, 1, 0]\n"}) {
        INFO(direction);
        std::vector<std::string> notes;
        const setup::Setup mirrored =
            setup::parse_setup(std::string("[machine]\nchain = \"w Y b X Z t\"\n") + direction +
                                   "[machine.errors]\nEC0Y_rad = 1e-4\n",
                               "mirror.toml", notes);
        CHECK_THROWS_WITH(compensate(mirrored, "O1\nG21 G90 G54\nG1 F500. X10. Y5. Z-5.\nM30\n"),
                          Catch::Contains("against + of M"));
    }
}

TEST_CASE("a machine with an extra axis W lands where it meant") {
    std::vector<std::string> notes;
    setup::Setup setup = setup::parse_setup(
        "[machine]\nchain = \"w W b X Y Z t\"\n[machine.errors]\n"
        "EXW_mm = { at_mm = [-100, 0, 100], value = [0.004, 0, -0.006] }\nEAW_rad = 2e-5\n"
        "EZW_mm = { slope = 1e-4 }\nEB0W_rad = 5e-5\nEC0Y_rad = 3e-5\n"
        "[control.tools]\n1 = { length_mm = 150 }\n",
        "mill.toml", notes);
    const std::string program =
        "O1\nG21 G17 G90 G54\nT1 M06\nG0 X-40. Y-30. W40.\nG43 H1 Z50.\nG1 X40. W-20. F800.\n"
        "G1 W60.\nG2 X0 Y-70. I-40. J0. F500.\nG0 W-80.\nM30\n";
    const compensation::CompensatedProgram c = compensate(setup, program);
    REQUIRE(c.executed.status == controller::RunStatus::ok);
    CHECK(c.before.tip_mm > 0.005);
    CHECK(c.after.tip_mm < 1e-4);
    CHECK_THAT(c.program, Catch::Contains(" W-20."));
    setup.stores.parameters.entry.erase(1022);
    CHECK_THROWS_AS(compensate(setup, program), InputError);
}
