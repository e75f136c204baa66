// How much a command says beside its result: --quiet, --verbose, and the line of progress.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <set>
#include <sstream>

#include "tests/cli/command_bench.h"

namespace {

const std::string part = std::string(TRUNNION_SOURCE_DIR) + "/programs/examples/bracket_g43_4.nc";

/// What a terminal shows of the command: `script` (bsdutils) lends it one.
std::string on_terminal(const CommandBench& bench, const std::string& words, int code = 4,
                        const std::string& environment = "") {
    const std::string command = environment + " script -qec '" + std::string(TRUNNION_BINARY_DIR) +
                                "/bin/trunnion " + words + "' /dev/null > " +
                                bench.file("screen.txt") + " < /dev/null";
    CHECK(WEXITSTATUS(std::system(command.c_str())) == code);
    return bench.read("screen.txt");
}

/// Runs until its time is up.
std::string endless(const CommandBench& bench) {
    return "run " + bench.write("loop.nc", "O1\nN1GOTO1\nM30\n") +
           " --max-blocks 0 --max-seconds 1.5";
}

}  // namespace

TEST_CASE("quiet: results and errors only") {
    const CommandBench bench;
    CHECK(bench.trunnion("run " + part + " --print " + bench.file("p.txt")) == 0);
    CHECK_THAT(bench.read("err.txt"), Catch::StartsWith("ok: 43 blocks"));
    CHECK(bench.trunnion("run " + part + " --quiet") == 0);
    CHECK(bench.read("err.txt").empty());
    CHECK(bench.trunnion("run " + bench.write("bad.nc", "O1\nG999\nM30\n") + " -q") == 3);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("bad.nc:2:1: error: PS0010"));
}

TEST_CASE("verbose names the files read and the time") {
    const CommandBench bench;
    CHECK(bench.trunnion("run " + part + " --verbose") == 0);
    const std::string said = bench.read("err.txt");
    CHECK_THAT(said, Catch::Contains(" parameters derived from [machine]\n"));
    CHECK_THAT(said, Catch::Contains("bracket_g43_4.nc (sha256 ") && Catch::EndsWith(" s\n"));
    CHECK(bench.trunnion("run " + part + " --verbose --quiet") == 2);
}

TEST_CASE("progress stands on a terminal only, with its rate") {
    const CommandBench bench;
    CHECK_THAT(on_terminal(bench, endless(bench)),
               Catch::Contains(" blocks, ") && Catch::Contains(" a second"));
    CHECK_THAT(on_terminal(bench, endless(bench) + " --quiet"), !Catch::Contains("a second"));
    CHECK(bench.trunnion(endless(bench)) == 4);
    CHECK_THAT(bench.read("err.txt"), !Catch::Contains("a second"));
}

TEST_CASE("the ballbar test names its steps and the time left") {
    const CommandBench bench;
    std::ostringstream text;
    text << std::ifstream(TRUNNION_SOURCE_DIR "/machines/ac_trunnion.toml").rdbuf();
    std::string setup = text.str();
    const std::string rate = "noise_um  = 0.5";
    setup.replace(setup.find(rate), rate.size(), rate + "\nsample_hz = 8");
    const std::string words = "ballbar --setup " + bench.write("bar.toml", setup);
    CHECK_THAT(on_terminal(bench, words, 0),
               Catch::Contains("step 1 of 4: first run") &&
                   Catch::Contains("step 3 of 4: run with compensation, ") &&
                   Catch::Contains(" a second, ") && Catch::Contains(" s left"));
    CHECK(bench.trunnion(words) == 0);
    CHECK_THAT(bench.read("err.txt"), !Catch::Contains("step"));
}

TEST_CASE("a note is said once, and what a terminal shows fits in 80 columns") {
    const CommandBench bench;
    const std::string machine = " --setup " TRUNNION_SOURCE_DIR "/machines/bc_table.toml",
                      readings = bench.file("r.csv");
    for (const std::string& words :
         {"run O8003 --readings " + readings + " --print " + bench.file("p.txt"),
          "identify " + readings + " --effects location" + machine,
          "diagnose " + readings + machine, "compensate " + part + " --out " + bench.file("c.nc"),
          "predict " + readings + machine + " --json", std::string("pivot"),
          "volumetric --grid 3 --rotary-grid 3" + machine}) {
        CAPTURE(words);
        REQUIRE(bench.trunnion(words) == 0);
        std::set<std::string> said;
        std::istringstream notes(bench.read("err.txt"));
        for (std::string line; std::getline(notes, line);) {
            CAPTURE(line);
            CHECK(said.insert(line).second);
        }
        std::istringstream result(words.ends_with("--json") ? "" : bench.read("out.txt"));
        for (std::string line; std::getline(result, line);) {
            CAPTURE(line);
            const auto more = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
            CHECK(static_cast<long>(line.size()) - std::count_if(line.begin(), line.end(), more) <=
                  80);
        }
    }
}

TEST_CASE("colour stands on a terminal only, never with NO_COLOR") {
    const CommandBench bench;
    const std::string words = "run " + bench.write("bad.nc", "O1\nG999\nM30\n");
    const std::string red = "\033[31merror:\033[0m";
    CHECK_THAT(on_terminal(bench, words, 3, "env -u NO_COLOR TERM=xterm"), Catch::Contains(red));
    CHECK_THAT(on_terminal(bench, words, 3, "NO_COLOR=1 TERM=xterm"), !Catch::Contains("\033["));
    CHECK_THAT(on_terminal(bench, words, 3, "TERM=dumb"), !Catch::Contains("\033["));
    CHECK(bench.trunnion(words) == 3);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("error:") && !Catch::Contains("\033["));
}

TEST_CASE("a terminal without UTF-8 reads um, a file always µm") {
    const CommandBench bench;
    const std::string words =
        "volumetric --setup " TRUNNION_SOURCE_DIR "/machines/ac_trunnion.toml";
    CHECK_THAT(on_terminal(bench, words, 0, "LC_ALL=C"),
               Catch::Contains("rms um") && !Catch::Contains("µ"));
    CHECK_THAT(on_terminal(bench, words, 0, "LC_ALL=C.UTF-8"), Catch::Contains("rms µm"));
    CHECK(bench.trunnion(words) == 0);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("rms µm"));
}
