// Length and diameter of tools on a tool setter, standing and turning, against closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "base/alarm.h"
#include "effects/settings.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion {

namespace {

constexpr double exact = 1e-6;  // mm

setup::Setup mill(const std::string& more = "", const std::string& setter = "") {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "schema = \"trunnion.setup/1\"\n[machine]\nchain = \"w b X Y Z t\"\n" + more +
            "[tools]\n20 = { length_mm = 100.0, diameter_mm = 8.0 }\n"
            "5 = { length_mm = 123.456, diameter_mm = 16.0, runout_mm = [0.03, 0.04] }\n"
            "[control.tools]\n5 = { length_mm = 120.0, diameter_mm = 16.0 }\n"
            "[[body]]\nname = \"setter\"\nkind = \"setter\"\ncenter_mm = [200, -50, 30]\n"
            "diameter_mm = 20.0\nheight_mm = 8.0\n" +
            setter,
        "t.toml", notes);
}

std::string shipped(const std::string& name) {
    std::ifstream in(TRUNNION_SOURCE_DIR "/programs/probing/" + name, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str().substr(2, text.str().rfind('%') - 2);
}

/// Calibrates with the pin of tool 20, calls tool 5, goes above the setter and calls.
emulator::RunLog log_of(const setup::Setup& setup, const std::string& calls) {
    interpreter::ProgramFolders none({});
    const auto text = std::make_shared<const std::string>(
        "%\nO1\nG90G21G17G54\nT20M6\nG0X200.4Y-50.3\nZ160.\n"
        "G65P8480X200.5Y-50.5Z30.2A100.D8.V20.F100.\nG0Z180.\nT5M6\n" +
        calls + "\nM30\n" + shipped("O8410.nc") + shipped("O8480.nc") + "%\n");
    emulator::RunOptions options;
    options.effects = effects::active_models(setup);
    for (int n = 135; n <= 138; ++n) options.wanted_variables.push_back(n);
    for (int n = 530; n <= 533; ++n) options.wanted_variables.push_back(n);
    return emulator::run_program(setup, none, interpreter::ProgramText{"t.nc", *text, text},
                                 options);
}

std::map<int, double> measured(const setup::Setup& setup, const std::string& calls) {
    const emulator::RunLog log = log_of(setup, calls);
    if (log.result.alarm)
        FAIL_CHECK(log.result.alarm->number << " " << log.result.alarm->text << " line "
                                            << log.result.alarm->where.line);
    return log.variables;
}

}  // namespace

TEST_CASE("a pin calibrates the setter: middle, top, diameter") {
    const auto v = measured(mill(), "");
    CHECK(std::abs(v.at(530) - 200.0) < exact);
    CHECK(std::abs(v.at(531) + 50.0) < exact);
    CHECK(std::abs(v.at(532) - 30.0) < exact);
    CHECK(std::abs(v.at(533) - 20.0) < exact);
}

TEST_CASE("length of a tool, whatever offset is in force while it is measured") {
    for (const char* length : {"G49\n", "G43H5Z60.\n"}) {
        INFO(length);
        const auto v = measured(mill(), std::string(length) + "G65P8481B123.F100.");
        CHECK(std::abs(v.at(135) - 123.456) < exact);
        CHECK(std::abs(v.at(138) - 0.456) < exact);
    }
}

TEST_CASE("diameter: a tool that turns is larger by twice its runout, one that stands is aside") {
    const auto stands = measured(mill(), "G65P8482B123.456D16.F100.");
    // The tool's axis stands at (0.03, 0.04): both contacts are at Y 0.04 from the middle.
    const double reach = 18.0, across = std::sqrt(reach * reach - 0.04 * 0.04);
    CHECK(std::abs(stands.at(135) - (2.0 * across - 20.0)) < exact);
    CHECK(std::abs(stands.at(136) - 0.03) < exact);
    const auto turns = measured(mill(), "M4S800\nG65P8482B123.456D16.F100.");
    CHECK(std::abs(turns.at(135) - 16.1) < exact);
    CHECK(std::abs(turns.at(136)) < exact);
    CHECK(std::abs(turns.at(138) - 0.1) < exact);
}

TEST_CASE("the orientation of the spindle turns the runout of a tool that stands") {
    const auto v = measured(mill(), "POPEN\nDPRNT[SPINDLE*180]\nPCLOS\nG65P8482B123.456D16.F100.");
    CHECK(std::abs(v.at(136) + 0.03) < exact);
}

TEST_CASE("G37 writes the true length into the offset") {
    const std::string rule = "[control.parameters]\n6241 = 100.0\n6251 = 8.0\n6254 = 5.0\n";
    const std::string measure = "G37Z30.\n#135=#2005+#2205";
    CHECK(std::abs(measured(mill(rule), "G43H5Z60.\n" + measure).at(135) - 123.456) < exact);
    // Behind 12 um of pretravel the setter answers later: the tool seems shorter.
    const auto late = measured(mill(rule, "pretravel_um = 12\n"), "G43H5Z60.\n" + measure);
    CHECK(std::abs(late.at(135) - 123.444) < exact);
    const emulator::RunLog far = log_of(mill(rule), "G43H5Z60.\nG37Z20.");
    REQUIRE(far.result.alarm);
    CHECK(far.result.alarm->number == 80);
}

TEST_CASE("a tool that cuts at its rim is measured beside the middle of the disc") {
    // 15 mm aside the tip of 8 mm radius still stands over the disc of 10 mm radius, 19 mm not.
    const auto v = measured(mill(), "M4S800\nG65P8481B123.I15.F100.");
    CHECK(std::abs(v.at(135) - 123.456) < exact);
    const emulator::RunLog missed = log_of(mill(), "G65P8481B123.I19.F100.");
    REQUIRE(missed.result.alarm);
    CHECK(missed.result.alarm->number == 3102);
}

TEST_CASE("pretravel of the setter is in its calibration and so not in the tool") {
    const auto v = measured(mill("", "pretravel_um = 12\n"),
                            "G65P8481B123.H5F100.\nG65P8482B123.456D16.F100.");
    CHECK(std::abs(v.at(532) - 29.988) < exact);
    CHECK(std::abs(v.at(533) - 19.976) < exact);
    CHECK(std::abs(v.at(136) - 0.03) < exact);
    const double reach = 18.0 - 0.0;
    CHECK(std::abs(v.at(135) - (2.0 * std::sqrt(reach * reach - 0.04 * 0.04) - 20.0)) < exact);
}

TEST_CASE("a Z axis that is too long lengthens tools by what they are longer than the pin") {
    // The gauge point stands at 30 + length: the axis counts that divided by 1 + s.
    const double s = 200e-6;
    const auto v = measured(mill("errors.EZZ_mm = { slope = 200e-6 }\n"), "G65P8481B123.F100.");
    CHECK(std::abs(v.at(135) - (100.0 + 23.456 / (1.0 + s))) < exact);
}

TEST_CASE("what was measured is set: the tip stands where the program says") {
    const emulator::RunLog log =
        log_of(mill(), "G65P8481B123.H5F100.\nM4S800\nG65P8482B123.456D16.H5F100.");
    REQUIRE_FALSE(log.result.alarm);
    CHECK(std::abs(log.stores.tools.tool[5].length_mm() - 123.456) < exact);
    CHECK(std::abs(log.stores.tools.tool[5].radius_mm() - 8.05) < exact);
}

TEST_CASE("a tool out of tolerance stops with an alarm and sets nothing") {
    const emulator::RunLog log = log_of(mill(), "G65P8481B123.C0.1H5F100.");
    REQUIRE(log.result.alarm);
    CHECK(log.result.alarm->number == 3103);
    CHECK(log.stores.tools.tool[5].length_mm() == 120.0);
}

TEST_CASE("a block without [tools] is felt by no tool, and tools are written as they were read") {
    const setup::Setup s = mill();
    std::vector<std::string> notes;
    const setup::Setup again = setup::parse_setup(setup::format_setup(s), "t.toml", notes);
    CHECK(again.tools == s.tools);
    CHECK(again.bodies == s.bodies);
    for (const char* wrong : {"0 = { length_mm = 1, diameter_mm = 1 }\n", "1 = { length_mm = 1 }\n",
                              "1 = { length_mm = -1, diameter_mm = 1 }\n",
                              "1 = { length_mm = 1, diameter_mm = 1, runout_mm = [1] }\n"})
        CHECK_THROWS_AS(
            setup::parse_setup(std::string("[machine]\nchain = \"w b X Y Z t\"\n[tools]\n") + wrong,
                               "t", notes),
            InputError);
}

}  // namespace trunnion
