// diagnose --program under limits of time and blocks, and with options that do not belong to it.
#include <catch2/catch.hpp>
#include <filesystem>

#include "tests/cli/command_bench.h"

namespace {

const std::string control =
    "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n[control.work_offsets]\nG54 = { X = ";

/// A program and its log under another work offset.
struct Bench : CommandBench {
    Bench() {
        std::string text = "N1 G90 G21 G54\n";
        for (int k = 2; k < 400; ++k)
            text += "N" + std::to_string(k) + " G2 X" + std::to_string(k % 7) + ". Y" +
                    std::to_string(k % 5) + ". R40. F900.\n";
        write("part.nc", text + "M30\n");
        write("here.toml", control + "3.0 }\n");
        write("there.toml", control + "3.2 }\n");
        REQUIRE(trunnion("run " + file("part.nc") + " --setup " + file("there.toml") + " --trace " +
                         file("log.csv") + " --trace-step 0.5") == 0);
    }
    int diagnosed(const std::string& words) const {
        return trunnion("diagnose " + file("log.csv") + " --program " + file("part.nc") +
                        " --setup " + file("here.toml") + " --out " + file("new.toml") + words);
    }
};

}  // namespace

TEST_CASE("diagnose --program: max-seconds ends the search, says so and writes nothing") {
    const Bench bench;
    for (const char* limit : {"0.001", "0.2"}) {
        CHECK(bench.diagnosed(std::string(" --max-seconds ") + limit) == 4);
        CHECK_THAT(bench.read("err.txt"),
                   Catch::Contains("--max-seconds: the search was not finished"));
        CHECK(bench.read("out.txt").empty());
        CHECK_FALSE(std::filesystem::exists(bench.file("new.toml")));
    }
    CHECK(bench.diagnosed(" --max-seconds 1000") == 0);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("G54"));
}

TEST_CASE("diagnose --program: max-blocks ends it, says so and writes nothing") {
    const Bench bench;
    CHECK(bench.diagnosed(" --max-blocks 20") == 4);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("--max-blocks: the program does not end"));
    CHECK(bench.read("out.txt").empty());
    CHECK_FALSE(std::filesystem::exists(bench.file("new.toml")));
    bench.write("part.nc", "N1 G90 G21 G54\nN2 WHILE[1EQ1]DO1\nN3 G1 X1. F900.\nN4 X2.\nN5 END1\n");
    CHECK(bench.diagnosed(" --max-blocks 100000") == 4);
}

TEST_CASE("diagnose --program: --over sessions is refused beside it") {
    const Bench bench;
    CHECK(bench.diagnosed(" --over sessions") == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("--over"));
}
