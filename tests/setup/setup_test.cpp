#include "setup/setup.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "base/alarm.h"
#include "base/units.h"

using namespace trunnion;

namespace {

const std::string axes = R"([machine.axis.B]
direction = [0, -2, 0]
point_mm  = [1, 2, 3]
limits_deg = [-110, 110]
max_deg_min = 9000
[machine.axis.C]
direction = [0, 0, -1]
point_mm  = [1, 2, 40]
)";
const std::string head =
    "schema = \"trunnion.setup/1\"\n[machine]\nname = \"m\"\nchain = \"w C B b X Y Z t\"\n";
const std::string sided = head + "side = { C = \"-\", X = \"+\" }\n";

setup::Setup read(const std::string& text, std::vector<std::string>* notes = nullptr) {
    std::vector<std::string> own;
    return setup::parse_setup(text, "s.toml", notes ? *notes : own);
}

void check_fault(const std::string& text, const std::string& part, int line) {
    INFO(text);
    try {
        read(text);
        FAIL("no error");
    } catch (const InputError& error) {
        CHECK_THAT(error.message, Catch::Contains(part));
        CHECK(error.where.program == "s.toml");
        CHECK(error.where.line == line);
        CHECK(error.where.column > 0);
        CHECK_FALSE(error.line_text.empty());
    }
}

const std::string everything = sided + axes + R"(
[machine.axis.X]
direction = [1, 0, 0]
limits_mm = [-400, 400]
max_mm_min = 36000
accel_mm_s2 = 4000
encoder = "scale"
[machine.errors]
EX0C_mm = 0.012
EA0C_rad = 2.0e-5
EC0Y_rad = 1e-5
EXX_mm = { at_mm = [-300, 0, 300], value = [0.003, 0, -0.002], interpolation = "cubic" }
EYX_mm = { constant = 0.001, slope = 1e-5, harmonics = [[1, 0.002, 0.001]], period_mm = 10 }
EBC_rad = { harmonics = [[2, 1e-5, 2e-5]], at_deg = [0, 180], value = [0, 1e-5] }
EA0S_rad = 1e-5
EXS_mm = { constant = 0.001, harmonics = [[1, 0.002, 0.003]] }
EZS_mm = 0.004
[effects]
"C.backlash" = { gap_rad = 6.0e-5 }
"pivot.g54" = { dg_mm = [0.1, 0.2, 0.3] }
[control]
dialect = "hurco"
[control.work_offsets]
G54 = { X = -100.0, Z = -250.5, B = 30 }
"G54.1 P300" = { Y = 7 }
external = { X = 1 }
[control.fixture_offsets]
P1 = { X = 10, reference = { B = 90, C = 45 } }
[control.parameters]
19700 = 1.5
6004 = "00000101"
1320 = { X = 400, C = 99999 }
7000 = [1, "00000011"]
[control.tools]
1 = { length_mm = 150.0, diameter_mm = 6.0, length_wear_mm = -0.01 }
[control.variables]
500 = 3.5
[control.signals]
1000 = 1
[probe]
tool = 1
tip_mm = [0.1, 0, -150]
pretravel_um = 3
[ballbar]
length_mm = 100.01
free = ["cup", "length"]
sample_hz = 250
[[artefact]]
name = "S1"
kind = "sphere"
center_mm = [120, 0, 80]
free = ["center"]
[[artefact]]
name = "P1"
kind = "center_pivot"
center_mm = [1, 2, 3]
[[artefact]]
name = "R1"
kind = "target"
tool_mm = [0, 0, -150]
free = ["tool"]
[[artefact]]
name = "R2"
kind = "target"
center_mm = [7, 8, 9]
[[instrument]]
name = "tracker"
frame = "W"
origin_mm = [1000, 0, 0]
rotation_deg = [0, 0, 90]
free = ["pose", "scale"]
[model]
modelled = ["location", "C.backlash"]
noise_um = { sphere = 0.8, ballbar = 0.3, linear = 0.1 }
noise_urad = { angle = 2 }
[model.calibration]
EX0C = { value_mm = 0.012, sigma_mm = 0.001 }
)";

}  // namespace

TEST_CASE("every key of the contract arrives") {
    std::vector<std::string> notes;
    const setup::Setup s = read(everything, &notes);
    CHECK(s.machine.chain.find(Axis::B)->direction == Vector3(0, -1, 0));
    CHECK(*s.machine.chain.find(Axis::B)->max == rad_from_deg(110));
    CHECK(*s.machine.chain.find(Axis::B)->max_speed == Approx(rad_from_deg(150)));
    CHECK(*s.machine.chain.find(Axis::X)->max_acceleration == 4000);
    CHECK(s.machine.errors.location({'X', true, Axis::C}) == 0.012);
    const auto& of_x = s.machine.errors.axis[index_of(Axis::X)].motion;
    CHECK(of_x[0](300.0) == -0.002);
    CHECK(of_x[0].interpolation == kinematics::ErrorCurve::Interpolation::cubic);
    CHECK(of_x[1](2.5) == Approx(0.001 + 2.5e-5 + 0.001));
    CHECK(s.machine.errors.axis[index_of(Axis::C)].motion[4](pi) == Approx(2e-5));
    CHECK(s.machine.errors.spindle.location[3] == 1e-5);
    CHECK(s.machine.errors.spindle.motion[0](pi / 2) == Approx(0.004));
    CHECK(s.machine.errors.spindle.motion[2](1.0) == 0.004);
    REQUIRE(s.effects.size() == 3);
    CHECK(s.effects[0].name == "probe.radius");  // pretravel_um = 3
    CHECK(s.effects[0].parameters.at("radius_mm") == std::vector<double>{-0.003});
    CHECK(s.effects[1].name == "C.backlash");
    CHECK(s.effects[2].parameters.at("dg_mm") == std::vector<double>{0.1, 0.2, 0.3});
    CHECK(s.dialect.family == interpreter::DialectFamily::hurco);
    CHECK(s.stores.work.standard[0][Axis::Z] == -250.5);
    CHECK(s.stores.work.standard[0][Axis::B] == 30);
    CHECK(s.stores.work.additional[299][Axis::Y] == 7);
    CHECK(s.stores.work.external[Axis::X] == 1);
    CHECK(s.stores.fixture.set[0].reference_angles[Axis::C] == 45);
    CHECK(s.stores.parameters.get(19700) == 1.5);
    CHECK(s.stores.parameters.get(6004) == 5);
    CHECK(s.stores.parameters.entry.at(1320).by_axis.at(5) == 99999);  // X Y Z B C
    CHECK(s.stores.parameters.entry.at(7000).by_axis.at(2) == 3);
    CHECK(s.stores.tools.tool[1].length_mm() == 149.99);
    CHECK(s.stores.tools.tool[1].radius_mm() == 3);
    CHECK(s.stores.variables.at(500) == 3.5);
    CHECK(s.stores.signals.at(1000) == 1);
    CHECK(s.ballbar->free_length);
    CHECK(s.ballbar->sample_hz == 250);
    REQUIRE(s.find_artefact("P1"));
    CHECK(s.find_artefact("P1")->kind == setup::Artefact::Kind::center_pivot);
    CHECK(s.find_artefact("S1")->free_center);
    CHECK(s.side_before[index_of(Axis::C)] == -1);
    CHECK(s.side_before[index_of(Axis::Y)] == 1);
    CHECK(s.scale_encoder[index_of(Axis::X)]);
    CHECK_FALSE(s.scale_encoder[index_of(Axis::Y)]);
    CHECK(s.find_artefact("R1")->kind == setup::Artefact::Kind::target);
    CHECK(*s.find_artefact("R1")->tool_S_mm == Vector3(0, 0, -150));
    CHECK(s.find_artefact("R1")->free_tool);
    CHECK_FALSE(s.find_artefact("R2")->tool_S_mm);
    REQUIRE(s.find_instrument("tracker"));
    CHECK(s.find_instrument("tracker")->free_scale);
    CHECK(s.find_instrument("tracker")->sees_table);
    // M's X axis is the instrument's Y.
    const Vector3 seen = s.find_instrument("tracker")->pose_IM() * Vector3(2, 0, 5);
    CHECK((seen - Vector3(1000, 2, 5)).norm() < 1e-12);
    CHECK(s.model.noise_um.at("linear") == 0.1);
    CHECK(s.model.noise_urad.at("angle") == 2);
    CHECK(s.model.modelled.size() == 2);
    CHECK(s.model.noise_um.at("ballbar") == 0.3);
    CHECK(s.model.calibration.at("EX0C").sigma == 0.001);
}

TEST_CASE("absent pivot parameters are those of the machine, and counted") {
    std::vector<std::string> notes;
    const setup::Setup s = read(everything, &notes);
    CHECK(s.stores.parameters.get(19700) == 1.5);  // the file's own stays
    CHECK(s.stores.parameters.get(19701) == 2);
    CHECK(s.stores.parameters.get(19705) == 37);
    CHECK(s.stores.parameters.get(19680) == 12);
    CHECK(notes.empty());
    CHECK(s.derived_parameters > 0);
    CHECK(read(setup::format_setup(s)).derived_parameters == 0);  // all of them are written
}

TEST_CASE("unknown keys are noted with their place") {
    std::vector<std::string> notes;
    read(head + "colour = \"red\"\n" + axes + "odd = 1\n[probe]\nshape = 3\n", &notes);
    REQUIRE(notes.size() == 3);
    CHECK_THAT(notes[0], Catch::Contains("s.toml:5:") && Catch::Contains("machine.colour"));
    CHECK_THAT(notes[1], Catch::Contains("machine.axis.C.odd"));
    CHECK_THAT(notes[2], Catch::Contains("probe.shape"));
}

TEST_CASE("a formatted setup loads again to the same value") {
    const auto same = [](const std::string& text, const std::string& path) {
        std::vector<std::string> notes;
        const setup::Setup first = setup::parse_setup(text, path, notes);
        const std::string once = setup::format_setup(first);
        notes.clear();
        const setup::Setup second = setup::parse_setup(once, path, notes);
        INFO(once);
        CHECK(notes.empty());
        CHECK(setup::format_setup(second) == once);
        for (const kinematics::AxisGeometry& axis : first.machine.chain.axes()) {
            const kinematics::AxisGeometry& other = *second.machine.chain.find(axis.axis);
            CHECK(axis.direction == other.direction);
            CHECK(axis.min == other.min);
            CHECK(axis.max_speed == other.max_speed);
            CHECK(axis.max_acceleration == other.max_acceleration);
        }
        AxisPositions q;
        q.value = {10, 20, 30, 0.1, 0.2, 0.3, 0, 0, 5};
        CHECK(first.machine.tip_W(q, Vector3(1, 2, 3)) ==
              second.machine.tip_W(q, Vector3(1, 2, 3)));
        CHECK(first.stores.work.standard == second.stores.work.standard);
    };
    same(everything, "s.toml");
}

TEST_CASE("the machines that ship load, and format to themselves") {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(TRUNNION_SOURCE_DIR "/machines")) {
        if (entry.path().extension() != ".toml") continue;
        INFO(entry.path());
        std::vector<std::string> notes, again;
        const setup::Setup setup = setup::load_setup(entry.path().string(), notes);
        for (const std::string& note : notes) CHECK_THAT(note, Catch::Contains("derived"));
        CHECK(setup::format_setup(setup::parse_setup(setup::format_setup(setup), "x", again)) ==
              setup::format_setup(setup));
        CHECK(again.empty());
        ++count;
    }
    CHECK(count >= 7);
}

TEST_CASE("every setup that ships, and every one that is written, states tcp_frame") {
    const std::regex stated("\n\\[control\\]\n([^\\[]*\n)?tcp_frame = \"(start|rotary_zero)\"\n");
    int machines = 0;
    for (const auto& entry : std::filesystem::directory_iterator(TRUNNION_SOURCE_DIR "/machines")) {
        CAPTURE(entry.path().string());
        std::ostringstream text;
        text << std::ifstream(entry.path()).rdbuf();
        CHECK(std::regex_search(text.str(), stated));
        std::vector<std::string> notes;
        setup::Setup setup = setup::load_setup(entry.path().string(), notes);
        CHECK(setup.tcp_frame == positioning::TcpFrame::start);
        std::smatch found;
        const std::string start = setup::format_setup(setup);
        REQUIRE(std::regex_search(start, found, stated));
        CHECK(found[2] == "start");
        setup.tcp_frame = positioning::TcpFrame::rotary_zero;
        const std::string zero = setup::format_setup(setup);
        REQUIRE(std::regex_search(zero, found, stated));
        CHECK(found[2] == "rotary_zero");
        ++machines;
    }
    CHECK(machines >= 10);
}

TEST_CASE("a bad setup names its place") {
    check_fault("a = = 1\n", "", 1);
    check_fault("schema = \"x\"\n", "trunnion.setup/1", 1);
    check_fault("x = 1\n", "[machine] is missing", 1);
    check_fault("[machine]\nname = \"m\"\n", "no chain", 1);
    check_fault("[machine]\nchain = \"w Q b t\"\n", "axis Q has no direction", 2);
    check_fault(head, "rotary axis B has no point_mm", 4);
    check_fault(head + "[machine.axis.B]\ndirection=[0,1,0]\n[machine.axis.C]\npoint_mm=[0,0,0]\n",
                "rotary axis B has no point_mm", 5);
    check_fault(head + axes + "[machine.axis.A]\npoint_mm=[0,0,0]\n", "does not stand in the chain",
                13);
    check_fault(head + axes + "[machine.axis.X]\ndirection=[0,0]\n", "three numbers", 14);
    check_fault(head + axes + "[machine.axis.X]\ndirection=[0,0,0]\n", "zero vector", 14);
    check_fault(head + axes + "limits_deg = [5, 5]\n", "two rising", 13);
    check_fault(head + axes + "[machine.errors]\nEX0C = 1\n", "unit of EX0C is _mm", 14);
    check_fault(head + axes + "[machine.errors]\nEA0C_mm = 1\n", "unit of EA0C is _rad", 14);
    check_fault(head + axes + "[machine.errors]\nEQC_mm = 1\n", "not an error of ISO 230", 14);
    check_fault(head + axes + "[machine.errors]\nEX0A_mm = 1\n", "no axis A", 14);
    check_fault(head + axes + "[machine.errors]\nEX0C_mm = nan\n", "finite", 14);
    check_fault(head + axes + "[machine.errors]\nEXX_mm = { at_mm = [0, 0], value = [1, 2] }\n",
                "rise", 14);
    check_fault(head + axes + "[machine.errors]\nEXX_mm = { at_mm = [0], value = [1, 2] }\n",
                "same length", 14);
    check_fault(head + axes + "[machine.errors]\nEXX_mm = { harmonics = [[1, 2, 3]] }\n",
                "period_mm", 14);
    check_fault(head + axes + "[control]\ndialect = \"abc\"\n", "dialect is", 14);
    check_fault(head + axes + "[control.work_offsets]\nG60 = { X = 1 }\n", "G54", 14);
    check_fault(head + axes + "[control.parameters]\n6004 = \"0011\"\n", "eight", 14);
    check_fault(head + axes + "[control.parameters]\nabc = 1\n", "parameter number", 14);
    check_fault(head + axes + "[control]\nbackup = \"dir\"\n", "backups", 14);
    check_fault(head + axes + "[[artefact]]\nname = \"a\"\n", "center_mm", 13);
    check_fault(
        head + axes + "[[artefact]]\nname = \"a\"\ncenter_mm=[0,0,0]\n[[artefact]]\nname = \"a\"\n",
        "two artefacts", 17);
    const std::string target = head + axes + "[[artefact]]\nname = \"a\"\nkind = \"target\"\n";
    check_fault(target, "no tool_mm", 13);
    check_fault(target + "tool_mm=[0,0,0]\ncenter_mm=[0,0,0]\n", "not both", 16);
    check_fault(target + "tool_mm=[0,0,0]\nfree=[\"center\"]\n", "cannot be free", 17);
    check_fault(head + axes + "[[instrument]]\nfree = []\n", "no name", 13);
    check_fault(head + axes + "[[instrument]]\nname=\"T\"\nfree = [\"zero\"]\n", "cannot be free",
                15);
    check_fault(head + "side = { A = \"-\" }\n" + axes, "axis A does not stand", 5);
    check_fault(head + "side = { C = \"left\" }\n" + axes, "a side is", 5);
    check_fault(head + axes + "encoder = \"ruler\"\n", "encoder is", 13);
    check_fault(head + axes + "[model.calibration]\nEX0C = { value_mm = 1 }\n", "sigma_mm", 14);
}

TEST_CASE("a backup is read before the file's own keys") {
    std::vector<std::string> notes;
    std::string folder;
    const setup::BackupReader reader = [&](const std::string& name, offsets::Stores& stores) {
        folder = name;
        stores.parameters.set(19700, 9.0);
        stores.parameters.set(3410, 0.02);
    };
    const setup::Setup s = setup::parse_setup(
        head + axes + "[control]\nbackup = \"b\"\n[control.parameters]\n19700 = 4\n", "dir/s.toml",
        notes, reader);
    CHECK(folder == "dir/b");
    CHECK(s.stores.parameters.get(19700) == 4);
    CHECK(s.stores.parameters.get(3410) == 0.02);
}

TEST_CASE("names of effects without quotes are told how to write them") {
    const std::string head =
        "[machine]\nchain = \"w C b X Y Z t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n[effects]\n";
    const std::string message = "stands in quotes: \"C.backlash\" = { ... }";
    check_fault(head + "C.backlash = { gap_rad = 1e-5 }\n", message, 7);
    check_fault(head + "C = { backlash = { gap_rad = 1e-5 } }\n", message, 7);
    check_fault(head + "[effects.C.backlash]\ngap_rad = 1e-5\n", message, 7);
    CHECK(read(head + "\"C.backlash\" = { gap_rad = 1e-5 }\n").effects.size() == 1);
    CHECK(read(head + "[effects.\"C.backlash\"]\ngap_rad = 1e-5\n").effects.size() == 1);
}

TEST_CASE("a backlash that depends on the place is a curve beside the effect") {
    const setup::Setup s = read(
        "[machine]\nchain = \"w C b X Y Z t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "backlash_rad = { constant = 1e-5 }\n"
        "[machine.axis.X]\nbacklash_mm = { at_mm = [0, 400], value = [0.004, 0.012] }\n"
        "[effects]\n\"X.backlash\" = { gap_mm = 0.001 }\n");
    REQUIRE(s.effects.size() == 1);
    CHECK(s.gap[index_of(Axis::X)](100.0) == Approx(0.006));
    CHECK(s.gap[index_of(Axis::X)](500.0) == Approx(0.012));
    CHECK(s.gap[index_of(Axis::C)](1.0) == 1e-5);
    CHECK(s.gap[index_of(Axis::Y)].is_zero());
    const std::string text = setup::format_setup(s);
    CHECK_THAT(text, Catch::Contains("backlash_mm = { at_mm = [0, 400]"));
    CHECK(setup::format_setup(read(text)) == text);
}

TEST_CASE("keys for backlash and pretravel are effects") {
    const std::string head =
        "[machine]\nchain = \"w C b X Y Z t\"\nside = { C = \"-\" }\n"
        "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "backlash_rad = 2e-5\n"
        "[machine.axis.X]\nbacklash_mm = 0.004\n[probe]\npretravel_um = 5\n";
    const setup::Setup s = read(head);
    REQUIRE(s.effects.size() == 3);
    CHECK(s.side_before[index_of(Axis::C)] == -1);
    CHECK(s.side_before[index_of(Axis::X)] == 1);
    const std::string text = setup::format_setup(s);
    CHECK_THAT(text, Catch::Contains("\"C.backlash\" = { gap_rad = 2e-05 }") &&
                         Catch::Contains("\"X.backlash\" = { gap_mm = 0.004 }") &&
                         Catch::Contains("\"probe.radius\" = { radius_mm = -0.005 }") &&
                         Catch::Contains("side = { C = \"-\" }"));
    CHECK(setup::format_setup(read(text)) == text);
    check_fault(head + "[effects]\n\"X.backlash\" = { gap_mm = 0.001 }\n", "say it once", 9);
    check_fault(head + "[effects]\n\"probe.radius\" = { delay_s = 1 }\n", "say it once", 11);
}
