// --html of every command: one template, verdict first, origin in the foot, the same bytes again.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

namespace {

const std::string root = TRUNNION_SOURCE_DIR;

struct Bench : CommandBench {
    /// Writes the page twice; what every page has.
    std::string page_of(const std::string& words, int code = 0) const {
        CAPTURE(words);
        REQUIRE(trunnion(words + " --html " + file("page.html")) == code);
        const std::string page = read("page.html");
        for (const char* text : {"<!DOCTYPE html>", "Content-Security-Policy", "default-src 'none'",
                                 "<h1>", "class=\"verdict", "How to read this", "<footer>",
                                 "Made by <code>trunnion ", "SHA-256"})
            CHECK_THAT(page, Catch::Contains(text));
        CHECK(page.find("class=\"verdict") < page.find("<section>"));
        CHECK_THAT(page, !Catch::Contains("nan") && !Catch::Contains("src=\"http"));
        REQUIRE(trunnion(words + " --html " + file("page.html")) == code);
        CHECK(read("page.html") == page);
        return page;
    }
};

}  // namespace

TEST_CASE("pages of check, compensate and volumetric say their verdict first") {
    const Bench bench;
    const std::string bracket = root + "/programs/examples/bracket_g43_4.nc";
    CHECK_THAT(bench.page_of("check " + bracket), Catch::Contains("Nothing found."));
    bench.write("bad.nc", "O1\nG0 X\nM30\n");
    CHECK_THAT(bench.page_of("check " + bench.file("bad.nc"), 1),
               Catch::Contains("1 error and 0 warnings found") && Catch::Contains("bad.nc:2:"));
    CHECK_THAT(bench.page_of("compensate " + bracket + " --out " + bench.file("c.nc")),
               Catch::Contains("The tip error falls from 421 µm to 0.001 µm"));
    CHECK_THAT(
        bench.page_of("volumetric --grid 3 --rotary-grid 3 --setup " + root +
                      "/machines/ac_trunnion.toml"),
        Catch::Contains("The largest tip error is") && Catch::Contains("<title>Error of the tool"));
}

TEST_CASE("the page of ballbar shows errors, proof, numbers to type and polar plots") {
    const Bench bench;
    std::ostringstream text;
    text << std::ifstream(root + "/machines/ac_trunnion.toml").rdbuf();
    std::string setup = text.str();
    const std::string rate = "noise_um  = 0.5";
    setup.replace(setup.find(rate), rate.size(), rate + "\nsample_hz = 8");
    const std::string page = bench.page_of("ballbar --setup " + bench.write("S.toml", setup));
    for (const char* words : {"Largest errors found: EY0C", "truly left", "What to type", "Proof",
                              "seed 1", "<title>Radial test of A", "µrad"})
        CHECK_THAT(page, Catch::Contains(words));
}

TEST_CASE("the page of identify shows intervals, correlations and residuals") {
    const Bench bench;
    const std::string setup = root + "/machines/bc_table.toml";
    REQUIRE(bench.trunnion("pivot --write-programs " + bench.file("nc")) == 0);
    REQUIRE(bench.trunnion("run " + bench.file("nc/O8003.nc") + " --programs " + bench.file("nc") +
                           " --readings " + bench.file("r.csv")) == 0);
    const std::string page =
        bench.page_of("identify " + bench.file("r.csv") + " --effects location --setup " + setup);
    for (const char* words : {"95 % interval", "What goes together", "Residuals over time",
                              "Residuals over B / deg", "EX0B"})
        CHECK_THAT(page, Catch::Contains(words));
}

TEST_CASE("volumetric and compensate give one JSON object with what they print") {
    using Json = nlohmann::json;
    const Bench bench;
    REQUIRE(bench.trunnion("volumetric --grid 3 --rotary-grid 3 --json --setup " + root +
                           "/machines/ac_trunnion.toml") == 0);
    const Json map = Json::parse(bench.read("out.txt"));
    CHECK(map["schema"] == "trunnion.volumetric/1");
    CHECK(map["poses"] == 243);
    const double worst = map["worst"]["error_um"].get<double>();
    CHECK(worst > 100.0);
    CHECK(worst >= map["rms_um"].get<double>());
    CHECK(map["worst"]["at"].size() == 5);
    double share = 0.0;
    for (const Json& cause : map["causes"]) share += cause["share"].get<double>();
    CHECK(share == Approx(1.0));
    const std::string part = "compensate " + root + "/programs/examples/bracket_g43_4.nc --json";
    REQUIRE(bench.trunnion(part + " --out " + bench.file("c.nc")) == 0);
    const Json c = Json::parse(bench.read("out.txt"));
    CHECK(c["schema"] == "trunnion.compensate/1");
    CHECK(c["blocks"].get<int>() > 10);
    CHECK(c["after"]["tip_um"].get<double>() < 0.05);
    CHECK(bench.trunnion(part) == 2);  // the program and the object cannot share stdout
}
