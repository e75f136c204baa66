// Points are read beside the positions that the setup of their import declares: another geometry is
// refused where their values count.
#include <catch2/catch.hpp>

#include "tests/cli/command_bench.h"

namespace {

const std::string declared = "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n",
                  target =
                      "[[artefact]]\nname = \"R1\"\nkind = \"target\"\n"
                      "tool_mm = [0, 0, -150]\n",
                  instrument =
                      "[[instrument]]\nname = \"CMM\"\norigin_mm = [10, 0, 0]\n"
                      "free = [\"pose\"]\n";
const std::string points =
    "machine x,machine y,machine z,x measured,y measured,z measured\n"
    "0,0,0,10.001,0.002,-150.001\n100,0,0,110.004,0.001,-150.002\n0,100,0,10.002,100.001,-149.999\n"
    "100,100,0,110.003,100.003,-150.001\n0,0,100,10.001,0.001,-49.998\n"
    "100,0,100,110.005,0.002,-50.001\n0,100,100,10.002,100.001,-50.002\n"
    "100,100,100,110.003,100.002,-49.999\n";

struct Points : CommandBench {
    std::string setup = write("s.toml", declared + target + instrument), readings = file("r.csv");
    Points() {
        REQUIRE(trunnion("import points " + write("p.csv", points) + " --setup " + setup +
                         " --out " + readings) == 0);
    }
    std::string with(const std::string& text) const { return write("other.toml", text); }
    int identify(const std::string& table, const std::string& with) const {
        return trunnion("identify " + table + " --effects X.scale --setup " + with);
    }
    std::string without_head() const {
        std::string text = read("r.csv");
        for (std::size_t at; (at = text.find("# declared")) != text.npos;)
            text.erase(at, text.find('\n', at) + 1 - at);
        return write("plain.csv", text);
    }
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("points imported with another declared geometry are refused", "[cli][declared]") {
    const Points bench;
    CHECK(bench.identify(bench.readings, bench.setup) == 0);
    const std::string all = declared + target + instrument;
    for (const auto& [part, text] :
         {std::pair<std::string, std::string>{"target R1", replaced(all, "-150", "-151")},
          {"instrument CMM", replaced(all, "origin_mm = [10", "origin_mm = [11")},
          {"chain", replaced(all, "w b X Y Z t", "w X b Y Z t")}}) {
        INFO(part);
        const std::string other = bench.with(text);
        CHECK(bench.identify(bench.readings, other) == 2);
        CHECK_THAT(bench.read("err.txt"),
                   Catch::Contains("imported with another declared geometry (" + part + ")"));
        CHECK(bench.trunnion("diagnose " + bench.readings + " --setup " + other) == 2);
        CHECK(bench.trunnion("diagnose " + bench.without_head() + " --holdout " + bench.readings +
                             " --setup " + other) == 2);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains("another declared geometry"));
    }
    // What the points do not need may change; a table without the lines is taken as it is.
    CHECK(bench.identify(bench.readings, bench.with(all + replaced(target, "R1", "R2"))) == 0);
    CHECK(bench.identify(bench.without_head(), bench.with(replaced(all, "-150", "-151"))) == 0);
}

TEST_CASE("a setup that a fit wrote declares the same", "[cli][declared]") {
    const Points bench;
    const std::string fitted = bench.file("fitted.toml");
    REQUIRE(bench.trunnion("identify " + bench.readings + " --setup " + bench.setup +
                           " --effects X.scale --out " + fitted) == 0);
    CHECK(bench.identify(bench.readings, fitted) == 0);
}

TEST_CASE("predicted points stand beside the geometry that predicts them", "[cli][declared]") {
    const Points bench;
    const std::string other = bench.with(replaced(declared + target + instrument, "-150", "-151"));
    REQUIRE(bench.trunnion("predict " + bench.readings + " --setup " + other) == 0);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("another declared geometry (target R1)"));
    const std::string predicted = bench.write("predicted.csv", bench.read("out.txt"));
    CHECK(bench.identify(predicted, other) == 0);
    CHECK(bench.identify(predicted, bench.setup) == 2);
    CHECK(bench.identify(bench.readings + ' ' + predicted, bench.setup) == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("import both with one setup"));
}
