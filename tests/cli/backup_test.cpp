// trunnion backup, and run with a backup, as a user calls them.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

namespace {

std::string punched(std::string text) {
    std::string out;
    for (const char c : text) out += c == '\n' ? std::string("\n\r\r") : std::string(1, c);
    return out;
}

/// A three-axis mill with a pallet axis W whose place no parameter tells.
struct Bench : CommandBench {
    Bench() {
        std::filesystem::create_directories(path / "bk");
        write("bk/CNC-PARA.TXT",
              punched("%(CNCID=3C7B5D01,F6914B1A)\nN01020Q1A1P88A2P89A3P90A4P87 \nN06071Q1L1P6 \n"
                      "N01320Q1A1M500.0A2M300.0A3M0.0A4M900.0 \n"
                      "N01321Q1A1M-500.0A2M-300.0A3M-600.0A4M0.0 \n"
                      "N01420Q1A1M30000.0A2M30000.0A3M24000.0A4M6000.0 \n"
                      "N01241Q1A1M0.0A2M0.0A3M-10.0A4M0.0 \nN01851Q1A1P12A2P0A3P4A4P0 \n"
                      "N03620Q1A1P10 \nN03621Q1A1P10 \nN03622Q1A1P12 \nN03624Q1A1M100.0 \n%"));
        write("bk/PITCH.TXT", punched("%\nN10011Q0P-3 \nN10012Q0P2 \n%"));
        write("bk/ALL-FLDR.TXT",
              punched("%\n&F=/MTB1/\nO9001(TOOL*CHANGE)\n#1=#4001\nG91G30P2Z0\nG31\nG#1\n"
                      "#100=#100+1\nM99\n%"));
        write("bk/SRAM.FDB", std::string("\0\xff\r\n\x1a", 5));
        std::filesystem::create_directories(path / "bk/sub");
        write("bk/sub/NOTE.TXT", "a\r\nb\n\n");
        write("main.nc", "%\nO1\nG90G54\nT3M6\nG0X10.W800.\nM30\n");
    }
};

}  // namespace

TEST_CASE("backup load says what becomes of each value and file") {
    const Bench bench;
    REQUIRE(bench.trunnion("backup load " + bench.file("bk")) == 0);
    const std::string out = bench.read("out.txt");
    CHECK_THAT(out, Catch::Contains("1851 X\t12\tobeyed"));
    CHECK_THAT(out, Catch::Contains("10011\t-3\tobeyed"));
    CHECK_THAT(out, Catch::Contains("1420 W\t6000.0\tobeyed"));
    CHECK_THAT(out, Catch::Contains("CNC-PARA.TXT\t\t") && Catch::Contains("obeyed\tparameters\n"));
    CHECK_THAT(out, Catch::Contains("SRAM.FDB\t\t5 bytes\tignored\tbinary\n"));
    CHECK_THAT(out, Catch::Contains("sub/NOTE.TXT\t\t6 bytes\tignored\ttext\n"));
}

TEST_CASE("backup save brings every file of the folder back, and says what each is") {
    const Bench bench;
    bench.write("same.toml",
                "[machine]\nchain = \"w b X Y Z t\"\nauxiliary = [\"W\"]\n[control]\n"
                "backup = \"bk\"\n");
    bench.write("bk/macro.txt", punched("%\nG10L85P500R1.5\n%"));
    const auto save = [&](const std::string& from, const std::string& to, const std::string& with) {
        return bench.trunnion("backup save " + bench.file(from) + " " + bench.file(to) +
                              " --setup " + bench.file(with));
    };
    REQUIRE(save("bk", "out", "same.toml") == 0);
    for (const char* name :
         {"CNC-PARA.TXT", "PITCH.TXT", "ALL-FLDR.TXT", "SRAM.FDB", "sub/NOTE.TXT", "macro.txt"}) {
        CAPTURE(name);
        REQUIRE_FALSE(bench.read(std::string("bk/") + name).empty());
        CHECK(bench.read(std::string("out/") + name) == bench.read(std::string("bk/") + name));
    }
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("SRAM.FDB\tbinary\tcopied") &&
                                          Catch::Contains("MACRO.TXT\tmacro variables\tunchanged"));
    CHECK(bench.read("err.txt").find("SRAM") == std::string::npos);

    bench.write("other.toml", bench.read("same.toml") + "[control.variables]\n500 = 2.5\n");
    REQUIRE(save("bk", "out", "other.toml") == 0);
    CHECK_THAT(bench.read("out/macro.txt"), Catch::Contains("P500R2.5"));
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("1 values changed"));
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("SRAM.FDB is copied as it is"));
    CHECK(save("bk", "bk/inside", "same.toml") == 2);
    CHECK_FALSE(std::filesystem::exists(bench.path / "bk/inside"));
}

TEST_CASE("backup diff tells names, the first line of a program and every other file") {
    const Bench bench;
    std::filesystem::copy(bench.path / "bk", bench.path / "new",
                          std::filesystem::copy_options::recursive);
    REQUIRE(bench.trunnion("backup diff " + bench.file("bk") + " " + bench.file("new")) == 0);
    bench.write("bk/MACRO.TXT", "%\nG10L85P500R1.5\nSETVN500[PIVOT,TOP]\n%\n");
    bench.write("new/MACRO.TXT", "%\nG10L85P500R1.5\nSETVN500[PIVOT,BASE]\n%\n");
    bench.write("new/ALL-FLDR.TXT",
                "%\n&F=/MTB1/\nO9001(TOOL*CHANGE)\n#1=#4001\nG91G30P2Z5.\nG31\nG#1\nM5\n"
                "#100=#100+1\nM99\n%");
    bench.write("new/SRAM.FDB", std::string("\0\xff\r\n", 4));
    bench.write("new/sub/NOTE.TXT", "a\nc\n");
    REQUIRE(bench.trunnion("backup diff " + bench.file("bk") + " " + bench.file("new")) == 1);
    const std::string out = bench.read("out.txt");
    for (const char* row :
         {"MACRO.TXT\t#501 name\tTOP\tBASE\tname by SETVN\n",
          "ALL-FLDR.TXT\t/MTB1/O9001\t7 lines\t8 lines\tprogram: 1 line out, 2 in; first at line "
          "3: "
          "G91G30P2Z0 | G91G30P2Z5.\n",
          "SRAM.FDB\t\t5 bytes\t4 bytes\tbinary: first at byte 5\n",
          "sub/NOTE.TXT\t\t6 bytes\t4 bytes\ttext: 1 line out, 1 in; first at line 2: b | c\n"})
        CHECK_THAT(out, Catch::Contains(row));
    CHECK(std::count(out.begin(), out.end(), '\n') == 4);
}

TEST_CASE("the setup of a three-axis mill's backup loads, and its control compensates to nothing") {
    const Bench bench;
    const std::string setup = bench.file("mill.toml");
    REQUIRE(bench.trunnion("backup load " + bench.file("bk") + " --setup-out " + setup) == 0);
    CHECK_THAT(bench.read("mill.toml"), Catch::Contains("\ntcp_frame = \"start\"\n"));
    REQUIRE(bench.trunnion("run " + bench.file("main.nc") + " --setup " + setup + " --programs " +
                           bench.file("bk") + " --truth --trace " + bench.file("t.csv") +
                           " --json --vars 100") == 0);
    const auto run = nlohmann::json::parse(bench.read("out.txt"));
    CHECK(run["final"]["machine"]["W"] == 800.0);
    CHECK(run["final"]["machine"]["Z"] == -10.0);
    CHECK(run["variables"]["100"] == 1.0);
    CHECK(bench.read("err.txt").find("compensates") == std::string::npos);
    // The tip stands where the control believes, though both have errors.
    const std::string trace = bench.read("t.csv");
    const std::string last = trace.substr(trace.rfind('\n', trace.size() - 2) + 1);
    CHECK_THAT(trace, Catch::Contains("w_mm"));
    std::stringstream cells(last);
    std::vector<std::string> cell;
    for (std::string c; std::getline(cells, c, ',');) cell.push_back(c);
    CHECK(std::abs(std::stod(cell[cell.size() - 3]) - 10.0) < 1e-7);
    // Without the machine's own errors the control's compensation shows, and is noted.
    bench.write("plain.toml",
                "[machine]\nchain = \"w b X Y Z t\"\nauxiliary = [\"W\"]\n[control]\n"
                "backup = \"bk\"\n");
    REQUIRE(bench.trunnion("run " + bench.file("main.nc") + " --setup " + bench.file("plain.toml") +
                           " --programs " + bench.file("bk")) == 0);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("compensates backlash or pitch of X, Z"));
}

TEST_CASE("the setup of a control with two paths and two spindles is that of the first ones") {
    const Bench bench;
    bench.write("bk/CNC-PARA.TXT",
                punched("%\nN00000Q1L1P00000000L2P00000001\nN01020Q1A1P88A2P89A3P90\n"
                        "N03772Q1S1P8000S2P9000\nN19700Q1L1P1.5L2P2.5\n%"));
    const std::string bk = bench.file("bk"), setup = bench.file("two.toml");
    REQUIRE(bench.trunnion("backup load " + bk + " --setup-out " + setup) == 0);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("19700 path 2\t2.5\tknown"));
    bench.write("p.nc", "%\nO1\n#100=PRM[19700]\n#101=PRM[3772]\nM30\n%\n");
    REQUIRE(bench.trunnion("run " + bench.file("p.nc") + " --setup " + setup + " --vars 100,101") ==
            0);
    CHECK_THAT(bench.read("out.txt"),
               Catch::Contains("#100 = 1.5") && Catch::Contains("#101 = 8000"));
    REQUIRE(bench.trunnion("backup save " + bk + " " + bench.file("out") + " --setup " + setup) ==
            0);
    CHECK(bench.read("out/CNC-PARA.TXT") == bench.read("bk/CNC-PARA.TXT"));
}

TEST_CASE("a pivot is not compared with a G54 that the backup does not hold") {
    const Bench bench;
    bench.write("bk/CNC-PARA.TXT",
                punched("%\nN01020Q1A1P88A2P89A3P90A4P66A5P67 \nN19680Q1L1P12 \n"
                        "N19681Q1L1P4 \nN19682Q1L1P2 \nN19686Q1L1P5 \nN19687Q1L1P3 \n"
                        "N19700Q1L1P0.0 \nN19701Q1L1P0.0 \nN19702Q1L1P-300.0 \n%"));
    const std::string offsets = "%\nG90\nG10L2P0X0.0Y0.0Z0.0B0.0C0.0\n";
    bench.write("bk/EXT_WKZ.TXT", punched(offsets + "M02\n%"));
    CHECK(bench.trunnion("backup load " + bench.file("bk") + " --pivot") == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("this backup has no G54"));
    bench.write("bk/EXT_WKZ.TXT", punched(offsets + "G10L2P1X0.0Y0.0Z-300.0B0.0C0.0\nM02\n%"));
    CHECK(bench.trunnion("backup load " + bench.file("bk") + " --pivot") == 0);
}

TEST_CASE("run --control finds the programs in the control's memory") {
    const Bench bench;
    bench.write("plain.toml", "[machine]\nchain = \"w b X Y Z t\"\nauxiliary = [\"W\"]\n");
    const std::string words = "run " + bench.file("main.nc") + " --setup " +
                              bench.file("plain.toml") + " --control " + bench.file("bk");
    REQUIRE(bench.trunnion(words + " --vars 100") == 0);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("#100 = 1"));
    bench.write("far.nc", "%\nO1\nG90G0X500.5\nM30\n");
    CHECK(bench.trunnion("run " + bench.file("far.nc") + " --setup " + bench.file("plain.toml") +
                         " --control " + bench.file("bk")) == 3);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("OVERTRAVEL"));
}
