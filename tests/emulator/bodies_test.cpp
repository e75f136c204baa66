// The probing programs that ship, on plates, webs, pockets, bores, bosses and corners, against
// closed forms.
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "base/alarm.h"
#include "base/units.h"
#include "effects/settings.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion {

namespace {

/// A mill whose spindle carries a ball of 6 mm; `tip` of the stylus, `body` of the setup.
setup::Setup mill(const std::string& body, const std::string& tip = "[0, 0, -150]",
                  const std::string& errors = "") {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "schema = \"trunnion.setup/1\"\n[machine]\nname = \"t\"\nchain = \"w C B b X Y Z t\"\n"
        "axis.B = { direction = [0, -1, 0], point_mm = [0, 0, 0] }\n"
        "axis.C = { direction = [0, 0, -1], point_mm = [0, 0, 0] }\n"
        "axis.X = { direction = [1, 0, 0] }\naxis.Y = { direction = [0, 1, 0] }\n"
        "axis.Z = { direction = [0, 0, 1] }\n" +
            errors + "[control.tools]\n1 = { length_mm = 150.0 }\n[probe]\ntip_mm = " + tip +
            "\nball_diameter_mm = 6.0\nrepeatability_um = 0.0\n" + body,
        "t.toml", notes);
}

std::string shipped() {
    std::ifstream in(TRUNNION_SOURCE_DIR "/programs/probing/O8410.nc", std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

/// Goes to a place with the length on, calls, and gives #135 and on.
std::map<int, double> probed(const setup::Setup& setup, const std::string& start,
                             const std::string& call) {
    interpreter::ProgramFolders none({});
    const auto text =
        std::make_shared<const std::string>("%\nO1\nG90G21G17G54\nG43H1Z100.\nG0" + start +
                                            "\n#170=3.\n" + call + "\nM30\n" + shipped().substr(2));
    emulator::RunOptions options;
    options.effects = effects::active_models(setup);
    for (int n = 135; n <= 143; ++n) options.wanted_variables.push_back(n);
    const emulator::RunLog log =
        emulator::run_program(setup, none, interpreter::ProgramText{"t.nc", *text, text}, options);
    if (log.result.alarm)
        FAIL_CHECK(log.result.alarm->number << " " << log.result.alarm->text << " line "
                                            << log.result.alarm->where.line);
    return log.variables;
}

constexpr double exact = 1e-6;  // mm, as the issue asks

}  // namespace

TEST_CASE("single surfaces of a block in each direction") {
    const setup::Setup s =
        mill("[[body]]\nname = \"block\"\ncenter_mm = [10, 20, -5]\nsize_mm = [40, 30, 25]\n");
    const auto top = probed(s, "X10.Y20.Z10.", "G65P8411Z-4.5F100.");
    CHECK(std::abs(top.at(137) + 5.0) < exact);
    CHECK(std::abs(top.at(138) + 0.5) < exact);
    const auto right = probed(s, "X50.Y20.\nZ-15.", "G65P8411X30.F100.");
    CHECK(std::abs(right.at(135) - 30.0) < exact);
    const auto front = probed(s, "X10.Y-20.\nZ-15.", "G65P8411Y5.F100.");
    CHECK(std::abs(front.at(136) - 5.0) < exact);
}

TEST_CASE("webs and pockets: middle and width, off the middle") {
    const setup::Setup web =
        mill("[[body]]\nname = \"web\"\ncenter_mm = [10, 20, -5]\nsize_mm = [40.02, 30, 25]\n");
    const auto w = probed(web, "X11.Y19.Z10.", "G65P8412X40.Z-15.F100.");
    CHECK(std::abs(w.at(135) - 10.0) < exact);
    CHECK(std::abs(w.at(138) - 40.02) < exact);
    CHECK(std::abs(w.at(139) - 0.02) < exact);
    const setup::Setup pocket = mill(
        "[[body]]\nname = \"p\"\nkind = \"pocket\"\ncenter_mm = [10, 20, 0]\nsize_mm = [40, 30.01, "
        "25]\n");
    const auto p = probed(pocket, "X11.Y19.\nZ-10.", "G65P8412Y30.F100.");
    CHECK(std::abs(p.at(136) - 20.0) < exact);
    CHECK(std::abs(p.at(138) - 30.01) < exact);
}

TEST_CASE("a ring and a boss: centre and diameter, whatever the start beside the centre") {
    const setup::Setup ring = mill(
        "[[body]]\nname = \"ring\"\nkind = \"ring\"\ncenter_mm = [-30, 40, 0]\ndiameter_mm = "
        "50.003\n");
    const auto r = probed(ring, "X-31.Y41.5\nZ-10.", "G65P8414D50.F100.");
    CHECK(std::abs(r.at(135) + 30.0) < exact);
    CHECK(std::abs(r.at(136) - 40.0) < exact);
    CHECK(std::abs(r.at(138) - 50.003) < exact);
    const setup::Setup boss = mill(
        "[[body]]\nname = \"boss\"\nkind = \"boss\"\ncenter_mm = [-30, 40, 0]\ndiameter_mm = "
        "24.99\n");
    const auto b = probed(boss, "X-29.Y39.5Z15.", "G65P8414D25.Z-8.F100.");
    CHECK(std::abs(b.at(135) + 30.0) < exact);
    CHECK(std::abs(b.at(136) - 40.0) < exact);
    CHECK(std::abs(b.at(138) - 24.99) < exact);
}

TEST_CASE("runout of the stylus shifts the centre, not the diameter") {
    const setup::Setup ring = mill(
        "[[body]]\nname = \"ring\"\nkind = \"ring\"\ncenter_mm = [0, 0, 0]\ndiameter_mm = 50\n",
        "[0.04, -0.03, -150]");
    const auto r = probed(ring, "X0.5Y0.\nZ-10.", "G65P8414D50.F100.");
    CHECK(std::abs(r.at(135) + 0.04) < exact);
    CHECK(std::abs(r.at(136) - 0.03) < exact);
    CHECK(std::abs(r.at(138) - 50.0) < exact);
}

TEST_CASE("a turned block: angle of a face and the corner between two faces") {
    // Turned by 2 deg about its own middle at the origin: half sizes 40 and 30.
    const setup::Setup s = mill(
        "[[body]]\nname = \"b\"\ncenter_mm = [0, 0, 0]\ntilt_deg = [0, 0, 2]\nsize_mm = [80, 60, "
        "20]\n");
    const auto angle = probed(s, "X-15.Y-50.\nZ-10.", "G65P8443Y-30.D30.F100.");
    CHECK(std::abs(angle.at(139) - 2.0) < exact);
    const double c = std::cos(rad_from_deg(2.0)), t = std::sin(rad_from_deg(2.0));
    const auto corner = probed(s, "X-60.Y-50.\nZ-10.", "G65P8416X-39.Y-31.I10.J10.Q15.F100.");
    CHECK(std::abs(corner.at(135) - (-40.0 * c + 30.0 * t)) < exact);
    CHECK(std::abs(corner.at(136) - (-40.0 * t - 30.0 * c)) < exact);
    CHECK(std::abs(corner.at(139) - 2.0) < exact);
}

TEST_CASE("a ring tilted in the table's frame reads as its section does") {
    // Tilted by 3 deg about X: across Y the bore is longer by 1 / cos for the centre of the ball,
    // and the ball touches by its radius along the wall's normal.
    const setup::Setup ring = mill(
        "[[body]]\nname = \"ring\"\nkind = \"ring\"\ncenter_mm = [0, 0, 0]\ntilt_deg = [3, 0, "
        "0]\ndiameter_mm = 50\nheight_mm = 40\n");
    const double c = std::cos(rad_from_deg(3.0));
    const auto y = probed(ring, "X0Y0.\nZ-20.", "G65P8412Y50.F100.");
    CHECK(std::abs(y.at(138) - (44.0 / c + 6.0)) < exact);
}

TEST_CASE("pretravel: bores read larger, bosses smaller, by twice the way") {
    const std::string effect = "[effects]\n\"probe.radius\" = { radius_mm = -0.008 }\n";
    const auto bore = probed(mill("[[body]]\nname = \"r\"\nkind = \"ring\"\ncenter_mm = [0, 0, "
                                  "0]\ndiameter_mm = 50\n" +
                                  effect),
                             "X0.5Y0.3\nZ-10.", "G65P8414D50.F100.");
    CHECK(std::abs(bore.at(138) - 50.016) < exact);
    CHECK(std::abs(bore.at(135)) < exact);
    const auto boss = probed(mill("[[body]]\nname = \"b\"\nkind = \"boss\"\ncenter_mm = [0, 0, "
                                  "0]\ndiameter_mm = 25\n" +
                                  effect),
                             "X0.Y0.Z15.", "G65P8414D25.Z-8.F100.");
    CHECK(std::abs(boss.at(138) - 24.984) < exact);
    const auto top = probed(
        mill("[[body]]\nname = \"b\"\ncenter_mm = [0, 0, -5]\nsize_mm = [40, 30, 25]\n" + effect),
        "X0Y0Z10.", "G65P8411Z-4.5F100.");
    CHECK(std::abs(top.at(137) + 5.008) < exact);
}

TEST_CASE("a lagging drive: a bore reads larger by the gap, a web smaller, the middle is right") {
    // Each touch comes from the side it moves to: the axis stands short by half of 12 um.
    const std::string lag = "axis.X = { direction = [1, 0, 0], backlash_mm = -0.012 }\n";
    const auto with_lag = [&](const std::string& body) {
        std::vector<std::string> notes;
        return setup::parse_setup(
            "schema = \"trunnion.setup/1\"\n[machine]\nchain = \"w b X Y Z "
            "t\"\n" +
                lag +
                "[control.tools]\n1 = { length_mm = 150.0 }\n[probe]\n"
                "tip_mm = [0, 0, -150]\nball_diameter_mm = 6.0\n" +
                body,
            "t.toml", notes);
    };
    const auto bore = probed(with_lag("[[body]]\nname = \"p\"\nkind = \"pocket\"\ncenter_mm = [10, "
                                      "20, 0]\nsize_mm = [40, 30, 25]\n"),
                             "X11.Y19.\nZ-10.", "G65P8412X40.F100.");
    CHECK(std::abs(bore.at(138) - 40.012) < exact);
    CHECK(std::abs(bore.at(135) - 10.0) < exact);
    const auto web = probed(
        with_lag("[[body]]\nname = \"w\"\ncenter_mm = [10, 20, -5]\nsize_mm = [40, 30, 25]\n"),
        "X11.Y19.Z10.", "G65P8412X40.Z-15.F100.");
    CHECK(std::abs(web.at(138) - 39.988) < exact);
    CHECK(std::abs(web.at(135) - 10.0) < exact);
}

TEST_CASE("axes out of square and too long: faces and bores as the machine sees them") {
    // EC0Y leans the way of Y: the tip stands at (x - y sin, y cos). A face across X is met at
    // x + y sin, one across Y at the same y everywhere.
    const double g = 1e-3;
    const setup::Setup leans =
        mill("[[body]]\nname = \"b\"\ncenter_mm = [0, 0, 0]\nsize_mm = [80, 60, 20]\n",
             "[0, 0, -150]", "errors.EC0Y_rad = 1e-3\n");
    const auto corner = probed(leans, "X-60.Y-50.\nZ-10.", "G65P8416X-39.Y-31.I10.J10.Q15.F100.");
    CHECK(std::abs(corner.at(143) - deg_from_rad(std::atan(std::sin(g)))) < exact);
    CHECK(std::abs(corner.at(139)) < exact);
    const double s = 300e-6;
    const setup::Setup longer =
        mill("[[body]]\nname = \"r\"\nkind = \"ring\"\ncenter_mm = [30, 0, 0]\ndiameter_mm = 50\n",
             "[0, 0, -150]", "errors.EXX_mm = { slope = 300e-6 }\n");
    const auto bore = probed(longer, "X30.Y0.\nZ-10.", "G65P8412X50.F100.");
    CHECK(std::abs(bore.at(138) - (44.0 / (1.0 + s) + 6.0)) < exact);
    CHECK(std::abs(bore.at(135) - 30.0 / (1.0 + s)) < exact);
}

TEST_CASE("a protected move stops with an alarm where something stands in the way") {
    const setup::Setup s =
        mill("[[body]]\nname = \"block\"\ncenter_mm = [0, 0, 0]\nsize_mm = [40, 30, 25]\n");
    interpreter::ProgramFolders none({});
    const std::string text =
        "%\nO1\nG90G21G54\nG43H1Z100.\nG65P8410X0Y0Z-5.F500.\nM30\n" + shipped().substr(2);
    const emulator::RunLog log =
        emulator::run_program(s, none, interpreter::ProgramText{"t.nc", text, nullptr}, {});
    REQUIRE(log.result.alarm);
    CHECK(log.result.alarm->number == 3101);
    CHECK(std::abs(log.result.machine[Axis::Z] - 153.0) < exact);
}

TEST_CASE("bodies are written as they were read, and wrong ones refused") {
    const setup::Setup s = mill(
        "[[body]]\nname = \"r\"\nkind = \"ring\"\ncenter_mm = [1, 2, 3]\ntilt_deg = [4, 5, "
        "6]\ndiameter_mm = 40\nwall_mm = 8\n[[body]]\nname = \"p\"\nkind = "
        "\"pocket\"\ncenter_mm = [1, 2, 3]\nsize_mm = [4, 5, 6]\n");
    std::vector<std::string> notes;
    CHECK(setup::parse_setup(setup::format_setup(s), "t.toml", notes).bodies == s.bodies);
    for (const char* wrong : {"kind = \"cone\"\ncenter_mm = [0, 0, 0]\n", "kind = \"boss\"\n",
                              "kind = \"boss\"\ncenter_mm = [0, 0, 0]\nwall_mm = 3\n",
                              "kind = \"block\"\ncenter_mm = [0, 0, 0]\nsize_mm = [1, 0, 1]\n",
                              "kind = \"ring\"\ncenter_mm = [0, 0, 0]\ndiameter_mm = -1\n"})
        CHECK_THROWS_AS(mill(std::string("[[body]]\nname = \"x\"\n") + wrong), InputError);
}

}  // namespace trunnion
