// What the README shows first must do what it says.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

namespace {

const std::string source = TRUNNION_SOURCE_DIR;

std::string readme() {
    std::ostringstream text;
    text << std::ifstream(source + "/README.md").rdbuf();
    return text.str();
}

std::string example(const std::string& name) {
    return "programs/examples/bracket_" + name + ".nc";
}

/// `words` as the README has them, run from the source folder.
int run_as_shown(const CommandBench& bench, const std::string& words, const std::string& more) {
    CHECK_THAT(readme(), Catch::Contains("\n$ trunnion " + words + "\n"));
    std::filesystem::current_path(source);
    return bench.trunnion(words + more);
}

}  // namespace

TEST_CASE("README: the first program runs and its trace says where the tip was") {
    const CommandBench bench;
    const std::string words = "run " + example("g43_4") + " --trace path.csv --truth";
    CHECK_THAT(readme(), Catch::Contains("\n$ trunnion " + words + "\n"));
    std::filesystem::current_path(source);
    REQUIRE(bench.trunnion("run " + example("g43_4") + " --truth --trace " +
                           bench.file("path.csv")) == 0);
    CHECK_THAT(bench.read("path.csv"), Catch::Contains("true_z_mm"));
}

TEST_CASE("README: G43.4 against G68.2 is equal, against a post that trusts G54 it is not") {
    const CommandBench bench;
    const auto verdict = [&](const std::string& other, int code) {
        CHECK(run_as_shown(bench, "compare " + example("g43_4") + " " + example(other),
                           " --json") == code);
        return nlohmann::json::parse(bench.read("out.txt"));
    };
    const auto equal = verdict("g68_2", 0);
    CHECK(equal["equal"] == true);
    CHECK(equal["worst"]["position_mm"].get<double>() < 0.00025);
    const auto moved = verdict("post", 1);
    CHECK(moved["worst"]["position_mm"].get<double>() == Approx(0.0472).margin(0.0001));
    CHECK_THAT(readme(), Catch::Contains("four of eight holes move, by up to 0.047 mm") &&
                             Catch::Contains("equal within 0.0002 mm"));
}
