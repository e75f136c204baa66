// Endless programs end by a limit, exit code 4, and say which.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

using Json = nlohmann::json;

namespace {

struct Bench : CommandBench {
    std::string endless = write("endless.nc", "O1\nN1 DPRNT[ABCDEFGHIJ]\nGOTO 1\nM30\n");
    std::string limit_of(const std::string& words) const {
        CHECK(trunnion(words + " --json") == 4);
        return Json::parse(read("out.txt"))["limit"];
    }
};

}  // namespace

TEST_CASE("an endless program ends by blocks, print-outs or time") {
    const Bench bench;
    CHECK(bench.limit_of("run " + bench.endless + " --max-blocks 1000") == "blocks");
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("stopped after 1000 blocks (--max-blocks)"));
    CHECK(bench.limit_of("run " + bench.endless + " --max-print 50000") == "printed_bytes");
    CHECK(bench.limit_of("run " + bench.endless + " --max-seconds 0.2") == "time");
    CHECK(bench.limit_of("run " + bench.endless) == "printed_bytes");
}

TEST_CASE("compensate ends an endless program and writes nothing") {
    const Bench bench;
    const std::string loop = bench.write("loop.nc", "O1\nG91\nN1 G0 X.01\nX-.01\nGOTO 1\nM30\n");
    CHECK(bench.trunnion("compensate " + loop + " --max-blocks 20000 --out " +
                         bench.file("c.nc")) == 4);
    CHECK_FALSE(std::filesystem::exists(bench.file("c.nc")));
    CHECK(bench.interrupted("compensate " + loop + " --max-blocks 0 --out " + bench.file("c.nc")) ==
          4);
    CHECK_FALSE(std::filesystem::exists(bench.file("c.nc")));
}

TEST_CASE("a loop over many empty lines obeys the limit and the interruption") {
    const Bench bench;
    std::string text = "O1\n";
    for (int k = 0; k < 400000; ++k) text += "N1\n";
    const std::string loop = bench.write("empty.nc", text + "GOTO 1\nM30\n");
    CHECK(bench.trunnion("run " + loop + " --max-blocks 1000") == 4);
    CHECK(bench.interrupted("run " + loop + " --max-blocks 0") == 4);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("(interrupted)"));
}
