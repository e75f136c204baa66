// trunnion run --html: one file, the same bytes, its inputs by hash.
#include <catch2/catch.hpp>

#include "tests/cli/command_bench.h"

namespace fs = std::filesystem;

namespace {

const std::string program = "O2\nG90 G54 G0 X10. Y0\nG1 X20. F100.\nG2 X30. Y10. R10.\nM30\n";

}  // namespace

TEST_CASE("run --html writes one page: verdict, command, inputs by hash, no date") {
    const CommandBench bench;
    bench.write("t.nc", program);
    const std::string words = "run " + bench.file("t.nc") + " --html " + bench.file("p.html");
    REQUIRE(bench.trunnion(words) == 0);
    const std::string page = bench.read("p.html");
    CHECK_THAT(page, Catch::Contains("The program ran to its end.") &&
                         Catch::Contains("Made by <code>trunnion run ") &&
                         Catch::Contains("machines/bc_table.toml</code> SHA-256") &&
                         Catch::Contains("Content-Security-Policy"));
    CHECK_THAT(page, !Catch::Contains("http://") || !Catch::Contains("src=\"http"));
    CHECK(page.find("2026-") == std::string::npos);
    REQUIRE(bench.trunnion(words) == 0);
    CHECK(bench.read("p.html") == page);
    REQUIRE(bench.trunnion(words + " --date 2026-01-02") == 0);
    CHECK_THAT(bench.read("p.html"), Catch::Contains("2026-01-02"));
}

TEST_CASE("run --html of a program that alarms shows the alarm; --html never overwrites an input") {
    const CommandBench bench;
    bench.write("t.nc", "O2\nG0 X10.\nG1 X20.\nM30\n");
    CHECK(bench.trunnion("run " + bench.file("t.nc") + " --html " + bench.file("p.html")) == 3);
    CHECK_THAT(bench.read("p.html"), Catch::Contains("The control stopped with alarm"));
    CHECK(bench.trunnion("run " + bench.file("t.nc") + " --html " + bench.file("t.nc")) == 2);
    CHECK_THAT(bench.read("t.nc"), Catch::StartsWith("O2"));
}
