// A machine with errors and a control that compensates them: nothing is left; with one of the two
// alone the closed form is.
#include <catch2/catch.hpp>
#include <cmath>

#include "effects/settings.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"
#include "setup/control_axes.h"

namespace trunnion {

namespace {

setup::Setup mill(const std::string& machine, const std::string& parameters,
                  std::vector<std::string>& notes) {
    return setup::parse_setup(
        "schema = \"trunnion.setup/1\"\n[machine]\nchain = \"w b X Y Z t\"\n" + machine +
            "[control.tools]\n1 = { length_mm = 150.0 }\n[control.parameters]\n" + parameters +
            "[probe]\ntip_mm = [0, 0, -150]\nball_diameter_mm = 6.0\n"
            "[[artefact]]\nname = \"S\"\ncenter_mm = [0, 0, 0]\ndiameter_mm = 25.4\n",
        "t.toml", notes);
}

/// Values of the touches of the sphere's flanks at, X+15.7 in turn.
std::vector<double> touches(const std::string& machine, const std::string& parameters) {
    std::vector<std::string> notes;
    const setup::Setup s = mill(machine, parameters, notes);
    interpreter::ProgramFolders none({});
    const auto text = std::make_shared<const std::string>(
        "G90G21G54\nG43H1Z50.\nG0X-30.Y0\nZ0\nG31X-15.F100.\nG0X-30.\nZ50.\nX30.\nZ0\n"
        "G31X15.F100.\nG0X30.\nM30\n");
    emulator::RunOptions options;
    options.effects = effects::active_models(s);
    const emulator::RunLog log =
        emulator::run_program(s, none, interpreter::ProgramText{"t.nc", *text, text}, options);
    REQUIRE_FALSE(log.result.alarm);
    std::vector<double> values;
    for (const records::Reading& row : log.readings.rows)
        if (row.device == records::Device::touch) values.push_back(row.value_mm.value_or(NAN));
    return values;
}

const char* const pitch =
    "3620 = { X = 4 }\n3621 = { X = 1 }\n3622 = { X = 8 }\n3624 = { X = 10 }\n10001 = 2\n"
    "10002 = -3\n10003 = 5\n10004 = 4\n10005 = -1\n10006 = 7\n10007 = 0\n10008 = -2\n";
/// Sums of those steps from X-40 to X40 the other way round, mm.
const char* const pitch_error =
    "errors.EXX_mm = { at_mm = [-40, -30, -20, -10, 0, 10, 20, 30, 40], value = [0.008, 0.006, "
    "0.009, 0.004, 0, 0.001, -0.006, -0.006, -0.004] }\n";

}  // namespace

TEST_CASE("1851 takes away the reversal of a drive that lags by as much") {
    const auto plain = touches("", ""),
               both = touches("axis.X = { backlash_mm = -0.012 }\n", "1851 = { X = 12 }\n"),
               lags = touches("axis.X = { backlash_mm = -0.012 }\n", ""),
               ahead = touches("", "1851 = { X = 12 }\n");
    REQUIRE(plain.size() == 2);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(std::abs(both[i] - plain[i]) < 1e-9);
        // The axis stands 6 um short of its word: it is sent further until the ball touches.
        CHECK(std::abs(lags[i] - plain[i] - 0.006) < 1e-9);
        CHECK(std::abs(ahead[i] - plain[i] + 0.006) < 1e-9);
    }
}

TEST_CASE("pitch data take away the positioning table that they were made from") {
    const auto plain = touches("", ""), both = touches(pitch_error, pitch),
               table = touches(pitch_error, ""), data = touches("", pitch);
    REQUIRE(both.size() == 2);
    // The screw has its error where it stands, the control adds its datum where it was sent: what
    // is left is the table's slope times its value, 3.4 and 2.1 nm.
    const double left[] = {5e-4 * 0.00685, 7e-4 * 0.00299};
    for (std::size_t i = 0; i < 2; ++i)
        CHECK(std::abs(std::abs(both[i] - plain[i]) - left[i]) < 1e-8);
    // Contact at: 0.004 + 0.57 * 0.005 by the table; the touch runs towards + and ends
    // early. At X15.7: 0.001 - 0.57 * 0.007, and the touch runs towards -.
    const double error[] = {0.00685, 0.00299};
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(std::abs(table[i] - plain[i] + error[i]) < 1e-5);
        CHECK(std::abs(data[i] - plain[i] - error[i]) < 1e-5);
    }
}

TEST_CASE("a control that compensates what the machine does not have is noted") {
    std::vector<std::string> notes;
    mill("", "1851 = { X = 12 }\n", notes);
    REQUIRE_FALSE(notes.empty());
    CHECK(notes.back().find("compensates backlash or pitch of X") != std::string::npos);
    notes.clear();
    const auto s = mill("axis.X = { backlash_mm = -0.012 }\n", "1851 = { X = 12 }\n", notes);
    for (const std::string& note : notes) CHECK(note.find("compensates") == std::string::npos);
    CHECK(setup::compensated_axes(s).size() == 1);
}

}  // namespace trunnion
