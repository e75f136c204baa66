#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

using Json = nlohmann::json;

namespace {

struct Bench : CommandBench {
    Bench() { std::filesystem::create_directories(path / "sub"); }
    std::string out() const { return read("out.txt"); }
    /// Exit code of `trunnion check WORDS` in the folder; stdout in out.txt.
    int check(const std::string& words) const {
        const std::string command = "cd " + path.string() + " && " + TRUNNION_BINARY_DIR +
                                    "/bin/trunnion check " + words + " >out.txt 2>err.txt";
        return WEXITSTATUS(std::system(command.c_str()));
    }
};

}  // namespace

TEST_CASE("check: exit codes, folders, subprograms beside the file, --run") {
    const Bench bench;
    bench.write("good.nc", "O1\nG17 G90 G0 X1.\nM98 P9001\nM30\n");
    bench.write("sub/O9001.nc", "O9001\nM99\n");
    bench.write("sub/bad.nc", "O2\nGOTO 50\nM30\n");
    bench.write("far.nc", "O3\nG0 X9000.\nM30\n");
    CHECK(bench.check("good.nc --programs sub") == 0);
    CHECK(bench.read("err.txt").empty());
    CHECK(bench.check("good.nc") == 0);
    CHECK_THAT(bench.read("err.txt"),
               Catch::Contains("O9001 is taken from a subfolder (./sub/O9001.nc)"));
    bench.write("lost.nc", "O1\nG17 G90 G0 X1.\nM98 P9011\nM30\n");
    CHECK(bench.check("lost.nc") == 1);
    CHECK_THAT(bench.out(), Catch::Contains("O9011 is called"));
    CHECK(bench.check("sub") == 1);
    CHECK_THAT(bench.out(), Catch::Contains("bad.nc:2:1") && Catch::Contains("in 2 files"));
    CHECK(bench.check("far.nc") == 1);  // beyond the stroke of the default machine
    CHECK(bench.check("far.nc --run") == 1);
    CHECK_THAT(bench.out(), Catch::Contains("far.nc:2:") &&
                                Catch::Contains("OT0500 + OVERTRAVEL ( SOFT 1 ) X [alarm]"));
    CHECK(bench.check("nowhere.nc") == 2);
    CHECK(bench.check("good.nc --format xml") == 2);
}

TEST_CASE("check --json and check --run find the alarm of a macro with its place") {
    const Bench bench;
    bench.write("part.nc", "O1\nG65 P9002 A0.\nM30\nO9002\n#100=1/#1\nM99\n");
    CHECK(bench.check("part.nc --json") == 0);
    CHECK(bench.check("part.nc --run --json") == 1);
    const Json json = Json::parse(bench.out());
    CHECK(json["schema"] == "trunnion.check/1");
    REQUIRE(json["findings"].size() == 1);
    const Json& finding = json["findings"][0];
    CHECK(finding["rule"] == "alarm");
    CHECK(finding["line"] == 5);
    CHECK(finding["path"] == "part.nc");
    CHECK_THAT(finding["text"].get<std::string>(), Catch::Contains("PS0112"));
    CHECK_FALSE(finding["remedy"].get<std::string>().empty());
}

TEST_CASE("check ends a program that loops for ever") {
    const Bench bench;
    bench.write("loop.nc", "O1\nN1 #1=#1+1\nGOTO 1\n");
    CHECK(bench.check("loop.nc --run --max-blocks 1000") == 1);
    CHECK_THAT(bench.out(), Catch::Contains("does not end within 1000 blocks"));
}

TEST_CASE("check --against: another control, generation, choice, parameter, setup; how far") {
    const Bench bench;
    bench.write("part.nc", "O1\nG90 G21 G17 G54\nT1 M6\nG43 H1\nG0 X100. Y20.\nX5.\nM30\n");
    CHECK(bench.check("part.nc --against 16i") == 0);
    CHECK(bench.check("part.nc --against block_skip.1=on") == 0);
    CHECK(bench.check("part.nc --against hurco") == 1);
    CHECK_THAT(bench.out(), Catch::Contains("part.nc:4:1: warning: ends at Z150.") &&
                                Catch::Contains("150.0000 mm apart"));
    CHECK(bench.check("part.nc --against 5006#6=1 --json") == 1);
    const Json json = Json::parse(bench.out());
    REQUIRE(json["findings"].size() == 1);
    CHECK(json["findings"][0]["rule"] == "reading");
    CHECK(json["findings"][0]["line"] == 4);
    bench.write("part.nc", "O1\nG90 G21 G17 G54\nT1 M6\nG43 H1\nG0 X100. Y20.\nX5\nM30\n");
    CHECK(bench.check("part.nc") == 1);  // X5 beside Y20.
    CHECK_THAT(bench.out(), Catch::Contains("[decimal-point]"));
    CHECK(bench.check("part.nc --against 3401=0") == 1);
    CHECK_THAT(bench.out(), Catch::Contains("part.nc:6:1: warning: ends at X5.") &&
                                Catch::Contains("4.9950 mm apart"));
    bench.write("other.toml",
                "[machine]\nname = \"o\"\nchain = \"w b X Y Z t\"\n"
                "[control.work_offsets]\nG54 = { X = 7.0 }\n");
    CHECK(bench.check("part.nc --against other.toml --html page.html --out report.txt") == 1);
    CHECK_THAT(bench.read("page.html"), Catch::Contains("mm apart"));
    CHECK(bench.out().empty());
    for (const char* wrong : {"haas", "tcp_frame=end", "5006#9=1", "nowhere.toml"}) {
        CHECK(bench.check(std::string("part.nc --against ") + wrong + " --out no.txt") == 2);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains("--against takes hurco"));
        CHECK_FALSE(std::filesystem::exists(bench.path / "no.txt"));
    }
}

TEST_CASE("parameters of a setup change what a program does") {
    const Bench bench;
    std::ifstream table(std::string(TRUNNION_SOURCE_DIR) + "/machines/bc_table.toml");
    std::stringstream machine;
    machine << table.rdbuf();
    const auto run = [&](const std::string& parameters, const std::string& program) {
        std::string text = machine.str();
        const std::string head = "[control.parameters]\n";
        const std::size_t at = text.find(head);
        if (at == std::string::npos)
            text += "\n" + head + parameters;
        else
            text.insert(at + head.size(), parameters);
        bench.write("s.toml", text);
        bench.write("p.nc", program);
        const std::string command = "cd " + bench.path.string() + " && " + TRUNNION_BINARY_DIR +
                                    "/bin/trunnion run p.nc --setup s.toml --json --vars 100-101 "
                                    ">out.txt 2>err.txt";
        const int code = WEXITSTATUS(std::system(command.c_str()));
        REQUIRE((code == 0 || code == 3));
        return Json::parse(bench.out());
    };
    const std::string argument = "O1\nG65 P9 A10\nM30\nO9\n#100=#1\nM99\n";
    CHECK(run("3401 = \"00000001\"\n", argument)["variables"]["100"] == 10.0);
    CHECK(run("3401 = \"00000000\"\n", argument)["variables"]["100"] == 0.01);
    const std::string print = "O1\n#1=1.5\nDPRNT[X#1[42]]\nM30\n";
    CHECK(run("", print)["printed"] == "X    1.50\n");
    CHECK(run("6001 = \"00000010\"\n", print)["printed"] == "X1.50\n");
    const std::string rounded =
        "O1\n#1=0.12345\nG20 G91\n#2=#5001\nG0 X[ROUND[#1]]\n#100=#5001-#2\nM30\n";
    CHECK(run("", rounded)["variables"]["100"].get<double>() == Approx(0.1235).margin(1e-9));
    const std::string mapped = "O1\nM66\nM30\nO9001\n#100=7\nM99\n";
    CHECK(run("6071 = 66\n", mapped)["variables"]["100"] == 7.0);
    CHECK(run("", mapped)["variables"]["100"].is_null());
}

TEST_CASE("check: the programs that ship have no findings") {
    const Bench bench;
    CHECK(bench.check(std::string(TRUNNION_SOURCE_DIR) + "/programs") == 0);
    CHECK_THAT(bench.out(), Catch::Contains("0 findings in") && Catch::EndsWith(" files\n"));
}

TEST_CASE("check: without --setup the machine is the one that a program names or has the axes of") {
    const Bench bench;
    bench.write("ac.nc", "O1\nG90 G54\nG0 A10. C20.\nM30\n");
    CHECK(bench.check("ac.nc") == 0);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("ac_trunnion.toml"));
    CHECK(bench.check("ac.nc --setup " + std::string(TRUNNION_SOURCE_DIR) +
                      "/machines/bc_table.toml") == 1);
    CHECK_THAT(bench.out(), Catch::Contains("PS0009"));
    bench.write("named.nc", "O2 (SETUP HTM_EXERCISE_3)\nG0 Z500.\nM30\n");
    CHECK(bench.check("named.nc") == 0);
    bench.write("sheet.nc", "O3 (SETUP SHEET 4)\nG0 X9000.\nM30\n");
    CHECK(bench.check("sheet.nc") == 1);
    bench.write("both.nc", "O4\nG0 A1. B1.\nM30\n");  // a machine that does not ship
    CHECK(bench.check("both.nc") == 1);
}

TEST_CASE(
    "check: a lathe's program is named and neither run nor compared, the mill's beside it is") {
    const Bench bench;
    const std::string lathe = "O2(TURN)\nT0101\nG96S100M3\nG0X50.Z1.\nGOTO9\nM30\n",
                      mill = "O1\nG17G90G0X9000.\nM30\n";
    bench.write("lathe.nc", lathe);
    CHECK(bench.check("lathe.nc --run --against hurco") == 1);
    CHECK_THAT(bench.out(), Catch::Contains("O0002 is a program for a lathe") &&
                                Catch::EndsWith("1 finding in 1 file\n"));
    bench.write("both.nc", mill + lathe);
    CHECK(bench.check("both.nc --run") == 1);
    CHECK_THAT(bench.out(), Catch::Contains("OVERTRAVEL") && Catch::Contains("for a lathe") &&
                                Catch::EndsWith("2 findings in 1 file\n"));
    bench.write("turned.nc", lathe + mill);
    CHECK(bench.check("turned.nc --run") == 1);
    CHECK_THAT(bench.out(), Catch::Contains("OVERTRAVEL") && Catch::Contains("for a lathe"));
}

TEST_CASE("check and run say once that an M code passes without effect, unless it is declared") {
    const Bench bench;
    bench.write("p.nc", "O1\nM141\nM8\nM141\nM30\n");
    CHECK(bench.check("p.nc") == 0);
    CHECK_THAT(bench.out(), Catch::Contains("p.nc:2:1: note: M141 is not known to this control") &&
                                Catch::Contains("(2 times, last in line 4)") &&
                                Catch::EndsWith("0 findings in 1 file, 1 note\n"));
    CHECK(bench.trunnion("run " + bench.file("p.nc")) == 0);
    const std::string notes = bench.read("err.txt") + bench.out();
    const std::string said = "M141 is not known to this control: it passed without effect";
    REQUIRE(notes.find(said) != notes.npos);
    CHECK(notes.find(said, notes.find(said) + 1) == notes.npos);
    bench.write("s.toml",
                "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[control.builder]\n"
                "m_codes = [141]\n");
    CHECK(bench.check("p.nc --setup s.toml") == 0);
    CHECK(bench.out() == "0 findings in 1 file\n");
}

TEST_CASE("check: G43.4 with the table off zero, as a run finds it") {
    const Bench bench;
    const std::string head = "O1\nG21G90G54G17\nT1M6\nG43H1G0X0Y0Z200.\n",
                      start = "G43.4H1\nX10.Y20.Z100.\nG49\nM30\n",
                      index = "G68.2X0Y0Z0I0J30.K0\nG53.1\nG69\n";
    const auto starts = [&](const std::string& body) {
        bench.write("p.nc", head + body);
        const int code = bench.check("p.nc --json --setup " + std::string(TRUNNION_SOURCE_DIR) +
                                     "/machines/bc_table.toml");
        const Json json = Json::parse(bench.out());
        std::vector<std::string> places;
        for (const Json& f : json["findings"]) {
            CHECK(f["rule"] == "tcp-frame");
            CHECK_THAT(f["text"].get<std::string>(),
                       Catch::Contains("\"start\" and X") && Catch::Contains("\"rotary_zero\""));
            places.push_back(f["path"].get<std::string>() + ':' +
                             std::to_string(f["line"].get<int>()));
        }
        CHECK(code == (places.empty() ? 0 : 1));
        return places;
    };
    using Places = std::vector<std::string>;
    CHECK(starts(index + start) == Places{"p.nc:8"});
    CHECK(starts("G0B-30.C90.\n" + start) == Places{"p.nc:6"});
    CHECK(starts("G68.2X0Y0Z0I0J30.K0\nG0B-30.C90.\nG69\n" + start) == Places{"p.nc:8"});
    CHECK(starts("M98P1004\n" + start + "O1004\n" + index + "M99\n") == Places{"p.nc:6"});
    CHECK(starts("#1=30.\nG0B-#1\n" + start) == Places{"p.nc:7"});
    CHECK(starts("IF[1EQ1]GOTO5\nN5" + index + start) == Places{"p.nc:9"});
    CHECK(starts("G0B30.\nM98P1005\nM98P1005\nG49\nM30\nO1005\nG43.4H1\nX10.Z100.\nG49\nM99\n") ==
          Places{"p.nc:11"});
    bench.write("O1006.nc", "O1006\nG43.4H1\nX10.Y20.Z100.\nG49\nM99\n");
    CHECK(starts("G0B30.\nM98P1006\nM30\n") == Places{"./O1006.nc:2"});
    // The table stands at zero, or at a turn of it.
    CHECK(starts("G68.2X0Y0Z0I0J0K0\nG53.1\nG69\n" + start).empty());
    CHECK(starts(index + "G0B0C0\n" + start).empty());
    CHECK(starts("G0C360.\n" + start).empty());
    CHECK(starts(index + "G1X1.F100\nM30\n").empty());
}

TEST_CASE("check of a folder names a backup's own files in one line each and checks its programs") {
    const Bench bench;
    std::filesystem::create_directories(bench.path / "bk");
    bench.write("bk/CNC-PARA.TXT",
                "%\nN00000Q1L1P00000010\nN01020Q1A1P88A2P89A3P90\n"
                "N01320Q1A1M400.0A2M-5.0\n%\n");
    bench.write("bk/old.txt", "%\r\nN01825 A1 P 3000 A2 P 3000\r\nN10000Q0P-1\r\n%\r\n");
    bench.write("bk/Ext_wkz.txt", "%\nG90\nG10L2P0X0.0Y0.0Z0.0B0.0\nM02\n%\n");
    bench.write("bk/TOOLOFST.TXT", "%\nG10G90L10P1R185.676\nM02\n%\n");
    bench.write("bk/MACRO.TXT", "%\nG10L85P500(400777CED9168730)\nSETVN500[A]\nM02\n%\n");
    bench.write("bk/TOOLLIFE.TXT", "%\n%\n");
    bench.write("bk/ALL-PROG.TXT", "%\n&F=/USER/PATH1/\nO1\nGOTO5\nM30\n%\n");
    CHECK(bench.check("bk") == 1);
    for (const char* line :
         {"CNC-PARA.TXT:1:1: note: this is a backup's parameter file, not a program",
          "old.txt:1:1: note: this is a backup's parameter file",
          "Ext_wkz.txt:1:1: note: this is a backup's work offset file",
          "TOOLOFST.TXT:1:1: note: this is a backup's tool offset file",
          "MACRO.TXT:1:1: note: this is a backup's variable file",
          "ALL-PROG.TXT:4:1: error: GOTO 5"})
        CHECK_THAT(bench.out(), Catch::Contains(line));
    // Programs that look like it.
    std::filesystem::create_directories(bench.path / "own");
    bench.write("own/MACRO.TXT", "O9001\n#500=1\nGOTO5\nM99\n");
    bench.write("own/TOOLOFST.TXT", "G10L10P1R5.\nG0X1.\nGOTO5\nM30\n");
    bench.write("own/numbered.nc", "N10000M3S100\nN10010P5\nN10020GOTO5\nM30\n");
    CHECK(bench.check("own") == 1);
    CHECK(bench.out().find("backup") == std::string::npos);
    CHECK(bench.trunnion("check " + bench.write("empty.nc", "%\n")) == 2);
}

TEST_CASE(
    "check and run find the same programs: subfolders, brackets, tape, folders of a control") {
    const Bench bench;
    std::filesystem::create_directories(bench.path / "sub/deep");
    bench.write("main.nc", "O1\nM98P8001\nM98P8002\nM98P8003\nM98<BORE>\nM98P8005\nM30\n");
    bench.write("sub/stuff.txt", "%\nO8001\n#501=1\nM99\n<O8002>\n#502=2\nM99\n%\n");
    bench.write("tape.nc", std::string(99, '\0') + "%\nO8003\n#503=3\nM99\n%\n");
    bench.write("sub/deep/named.nc", "%\n<BORE>\n#504=4\nM99\n%\n");
    bench.write("<O8005>.TXT", "#505=5\nM99\n");
    CHECK(bench.check("main.nc") == 0);
    const std::string said = bench.read("err.txt");
    CHECK(bench.trunnion("run " + bench.file("main.nc") + " --json --vars 501-505") == 0);
    const Json variables = Json::parse(bench.out())["variables"];
    for (int i = 1; i <= 5; ++i) CHECK(variables[std::to_string(500 + i)] == double(i));
    for (const char* program : {"O8001", "O8002", "<BORE>"}) {
        CHECK_THAT(said, Catch::Contains(program + std::string(" is taken from a subfolder")));
        CHECK_THAT(bench.read("err.txt"),
                   Catch::Contains(program + std::string(" is taken from a subfolder")));
    }
    std::filesystem::create_directories(bench.path / "card");
    bench.write("card/ALL-PROG.TXT",
                "%\n&F=/MTB1/\nO0002\n#500=2.\nM99\n&F=/USER/PATH1/\nO0001\n"
                "M98P2\nM30\nO0002\n#500=3.\nM99\n%\n");
    CHECK(bench.trunnion("run 1 --programs " + bench.file("card") + " --json --vars 500") == 0);
    CHECK(Json::parse(bench.out())["variables"]["500"] == 3.0);
}

TEST_CASE("check: M128 is read as a Hurco's, and --against a Hurco's choice compares two Hurcos") {
    const Bench bench;
    bench.write("h.nc",
                "O1(H)\nG90G17G40G80\nG21\nT1M6\nM127\nG54\nG0X0.Y0.Z50.\nM128\n"
                "G1X0.Y0.Z0.A0.C0.F1000.\nG1X40.C720.\nM129\nM2\n");
    const std::string against = "h.nc --against hurco.m128_keeps_tip_between_ends=true";
    CHECK(bench.check(against) == 1);
    CHECK_THAT(bench.out(), Catch::Contains("h.nc:10:1: warning: passes ") &&
                                Catch::Contains("mm apart [reading]"));
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("read as a Hurco's"));
    CHECK(bench.check(against + " --setup " + TRUNNION_SOURCE_DIR + "/machines/ac_trunnion.toml") ==
          2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("concerns a Hurco"));
    CHECK(bench.check("h.nc") == 0);
    CHECK(bench.out() == "0 findings in 1 file\n");
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("h.nc: contains M128; read as a program of"));
    // One that a Hurco would refuse stays a Fanuc's.
    bench.write("f.nc", "O1\nG90G17G54\nM128\nG68.2X0Y0Z0I0J10.K0\nG53.1\nG69\nM129\nM30\n");
    CHECK(bench.check("f.nc") == 0);
    CHECK_THAT(bench.out(), Catch::Contains("note: M128") && Catch::Contains("2 notes"));
}

TEST_CASE("shipped programs are announced unless they are asked for") {
    const Bench bench;
    const std::string source = TRUNNION_SOURCE_DIR;
    const auto says = [&](const std::string& words) {
        CHECK(WEXITSTATUS(
                  std::system(("cd " + source + " && " + TRUNNION_BINARY_DIR + "/bin/trunnion " +
                               words + " >" + bench.file("out.txt") + " 2>" + bench.file("err.txt"))
                                  .c_str())) == 0);
        return bench.read("err.txt");
    };
    const std::string main = bench.write("main.nc", "O1\nM98P8110\nM30\n");
    for (const std::string asked :
         {"run O8110", "run O8110 --programs programs", "run O8110 --programs programs/pivot",
          "run programs/pivot/O8001.nc", "run programs/pivot/O8001.nc --programs programs"})
        CHECK(says(asked).find("shipped program") == std::string::npos);
    CHECK_THAT(says("run " + main), Catch::Contains("O8110 is a shipped program ("));
    CHECK_THAT(says("check " + main), Catch::Contains("O8110 is a shipped program ("));
    CHECK(says("check " + main + " --programs programs").empty());
}
