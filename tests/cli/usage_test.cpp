// What every command refuses alike: numbers that are none, files that clash, words nobody knows.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

struct Bench : CommandBench {
    std::string program = write("p.nc", "O1\nG90 G0 X10.\nG1 X20. F100.\nM30\n");
    std::string machine = write("m.toml", setup());
    std::string readings = write("r.csv", "index,time_s,test,device,feature,x_mm,value_mm\n");

    static std::string setup() {
        std::ostringstream text;
        text << std::ifstream(std::string(TRUNNION_SOURCE_DIR) + "/machines/bc_table.toml").rdbuf();
        return text.str();
    }
    /// The shipped setup with one piece replaced, or with text behind it.
    std::string machine_with(const std::string& from, const std::string& to) const {
        std::string text = setup();
        REQUIRE(text.find(from) != std::string::npos);
        return write("changed.toml", text.replace(text.find(from), from.size(), to));
    }
    std::string machine_and(const std::string& more) const {
        return write("changed.toml", setup() + more);
    }
    /// Ends with 2 and says one thing: a line, or a line with its place below.
    void refuses(const std::string& words, const std::string& why) const {
        CAPTURE(words);
        CHECK(trunnion(words) == 2);
        const std::string said = read("err.txt");
        CHECK_THAT(said, Catch::Contains(why));
        const auto errors = [&] {
            int count = 0;
            for (std::size_t at = 0; (at = said.find("error: ", at)) != std::string::npos; ++at)
                ++count;
            return count;
        }();
        CHECK(errors + (said.starts_with("trunnion: ") ? 1 : 0) == 1);
        CHECK(read("out.txt").empty());
    }
};

}  // namespace

TEST_CASE("no option takes a number that is not finite") {
    const Bench bench;
    const std::string p = bench.program, r = bench.readings;
    const std::pair<std::string, std::string> options[] = {
        {"compare " + p + " " + p, "--tol-lin"},
        {"compare " + p + " " + p, "--tol-ang"},
        {"compare " + p + " " + p, "--tol-feed"},
        {"compare " + p + " " + p, "--tol-time"},
        {"compensate " + p, "--tol-um"},
        {"compensate " + p, "--max-turn-deg"},
        {"diagnose " + r, "--limit-um"},
        {"run " + p + " --trace " + bench.file("t.csv"), "--trace-step"},
        {"run " + p + " --trace " + bench.file("t.csv"), "--trace-chord"},
        {"ballbar", "--setup-time"},
        {"ballbar", "--remount-time"},
        {"volumetric", "--length"}};
    for (const auto& [command, option] : options)
        for (const char* number : {"nan", "inf", "-inf", "1e999"})
            bench.refuses(command + " " + option + " " + number, option);
    bench.refuses("ballbar --pivot-offset 1,nan,2", "'nan' is not a finite number");
    bench.refuses("diagnose " + r + " --limit-um -1", "--limit-um: -1 is below 0");
    bench.refuses("volumetric --length -1", "--length: -1 is below 0");
    CHECK_FALSE(fs::exists(bench.file("t.csv")));
}

TEST_CASE("counts have no sign") {
    const Bench bench;
    const std::string run = "run " + bench.program;
    for (const char* command : {"ballbar", "pivot"})
        bench.refuses(std::string(command) + " --seed -1", "--seed: '-1' is not 0, 1, 2");
    bench.refuses(run + " --seed -1", "--seed: '-1'");
    bench.refuses(run + " --seed 99999999999999999999", "--seed: ");
    bench.refuses(run + " --max-blocks -2", "--max-blocks: '-2'");
    bench.refuses("check " + bench.program + " --max-blocks -2", "--max-blocks: '-2'");
    bench.refuses("compare " + bench.program + " " + bench.program + " --threads -1", "--threads");
    bench.refuses(run + " --vars 200-100", "--vars: '200-100' is a descending range");
    bench.refuses(run + " --vars 1000000", "--vars: '1000000' is not a variable number");
    CHECK(bench.trunnion(run + " --vars 900000,999999 --json") == 0);
}

TEST_CASE("a step of the trace is a micrometre or more") {
    const Bench bench;
    const std::string run =
        "run " + bench.program + " --trace " + bench.file("t.csv") + " --trace-step ";
    for (const char* step : {"0", "-1", "1e-9", "0.0009"})
        bench.refuses(run + step, "--trace-step: ");
    CHECK_FALSE(fs::exists(bench.file("t.csv")));
    CHECK(bench.trunnion(run + "0.001") == 0);
}

TEST_CASE("injected numbers are finite") {
    const Bench bench;
    for (const char* text : {"C.backlash=nanurad", "C.backlash: gap_rad=inf", "X.backlash=1e308m",
                             "pivot.g54: dg_mm=[0, nan, 0]"})
        bench.refuses("run " + bench.program + " --inject '" + text + "'", "--inject:1:");
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("not a finite number"));
    bench.refuses("run " + bench.program + " --set '#100=nan'", "--set");
}

TEST_CASE("numbers of a setup are finite, and its mistakes have their place") {
    const Bench bench;
    const std::string run = "run " + bench.program + " --setup ";
    const std::string effects = "\n[effects]\n";
    for (const std::string& bad :
         {bench.machine_and(effects + "\"C.backlash\" = { gap_rad = nan }\n"),
          bench.machine_and(effects + "\"C.backlash\" = { gap_rad = -inf }\n")})
        bench.refuses(run + bad, "changed.toml:");
    const int line = [&] {
        const std::string text = Bench::setup();
        return static_cast<int>(std::count(text.begin(), text.end(), '\n')) + 3;
    }();
    const auto place = [&](int column) {
        return "changed.toml:" + std::to_string(line) + ":" + std::to_string(column) + ": error: ";
    };
    bench.machine_and(effects + "\"C.wobble\" = { gap_rad = 1e-5 }\n");
    bench.refuses(run + bench.file("changed.toml"), place(14) + "no effect is named 'C.wobble'");
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("\"C.wobble\" = {") && Catch::Contains("^"));
    bench.machine_and(effects + "\"C.backlash\" = { gap = 1e-5 }\n");
    bench.refuses(run + bench.file("changed.toml"), place(24) + "effect C.backlash has no");
    bench.machine_and(effects + "\"C.backlash\" = { gap_rad = [1e-5, 2e-5] }\n");
    bench.refuses(run + bench.file("changed.toml"), place(28) + "parameter gap_rad of C.backlash");
}

TEST_CASE("an unknown name in [model] is refused where it stands") {
    const Bench bench;
    const std::string machine =
        bench.machine_with("modelled = [", "modelled = [\"location\", \"C.wobble\"] # [");
    const std::string table =
        bench.write("t.csv",
                    "index,time_s,test,device,feature,x_mm,y_mm,z_mm,b_deg,c_deg,dir_x,"
                    "dir_y,dir_z,value_mm\n1,0,a,sphere,S1,0,0,0,0,0,1,0,0,0.001\n"
                    "2,1,a,sphere,S1,0,0,0,0,9,1,0,0,0.001\n");
    bench.refuses("identify " + table + " --setup " + machine, ":25: error: no effect is named");
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("\"C.wobble\"") && Catch::Contains("^"));
    bench.refuses("identify " + table + " --setup " + bench.machine + " --effects C.wobble",
                  "error: no effect is named");
}

TEST_CASE("an output never overwrites an input or another output") {
    const Bench bench;
    const std::string p = bench.program, m = bench.machine, r = bench.readings;
    const std::string before = bench.read("p.nc");
    fs::create_symlink(p, bench.file("link.nc"));
    const std::pair<std::string, std::string> cases[] = {
        {"run " + p + " --trace " + p, "--trace would overwrite what PROGRAM reads"},
        {"run " + p + " --print " + bench.file("./p.nc"), "--print would overwrite"},
        {"run " + bench.file("link.nc") + " --trace " + p, "--trace would overwrite"},
        {"run " + p + " --setup " + m + " --readings " + m, "--readings would overwrite"},
        {"run " + p + " --trace " + bench.file("x") + " --readings " + bench.file("x"),
         "--trace and --readings would both write this"},
        {"compensate " + p + " --out " + p, "--out would overwrite"},
        {"check " + p + " --out " + p, "--out would overwrite"},
        {"compare " + p + " " + p + " --out " + p, "--out would overwrite"},
        {"merge " + r + " --out " + r, "--out would overwrite"},
        {"identify " + r + " --setup " + m + " --out " + m, "--out would overwrite"},
        {"diagnose " + r + " --setup " + m + " --out " + r, "--out would overwrite"},
        {"diagnose " + r + " --out " + bench.file("x") + " --html " + bench.file("x"),
         "would both write this"},
        {"diagnose " + r + " --json --out -", "together with --json"},
        {"run " + p + " --inject C.backlash", "without a value does nothing"},
        {"ballbar --csv " + bench.file("x") + " --write-readings " + bench.file("x"),
         "would both write this"},
        {"backup save " + bench.path.string() + " " + bench.path.string() + " --setup " + m,
         "OUT would overwrite"}};
    for (const auto& [words, why] : cases) bench.refuses(words, why);
    CHECK(bench.read("p.nc") == before);
    CHECK(bench.read("m.toml") == Bench::setup());
    CHECK_FALSE(fs::exists(bench.file("x")));
}

TEST_CASE("a place that cannot be written is bad input, and nothing stays behind") {
    const Bench bench;
    const std::string p = bench.program;
    fs::create_directories(bench.path / "folder");
    const std::string folder = bench.file("folder");
    bench.refuses("volumetric --grid 2 --rotary-grid 1 --svg " + p, "cannot be made");
    bench.refuses("pivot --svg " + p, "cannot be made");
    bench.refuses("volumetric --grid 2 --rotary-grid 1 --csv " + folder, "is a folder");
    bench.refuses("check " + p + " --out " + folder, "is a folder");
    bench.refuses("compare " + p + " " + p + " --out /nowhere/x", "cannot be written");
    bench.refuses("compensate " + p + " --out " + folder, "is a folder");
    bench.refuses("run " + p + " --trace " + folder, "is a folder");
    bench.refuses("run " + p + " --trace -", "needs a file");
    CHECK_FALSE(fs::exists(folder + ".part"));
    CHECK(bench.trunnion("run " + p + " --trace /dev/null") == 0);
    CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("an output that has no place is refused before the work") {
    const Bench bench;
    const std::string out = bench.file("nowhere/x"), below = bench.program + "/x";
    for (const char* option : {"--trace", "--print", "--readings", "--html"})
        bench.refuses("run " + bench.program + " " + option + " " + out, "there is no folder");
    // The table has no rows: the output is looked at first.
    bench.refuses("identify " + bench.readings + " --setup " + bench.machine + " --out " + out,
                  "there is no folder '" + bench.file("nowhere") + "'");
    bench.refuses("volumetric --grid 50 --rotary-grid 1 --html " + below,
                  "is a file, not a folder");
    bench.refuses("volumetric --grid 50 --rotary-grid 1 --svg " + below, "is a file, not a folder");
    CHECK(bench.trunnion("volumetric --grid 2 --rotary-grid 1 --svg " + bench.file("new") +
                         " --html " + bench.file("new/v.html")) == 0);
    CHECK(fs::exists(bench.file("new/v.html")));
    bench.refuses("run " + bench.program + " --trace a.csv --print ./a.csv",
                  "--trace and --print would both write this");
}

TEST_CASE("what is named wrongly is told by its true reason") {
    const Bench bench;
    bench.refuses("volumetric --grid 2.5", "--grid: '2.5' is not a whole number");
    bench.refuses("backup", "a command is missing: load, save, diff");
    bench.refuses("backup load " + bench.program, "is a file, not a folder");
    bench.refuses("backup load " + bench.file("gone"), "no such folder");
    bench.refuses("run " + bench.file("gone.nc"), "gone.nc: error: no such program");
    const std::string twice = bench.program + " " + bench.program;
    bench.refuses("compare " + twice + " --programs gone", "gone: error: no such program folder");
    bench.refuses("run " + bench.program + " --programs " + bench.program,
                  "is a file, not a program folder");
    bench.refuses("predict " + bench.machine + " --setup " + bench.machine,
                  "this is not a table of readings");
    std::string wide = "\xFF\xFE";
    for (const char c : Bench::setup()) wide += std::string{c, '\0'};
    CHECK(bench.trunnion("run " + bench.program + " --setup " + bench.write("w.toml", wide)) == 0);
    CHECK(bench.trunnion("run " + bench.write("w.nc", std::string("\xFF\xFEO\0001\0", 6))) == 3);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("save a text in UTF-16 as plain text"));
}

TEST_CASE("an unknown command points to the help") {
    const Bench bench;
    bench.refuses("bogus", "there is no command 'bogus' (trunnion --help lists");
    bench.refuses("backup bogus", "there is no command 'bogus'");
    bench.refuses("", "trunnion --help");
    CHECK(bench.trunnion("--help") == 0);
}

TEST_CASE("control characters of an input do not reach the screen") {
    const Bench bench;
    const auto clean = [&] {
        const std::string said = bench.read("err.txt");
        for (const char c : said) {
            const auto byte = static_cast<unsigned char>(c);
            if (byte < 0x20 && byte != '\n' && byte != '\t') return false;
        }
        return !said.empty();
    };
    const std::string junk = "\x1B[2J\x07\xFF";
    CHECK(bench.trunnion("run " + bench.write("a.nc", "O1\nG0 X1. " + junk + "\nM30\n")) == 3);
    CHECK(clean());
    CHECK(bench.trunnion("run " + bench.write("b.nc", "O1\nG0 X9999. (" + junk + ")\nM30\n")) == 3);
    CHECK(clean());
    CHECK(bench.trunnion("run " + bench.program + " --setup " +
                         bench.write("c.toml", "[machine]\nname = \"" + junk + "\"\n")) == 2);
    CHECK(clean());
    CHECK(bench.trunnion("identify " +
                         bench.write("d.csv", "index,time_s,test,device,feature,x_mm,value_mm," +
                                                  junk + "\n1,0,a,sphere,S1,0," + junk + ",0\n") +
                         " --setup " + bench.machine) == 2);
    CHECK(clean());
    CHECK(bench.trunnion(
              "compare " + bench.program + " " +
              bench.write("e.nc", "O1\nG0 X1. (" + junk + ")\n#3000=1(" + junk + ")\nM30\n")) == 3);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("alarm MC3001 ?[2J??") &&
                                          !Catch::Contains("\x1B") && !Catch::Contains("\xFF"));
}

TEST_CASE("linear axes in one plane are refused where they stand") {
    const Bench bench;
    const auto with = [&](const std::string& y) {
        return bench.write("flat.toml",
                           "[machine]\nchain = \"w b X Y Z t\"\n[machine.axis.Y]\n"
                           "direction = " +
                               y + "\n");
    };
    bench.refuses("run " + bench.program + " --setup " + with("[1, 0, 0]"), "flat.toml:3:");
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("in one plane"));
    bench.refuses("volumetric --setup " + with("[-1, 0, 0.001]"), "flat.toml:3:");
    CHECK(bench.trunnion("run " + bench.program + " --setup " + with("[0.1, 1, 0]")) == 0);
}

TEST_CASE("parallel rotary axes make no five-axis kinematics, and it is said why") {
    const Bench bench;
    const std::string machine = bench.write(
        "two.toml",
        "[machine]\nchain = \"w C A b X Y Z t\"\n[machine.axis.A]\ndirection = [0, 0, 1]\n"
        "point_mm = [0, 0, 0]\n[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [9, 0, 0]\n");
    const std::string tcp = bench.write("tcp.nc", "O1\nG90 G43.4 H1\nM30\n");
    CHECK(bench.trunnion("run " + bench.program + " --setup " + machine) == 0);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("rotary axes are parallel"));
    CHECK(bench.trunnion("run " + tcp + " --setup " + machine) == 3);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("tcp.nc:2:5: error: PS5420"));
    for (const char* command : {"ballbar", "pivot"}) {
        CAPTURE(command);
        CHECK(bench.trunnion(std::string(command) + " --setup " + machine) == 2);
    }
}

TEST_CASE("the list of modal codes names G54.2 while it is in force") {
    const Bench bench;
    const auto modal = [&](const std::string& text) {
        REQUIRE(bench.trunnion("run " + bench.write("g.nc", text) + " --json") == 0);
        const Json list = Json::parse(bench.read("out.txt"))["modal"];
        return std::find(list.begin(), list.end(), "G54.2") != list.end();
    };
    CHECK_FALSE(modal("O1\nM30\n"));
    CHECK(modal("O1\nG54.2 P1\nM30\n"));
    CHECK_FALSE(modal("O1\nG54.2 P1\nG54.2 P0\nM30\n"));
}

TEST_CASE("a volumetric map that is interrupted keeps the poses that are done") {
    const Bench bench;
    CHECK(bench.interrupted("volumetric --grid 12 --rotary-grid 30 --csv " + bench.file("v.csv")) ==
          4);
    const std::string map = bench.read("v.csv"), said = bench.read("err.txt");
    const auto poses = std::count(map.begin(), map.end(), '\n') - 1;
    CHECK(map.back() == '\n');
    CHECK(poses > 0);
    CHECK_THAT(said, Catch::Contains("the first " + std::to_string(poses) + " poses") &&
                         !Catch::Contains("\r"));
    CHECK_THAT(bench.read("out.txt"), Catch::Contains(std::to_string(poses) + " poses: rms"));
}
