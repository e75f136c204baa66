// How much a command says beside its result: --quiet, --verbose, and the line of progress.
#include <catch2/catch.hpp>

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
    CHECK_THAT(bench.read("err.txt"),
               Catch::Contains("derived from") && Catch::Contains("ok: 43 blocks"));
    CHECK(bench.trunnion("run " + part + " --quiet") == 0);
    CHECK(bench.read("err.txt").empty());
    CHECK(bench.trunnion("run " + bench.write("bad.nc", "O1\nG999\nM30\n") + " -q") == 3);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("bad.nc:2:1: error: alarm 10"));
}

TEST_CASE("verbose names the files read and the time") {
    const CommandBench bench;
    CHECK(bench.trunnion("run " + part + " --verbose") == 0);
    const std::string said = bench.read("err.txt");
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
