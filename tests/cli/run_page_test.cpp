// trunnion run --html: one file, the same bytes, its inputs by hash.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <sstream>

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
    CHECK_THAT(bench.read("p.html"), Catch::Contains("The control stopped with "));
    CHECK(bench.trunnion("run " + bench.file("t.nc") + " --html " + bench.file("t.nc")) == 2);
    CHECK_THAT(bench.read("t.nc"), Catch::StartsWith("O2"));
}

TEST_CASE("a page of 200,000 blocks stays below 2 MB and keeps the block of the worst place") {
    const CommandBench bench;
    std::string text = "O1\nG21 G90 G17 G94 G54\nG0 X0 Y0 Z10. A0 C0\nG1 F1000.\n";
    for (int k = 0; k < 199'900; ++k)
        text += fmt::format("X{:.4f} Y{:.4f} Z{:.4f}\n", 100.0 * std::sin(1e-4 * k),
                            100.0 * std::cos(3.7e-4 * k), 20.0 * std::sin(0.91 * k));
    const std::string words = "run " + bench.write("long.nc", text + "M30\n") + " --setup " +
                              TRUNNION_SOURCE_DIR + "/machines/ac_trunnion.toml --html " +
                              bench.file("p.html");
    REQUIRE(bench.trunnion(words) == 0);
    const std::string page = bench.read("p.html");
    CHECK(page.size() < 2'000'000);
    const std::size_t at = page.find("long.nc:") + 8;
    const int line = std::stoi(page.substr(at, 8));
    std::istringstream lines(text);
    std::string block;
    for (int k = 0; k < line; ++k) std::getline(lines, block);
    CHECK_THAT(page, Catch::Contains("\"" + block + "\""));
}
