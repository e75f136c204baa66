// Keys of [control] that steer a run: clamps, block skip, generation, and backups as G10 programs.
#include <catch2/catch.hpp>

#include "backup/control_files.h"
#include "base/alarm.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

using namespace trunnion;

namespace {

setup::Setup setup_with(const std::string& control) {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "schema = \"trunnion.setup/1\"\n[machine]\nname = \"t\"\n"
        "chain = \"w C B b X Y Z t\"\n"
        "axis.B = { direction = [0, -1, 0], point_mm = [0, 0, 0] }\n"
        "axis.C = { direction = [0, 0, -1], point_mm = [0, 0, 0] }\n"
        "axis.X = { direction = [1, 0, 0] }\naxis.Y = { direction = [0, 1, 0] }\n"
        "axis.Z = { direction = [0, 0, 1] }\n[control]\n" +
            control,
        "t.toml", notes);
}

emulator::RunLog run_text(const setup::Setup& setup, const std::string& text) {
    interpreter::ProgramFolders none({});
    return emulator::run_program(setup, none, interpreter::ProgramText{"t.nc", text, nullptr}, {});
}

}  // namespace

TEST_CASE("a clamped axis alarms when the setup says so") {
    const std::string program = "G90G21\nM68\nG0C10.\nM30\n";
    const setup::Setup strict =
        setup_with("clamps.C = { clamp = 68, release = 69, alarm = true }\n");
    const emulator::RunLog log = run_text(strict, program);
    REQUIRE(log.result.alarm);
    CHECK(log.result.alarm->where.line == 3);
    CHECK(run_text(strict, "G90G21\nM68\nM69\nG0C10.\nM30\n").result.status ==
          controller::RunStatus::ok);
    const setup::Setup lenient =
        setup_with("clamps.C = { clamp = 68, release = 69, alarm = false }\n");
    CHECK(run_text(lenient, program).result.status == controller::RunStatus::ok);
    CHECK_THROWS_AS(setup_with("clamps.A = { clamp = 10 }\n"), InputError);
    CHECK_THROWS_AS(setup_with("clamps.C = { clamp = 1000 }\n"), InputError);
}

TEST_CASE("block skip switches and generation come from the setup") {
    const std::string program = "#100=1\n/#100=2\n/3#101=5\nM30\n";
    CHECK(run_text(setup_with(""), program).variables.at(100) == 2.0);
    const emulator::RunLog skipped = run_text(setup_with("block_skip = [1]\n"), program);
    CHECK(skipped.variables.at(100) == 1.0);
    CHECK(skipped.variables.at(101) == 5.0);
    CHECK_THROWS_AS(setup_with("block_skip = [10]\n"), InputError);
    CHECK(setup_with("generation = \"16i\"\n").dialect.macro_call_levels <
          setup_with("").dialect.macro_call_levels);
    CHECK_THROWS_AS(setup_with("generation = \"35i\"\n"), InputError);
}

TEST_CASE("whether #5043 includes the tool length is a switch of the setup") {
    const std::string program = "G90G21\nG43Z10.H1\n#100=#5043-#5003\nM30\n";
    const std::string tools = "tools.1 = { length_mm = 50 }\n";
    CHECK(run_text(setup_with(tools), program).variables.at(100) == 50.0);
    const std::string off = "work_positions_with_length = false\n";
    CHECK(run_text(setup_with(off + tools), program).variables.at(100) == 0.0);
    CHECK_THROWS_AS(setup_with("work_positions_with_length = 1\n"), InputError);
}

TEST_CASE("the group of the work offset is a switch of the setup") {
    const std::string program = "G55\n#100=#4012\n#101=#4014\nM30\n";
    const auto usual = run_text(setup_with(""), program).variables;
    CHECK(usual.at(100) == 67.0);
    CHECK(usual.at(101) == 55.0);
    const setup::Setup other = setup_with("work_offset_is_group_12 = true\n");
    const auto exchanged = run_text(other, program).variables;
    CHECK(exchanged.at(100) == 55.0);
    CHECK(exchanged.at(101) == 67.0);
    std::vector<std::string> notes;
    CHECK(setup::parse_setup(setup::format_setup(other), "t.toml", notes).work_offset_is_group_12);
}

TEST_CASE("control keys survive a formatted setup") {
    const setup::Setup first = setup_with(
        "generation = \"0i-F\"\nblock_skip = [1, 4]\nclamps.C = { clamp = 68, release = 69, alarm "
        "= false }\n");
    std::vector<std::string> notes;
    const setup::Setup again = setup::parse_setup(setup::format_setup(first), "t.toml", notes);
    CHECK(again.dialect.generation == interpreter::ControlGeneration::fanuc_0i_f);
    CHECK(again.block_skip == std::vector<int>{1, 4});
    REQUIRE(again.clamps.size() == 1);
    CHECK(again.clamps[0].m_release == 69);
    CHECK_FALSE(again.clamps[0].alarm);
}

TEST_CASE("a builder's codes and variables, and G33 where the control has it") {
    const std::string keys =
        "threading = true\nbuilder = { g_codes = [313.5], m_codes = [60], m_codes_after = [62], "
        "variables = [[150000, 150010]] }\n";
    std::vector<std::string> notes;
    const setup::Setup setup =
        setup::parse_setup(setup::format_setup(setup_with(keys)), "t.toml", notes);
    const std::string program =
        "G21G90S600M3\nG33Z-10.F1.5\nG313.5\nM60\nM62\n#150003=#150004\nIF[#150004EQ#0]THEN"
        "#100=1\n#150003=4.5\n#101=#150003\nM30\n";
    const emulator::RunLog log = run_text(setup, program);
    REQUIRE_FALSE(log.result.alarm);
    CHECK(log.variables.at(100) == 1.0);
    CHECK(log.variables.at(101) == 4.5);
    CHECK(log.result.time_s == Approx(10.0 / 1.5 * 60 / 600).epsilon(0.05));
    for (const std::string& note : log.notes) CHECK(note.find("M6") == std::string::npos);
    CHECK(run_text(setup_with(""), program).result.alarm->number == 10);
    CHECK_THROWS_AS(setup_with("builder = { g_codes = [1] }\n"), InputError);
    CHECK_THROWS_AS(setup_with("builder = { variables = [[5, 2000]] }\n"), InputError);
}

TEST_CASE("G53 under G91 moves where the setup says so, and the setup is written so") {
    const std::string program = "G21G90G0X5.\nG91G53X2.\n#100=#5021\nM30\n";
    const setup::Setup first = setup_with("g53_under_g91_moves = true\n");
    std::vector<std::string> notes;
    const setup::Setup again = setup::parse_setup(setup::format_setup(first), "t.toml", notes);
    CHECK(run_text(again, program).variables.at(100) == 7.0);
    CHECK(run_text(setup_with(""), program).variables.at(100) == 5.0);
}

TEST_CASE("rapids are doglegs where the setup says so, and the setup is written so") {
    const setup::Setup first = setup_with("rapids_are_doglegs = true\n");
    std::vector<std::string> notes;
    const setup::Setup again = setup::parse_setup(setup::format_setup(first), "t.toml", notes);
    CHECK(again.rapids_are_doglegs);
    CHECK(!setup_with("").rapids_are_doglegs);
}

TEST_CASE("a variable in a position word is rounded where the setup says so, digits are not") {
    struct Case {
        const char* name;
        double mm, inch, deg;  ///< increments; 0: none
    };
    for (const Case& c : {Case{"none", 0.0, 0.0, 0.0},
                          {"IS-A", 0.01, 0.001, 0.01},
                          {"IS-B", 0.001, 0.0001, 0.001},
                          {"IS-C", 1e-4, 1e-5, 1e-4}}) {
        INFO(c.name);
        const auto to = [](double value, double step) {
            return step > 0.0 ? step * std::round(value / step) : value;
        };
        std::vector<std::string> notes;
        const setup::Setup first =
            setup_with("variable_rounding = \"" + std::string(c.name) + "\"\n");
        const setup::Setup again = setup::parse_setup(setup::format_setup(first), "t.toml", notes);
        const auto v = run_text(again,
                                "G21G90\n#1=200./7.\nG0X#1Y-#1Z[#1]C#1\n#101=#5021\n#102=#5022\n"
                                "#103=#5023\n#104=#5025\nX12.34567\n#105=#5021\n"
                                "G91X[1./3.]\nX[1./3.]\n#106=#5021\nG90G20\nX[2./7.]C[50./7.]\n"
                                "#107=#5021\n#108=#5025\nM30\n")
                           .variables;
        CHECK(v.at(101) == Approx(to(200.0 / 7, c.mm)).margin(1e-9));
        CHECK(v.at(102) == Approx(-to(200.0 / 7, c.mm)).margin(1e-9));
        CHECK(v.at(103) == Approx(to(200.0 / 7, c.mm)).margin(1e-9));
        CHECK(v.at(104) == Approx(to(200.0 / 7, c.deg)).margin(1e-9));
        CHECK(v.at(105) == Approx(12.34567).margin(1e-9));
        CHECK(v.at(106) == Approx(12.34567 + 2.0 * to(1.0 / 3, c.mm)).margin(1e-9));
        CHECK(v.at(107) == Approx(to(2.0 / 7, c.inch)).margin(1e-9));
        CHECK(v.at(108) == Approx(to(50.0 / 7, c.deg)).margin(1e-9));
    }
    CHECK_THROWS_AS(setup_with("variable_rounding = \"IS-D\"\n"), InputError);
    CHECK_THROWS_AS(setup_with("variable_rounding = true\n"), InputError);
}

TEST_CASE("centres, radii and depths are rounded; values of a call, feed and numbers are not") {
    const std::string program =
        "G21G90G17X0Y0Z10.\n#1=10./3.\nG2X[2.*#1]Y0I#1J0F100.\n#101=#5021\n"
        "G83Z-#1R#1Q#1\n#102=#5023\nG80\nF#1\n#103=#4109\nG65P1A#1X#1\nM30\n"
        "O1\n#104=#1\n#105=#24\nM99\n";
    const auto v =
        run_text(setup_with("variable_rounding = \"IS-A\"\n[control.parameters]\n3410 = 0.0\n"),
                 program)
            .variables;
    CHECK(v.at(101) == Approx(6.67).margin(1e-9));
    CHECK(v.at(103) == Approx(10.0 / 3).margin(1e-9));
}

TEST_CASE("axis words beside a builder's G code are its own, unless the block has a motion code") {
    const setup::Setup setup = setup_with("builder = { g_codes = [313] }\n");
    const auto x_after = [&](const std::string& block) {
        return run_text(setup, "G21G90G1X1.F100.\n" + block + "\n#100=#5041\nM30\n")
            .variables.at(100);
    };
    CHECK(x_after("G313X5.Y2.") == 1.0);
    CHECK(x_after("G313G1X5.") == 5.0);
    CHECK(x_after("G0X3.G313") == 3.0);
    CHECK(x_after("G313\nX7.") == 7.0);
}

TEST_CASE("running a backup's G10 files gives the stores that loading them gives") {
    backup::ControlBackup backup{"stick", {}};
    backup.files["EXT_WKZ.TXT"] =
        "%\nG90\nG10L2P0X1.0Y0.5Z0.0B0.0C0.0\nG10L2P1X-100.5Y2.0Z-250.125B0.0C12.5\n"
        "G10L2P6X6.0Y5.0Z4.0B3.0C2.0\nG10L20P3X1.0Y2.0Z3.0B4.0C5.0\nM02\n%\n";
    backup.files["TOOLOFST.TXT"] =
        "%\nG10G90L10P1R185.676\nG10G90L11P1R-0.01\nG10G90L12P1R3.0\nG10G90L13P1R0.002\nM02\n%\n";
    const setup::Setup setup = setup_with("");
    offsets::Stores loaded = setup.stores;
    backup::apply_backup(backup, loaded);
    const offsets::Stores work = run_text(setup, backup.files["EXT_WKZ.TXT"]).stores;
    CHECK(work.work.external == loaded.work.external);
    CHECK(work.work.standard == loaded.work.standard);
    CHECK(work.work.additional == loaded.work.additional);
    const emulator::RunLog tools = run_text(setup, backup.files["TOOLOFST.TXT"]);
    REQUIRE(tools.result.status == controller::RunStatus::ok);
    CHECK(tools.stores.tools.tool[1].length_mm() == loaded.tools.tool[1].length_mm());
    CHECK(tools.stores.tools.tool[1].radius_mm() == loaded.tools.tool[1].radius_mm());
    CHECK(loaded.tools.tool[1].length_wear_mm == -0.01);
}

TEST_CASE("pivots of an inch machine are typed in inches and kept in mm") {
    const std::string pivots = "19700 = 0.5\n19705 = -2.0\n19680 = 12\n5114 = 3\n";
    const setup::Setup metric = setup_with("[control.parameters]\n" + pivots);
    CHECK(metric.stores.parameters.get(19700) == 0.5);
    // 1001 may stand behind what it rules; 0000#2 (the unit of programs) rules nothing here.
    const setup::Setup inch =
        setup_with("[control.parameters]\n" + pivots + "1001 = \"00000001\"\n");
    CHECK(inch.stores.parameters.get(19700) == Approx(12.7));
    CHECK(inch.stores.parameters.get(19705) == Approx(-50.8));
    CHECK(inch.stores.parameters.get(19680) == 12);
    CHECK(inch.stores.parameters.get(5114) == 3);
    const setup::Setup typed = setup_with("[control.parameters]\n" + pivots + "0 = \"00000100\"\n");
    CHECK(typed.stores.parameters.get(19700) == 0.5);
    std::vector<std::string> notes;
    const setup::Setup again = setup::parse_setup(setup::format_setup(inch), "again.toml", notes);
    CHECK(again.stores.parameters.get(19700) == Approx(12.7).epsilon(1e-15));
    CHECK_THAT(setup::format_setup(inch), Catch::Contains("19700 = 0.5\n"));
    // A program under G20 (also by 0000#2) on the metric machine.
    const emulator::RunLog log = run_text(typed, "G90 G54\nG0 X1.\nM30\n");
    CHECK(log.result.machine[Axis::X] == Approx(25.4));
}
