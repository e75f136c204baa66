#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

using Bench = CommandBench;

const std::string touch_program =
    "O2\nG90 G54 G0 X170. Y0\nT1\nG43 H1 Z80.\nG31 X120. F100.\n#100=#5061\n"
    "DPRNT[X#100[44]]\nG0 X170.\nM30\n";

}  // namespace

TEST_CASE("run writes JSON, readings, trace and prints, the same bytes for the same seed") {
    const Bench bench;
    bench.write("t.nc", touch_program);
    const std::string words = "run " + bench.file("t.nc") +
                              " --json --seed 5 --vars 100-101 --trace " + bench.file("t.csv") +
                              " --truth --readings " + bench.file("r.csv") + " --print " +
                              bench.file("p.txt");
    REQUIRE(bench.trunnion(words) == 0);
    const Json json = Json::parse(bench.read("out.txt"));
    CHECK(json["schema"] == "trunnion.run/1");
    CHECK(json["status"] == "ok");
    CHECK(json["alarm"].is_null());
    CHECK(json["variables"]["100"].get<double>() == Approx(135.55).margin(0.01));
    CHECK(json["variables"]["101"].is_null());
    CHECK(json["final"]["machine"]["X"].get<double>() == Approx(170.1443));
    CHECK_THAT(json["printed"].get<std::string>(), Catch::Contains("135.5"));
    const std::string readings = bench.read("r.csv"), trace = bench.read("t.csv");
    CHECK_THAT(readings, Catch::Contains("touch,S1") && Catch::Contains("# seed = 5"));
    CHECK(bench.read("p.txt") == json["printed"].get<std::string>());
    REQUIRE(bench.trunnion(words) == 0);
    CHECK(bench.read("r.csv") == readings);
    CHECK(bench.read("t.csv") == trace);
}

TEST_CASE("bad usage and bad input: one clear message, exit code 2, no files") {
    const Bench bench;
    bench.write("t.nc", touch_program);
    bench.write("bad.toml", "[machine]\nchain = \"w B b X t\"\n");
    const std::string t = "run " + bench.file("t.nc");
    const std::string out = " --trace " + bench.file("x.csv");
    for (const std::string& words :
         {std::string("run"), std::string("run /no/such.nc"), std::string("run O987654"),
          t + " --what", t + " --set 100", t + " --vars abc",
          t + " --inject 'Q.backlash: gap_mm=1'", t + " --truth", t + " --programs /no/such",
          t + " --setup " + bench.file("bad.toml")}) {
        INFO(words);
        CHECK(bench.trunnion(words + (words.size() > 4 && words != t + " --truth" ? out : "")) ==
              2);
        CHECK_FALSE(bench.read("err.txt").empty());
        CHECK(bench.read("out.txt").empty());
        CHECK_FALSE(fs::exists(bench.file("x.csv")));
    }
    CHECK(bench.trunnion(t + " --setup " + bench.file("bad.toml")) == 2);
    CHECK_THAT(bench.read("err.txt"),
               Catch::Contains("bad.toml:2:") && Catch::Contains("point_mm"));
}

TEST_CASE("alarm and limit have their exit codes and leave what was done until then") {
    const Bench bench;
    bench.write("a.nc", "O1\nG90 G0 X10.\nG54 G1 X9999. F100.\nM30\n");
    CHECK(bench.trunnion("run " + bench.file("a.nc") + " --json --trace " + bench.file("x.csv")) ==
          3);
    const Json json = Json::parse(bench.read("out.txt"));
    CHECK(json["status"] == "alarm");
    CHECK(json["alarm"]["line"] == 3);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("a.nc:3:"));
    CHECK_THAT(bench.read("x.csv"), Catch::Contains("a.nc,2,G0") && !Catch::Contains("a.nc,3"));
    bench.write("loop.nc", "O1\nN1 #100=#100+1\nDPRNT[N#100[40]]\nGOTO 1\nM30\n");
    CHECK(bench.trunnion("run " + bench.file("loop.nc") + " --max-blocks 1000 --json --print " +
                         bench.file("p.txt")) == 4);
    CHECK(Json::parse(bench.read("out.txt"))["status"] == "limit");
    CHECK_THAT(bench.read("p.txt"), Catch::StartsWith("N    1\nN    2\n"));
}

TEST_CASE("Ctrl-C ends a run that would never end, and what was done stays") {
    const Bench bench;
    bench.write("loop.nc", "O1\nG91\nN1 G0 X.01\nX-.01\nGOTO 1\nM30\n");
    const std::string command = std::string(TRUNNION_BINARY_DIR) + "/bin/trunnion run " +
                                bench.file("loop.nc") + " --json --trace " + bench.file("t.csv") +
                                " >" + bench.file("out.txt") + " 2>" + bench.file("err.txt") +
                                " & run=$!; until [ $(awk '/^wchar/ {print $2}' /proc/$run/io) -gt "
                                "100000 ]; do sleep 0.05; done; kill -TERM $run; wait $run";
    CHECK(WEXITSTATUS(std::system(command.c_str())) == 4);
    const Json json = Json::parse(bench.read("out.txt"));
    CHECK(json["status"] == "limit");
    const std::string trace = bench.read("t.csv"), errors = bench.read("err.txt");
    CHECK(trace.back() == '\n');
    CHECK(std::count(trace.begin(), trace.end(), '\n') == json["moves"].get<int>() + 1);
    CHECK_THAT(errors, Catch::Contains("interrupted") && !Catch::Contains("million"));
}

TEST_CASE("subprograms are found beside the program and in the folders given") {
    const Bench bench;
    fs::create_directories(bench.path / "subs");
    bench.write("m.nc", "O1\nM98 P77\nM98 P78\nM30\n");
    bench.write("O0077.nc", "O77\n#101=7\nM99\n");
    bench.write("subs/many.txt", "O79\nM99\nO78\n#102=8\nM99\n");
    CHECK(bench.trunnion("run " + bench.file("m.nc") + " --programs " + bench.file("subs") +
                         " --json --set '#100=3.5' --vars 100-102") == 0);
    const Json variables = Json::parse(bench.read("out.txt"))["variables"];
    CHECK(variables["100"] == 3.5);
    CHECK(variables["101"] == 7);
    CHECK(variables["102"] == 8);
    CHECK(bench.trunnion("run 77 --programs " + bench.path.string()) == 0);
}

TEST_CASE("an injected effect changes what the probe finds") {
    const Bench bench;
    bench.write("t.nc", touch_program);
    const auto found = [&](const std::string& more) {
        REQUIRE(bench.trunnion("run " + bench.file("t.nc") + " --json --vars 100 " + more) == 0);
        return Json::parse(bench.read("out.txt"))["variables"]["100"].get<double>();
    };
    const double shift = found("--inject 'X.backlash: gap_mm=0.01'") - found("");
    CHECK(shift == Approx(0.005).margin(1e-6));  // moving in -X the axis stands 5 um short of -X
}

TEST_CASE("volumetric says what travel it takes where the setup gives none") {
    const Bench bench;
    CHECK(bench.trunnion("volumetric --help") == 0);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("200 mm"));
    bench.write("m.toml", "[machine]\nchain = \"w Y X b Z t\"\n");
    CHECK(bench.trunnion("volumetric --grid 2 --setup " + bench.file("m.toml")) == 0);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("assumed: X Y Z"));
}

TEST_CASE("compensate tells what backlash leaves where an axis turns round") {
    const Bench bench;
    bench.write(
        "m.toml",
        "[machine]\nchain = \"w Y X b Z t\"\n[effects]\n\"X.backlash\" = { gap_mm = 0.01 }\n");
    bench.write("c.nc", "O1\nG21 G90 G17 G54 G94\nG0 X60. Y0\nG3 I-60. F500.\nM30\n");
    CHECK(bench.trunnion("compensate " + bench.file("c.nc") + " --setup " + bench.file("m.toml") +
                         " --out " + bench.file("out.nc")) == 0);
    const std::string said = bench.read("err.txt");
    CHECK_THAT(said,
               Catch::Contains("5.00 µm before, 0.00") && Catch::Contains("after a reversal"));
}
