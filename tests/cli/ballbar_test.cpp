// trunnion ballbar: outputs, bad input, and the hand-over to diagnosis, as a user calls it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

std::string whole(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

struct Bench : CommandBench {
    /// The A-C machine that reads 20 times a second, with lines replaced.
    std::string setup(const std::string& from = "", const std::string& to = "") const {
        std::string text = whole(std::string(TRUNNION_SOURCE_DIR) + "/machines/ac_trunnion.toml");
        const std::string rate = "noise_um  = 0.5";
        text.replace(text.find(rate), rate.size(), rate + "\nsample_hz = 20");
        if (!from.empty()) {
            REQUIRE(text.find(from) != std::string::npos);
            text.replace(text.find(from), from.size(), to);
        }
        std::ofstream(path / "S.toml") << text;
        return file("S.toml");
    }
};

}  // namespace

TEST_CASE("ballbar writes table, JSON, CSV, readings and one plot a test") {
    const Bench bench;
    const std::string setup = "--setup " + bench.setup();
    REQUIRE(bench.trunnion("ballbar " + setup + " --svg " + bench.file("svg/new") + " --csv " +
                           bench.file("t.csv") + " --write-readings " + bench.file("r.csv") +
                           " --write-readings-after " + bench.file("a.csv") + " --json") == 0);
    const Json json = Json::parse(bench.read("out.txt"));
    CHECK(json["schema"] == "trunnion.ballbar/1");
    CHECK(json["errors"].size() == 8);
    CHECK(json["bar_length"]["reference_mm"] == 100.0);
    CHECK(json["time"]["one_setup_s"].get<double>() <
          0.6 * json["time"]["two_setups_s"].get<double>());
    std::istringstream csv(bench.read("t.csv"));
    std::string line;
    std::getline(csv, line);
    CHECK(line ==
          "where,name,before,u_before,after,u_after,change_percent,truly_left,"
          "published_before,unit");
    int lines = 0;
    for (; std::getline(csv, line); ++lines) CHECK(std::count(line.begin(), line.end(), ',') == 9);
    CHECK(lines == 16);
    int plots = 0;
    for (const auto& entry : fs::directory_iterator(bench.path / "svg/new")) {
        ++plots;
        const std::string svg = whole(entry.path());
        CAPTURE(entry.path().string());
        CHECK(svg.find("µm/div") != std::string::npos);
        CHECK(svg.find("fitted circle") != std::string::npos);
        CHECK(svg.find("feed-in and start") != std::string::npos);
        CHECK(svg.find("nan") == std::string::npos);
    }
    CHECK(plots == 7);
    CHECK(bench.read("r.csv").find("device") != std::string::npos);
    CHECK(bench.read("r.csv") != bench.read("a.csv"));
}

TEST_CASE("an injected tool length acts on the bar - the re-test misses it and the table says so") {
    const Bench bench;
    const std::string quiet = "ballbar --json --setup " +
                              bench.setup("noise_um  = 0.5", "noise_um  = 0.0") + " --inject ";
    REQUIRE(bench.trunnion(quiet + "'tool.length: error_mm=0.010'") == 0);
    const Json json = Json::parse(bench.read("out.txt"));
    const Json ez0a = json["errors"][1];
    REQUIRE(ez0a["name"] == "EZ0A");
    CHECK(ez0a["before"].get<double>() == Approx(-0.0202 + 0.010).margin(1e-5));
    CHECK(std::abs(ez0a["after"].get<double>()) < 1e-5);  // the same cup again: nothing to see
    CHECK(ez0a["truly_left"].get<double>() == Approx(-0.010).margin(1e-5));
    // (R - 1) times 10 um over A -30 to 90 degrees: the way of a tool of the right length.
    CHECK(json["true_tip_um"].get<double>() == Approx(10.0 * std::sqrt(2.0)).margin(0.05));
    CHECK(json["true_cup_um"].get<double>() < 0.05);
    // The injected length is the stylus's too, so the sphere agrees with the bar.
    CHECK(json["sphere_check"]["after_um"].get<double>() < 2.0);
    REQUIRE(bench.trunnion(quiet + "'location: EX0C_mm=0.02'") == 0);
    const Json moved = Json::parse(bench.read("out.txt"));
    REQUIRE(moved["errors"][4]["name"] == "EX0C");
    CHECK(moved["errors"][4]["before"].get<double>() == Approx(0.0483).margin(1e-5));
    CHECK(std::abs(moved["errors"][4]["truly_left"].get<double>()) < 1e-5);
    REQUIRE(bench.trunnion(quiet + "'X.scale: scale_ppm=50'") == 0);
    CHECK(Json::parse(bench.read("out.txt"))["true_tip_um"].get<double>() > 1.0);
}

TEST_CASE("a bar out of its range is said with line and test, and nothing is written") {
    const Bench bench;
    // 0.97 mm at the pivot stays within 1 mm, 1.2 mm leaves it in parts of the passes only.
    CHECK(bench.trunnion("ballbar --setup " + bench.setup("0.0283", "0.97")) == 0);
    CHECK(bench.trunnion("ballbar --setup " + bench.setup("0.0283", "1.2") + " --csv " +
                         bench.file("t.csv") + " --svg " + bench.file("svg")) == 2);
    const std::string err = bench.read("err.txt");
    CHECK(err.find("O8200.nc:") != std::string::npos);
    CHECK(err.find("out of its range of 1 mm (1.1") != std::string::npos);
    CHECK(err.find("in test zx_ccw_2000") != std::string::npos);
    CHECK(bench.read("out.txt").empty());
    CHECK_FALSE(fs::exists(bench.file("t.csv")));
    CHECK_FALSE(fs::exists(bench.file("svg")));
}

TEST_CASE("bad options and setups of ballbar end with 2 and say why") {
    const Bench bench;
    const std::string machines = std::string(TRUNNION_SOURCE_DIR) + "/machines/";
    const std::string good = bench.setup();
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"--bogus", "--bogus"},
        {"--seed x", "--seed"},
        {"--seed -1", "--seed"},
        {"--setup-time -5", "--setup-time"},
        {"--remount-time -1", "--remount-time"},
        {"--pivot-offset 1,2", "--pivot-offset"},
        {"--inject 'C.backlash: gap=1'", "no parameter 'gap'"},
        {"--setup " + bench.file("none.toml"), "cannot be read"},
        {"--setup " + machines + "head_table.toml", "two rotary axes under the table"},
        {"--setup " + machines + "nutating_table.toml", "tilting axis"},
        {"--setup " + good + " --csv /nowhere/t.csv", "/nowhere/t.csv"},
        {"--setup " + good + " --svg /proc/nowhere", "/proc/nowhere"}};
    for (const auto& [words, why] : cases) {
        CAPTURE(words);
        CHECK(bench.trunnion("ballbar " + words) == 2);
        CAPTURE(bench.read("err.txt"));
        CHECK(bench.read("err.txt").find(why) != std::string::npos);
    }
    CHECK(bench.trunnion("ballbar --setup " + bench.setup("length_mm = 100.0", "length_mm = -1")) ==
          2);
    CHECK(bench.read("err.txt").find("above zero") != std::string::npos);
    CHECK(bench.trunnion("ballbar --setup " +
                         bench.setup("length_mm = 100.0", "temperature_c = \"warm\"")) == 2);
    CHECK(bench.read("err.txt").find("S.toml:") != std::string::npos);
}

TEST_CASE("what location errors do not explain goes to diagnose - which names it, or nothing") {
    const Bench bench;
    const std::string setup = bench.setup();
    const std::string readings = bench.file("r.csv");
    const auto diagnose = [&](const std::string& injection, const std::string& seed) {
        REQUIRE(bench.trunnion("ballbar --setup " + setup + " --seed " + seed +
                               " --write-readings " + readings +
                               (injection.empty() ? "" : " --inject '" + injection + "'")) == 0);
        const std::string table = bench.read("out.txt");
        CHECK((table.find("only noise remains") != std::string::npos) == injection.empty());
        CHECK((table.find("trunnion diagnose") != std::string::npos) != injection.empty());
        REQUIRE(bench.trunnion("diagnose " + readings + " --setup " + setup + " --json") == 0);
        return Json::parse(bench.read("out.txt"));
    };
    for (const char* seed : {"1", "2", "3"}) {
        const Json null = diagnose("", seed);
        CAPTURE(seed, null.dump());
        CHECK(null["verdict"] == "no-gap");
        CHECK(null["causes"].empty());
    }
    struct Case {
        const char *injection, *effect;
        double value;
    };
    for (const Case& c : {Case{"XY.squareness: angle_rad=40e-6", "XY.squareness", 40e-6},
                          Case{"X.backlash: gap_mm=0.006", "X.backlash", 0.006},
                          Case{"Y.scale: scale_ppm=30", "Y.scale", 30.0}}) {
        const Json json = diagnose(c.injection, "1");
        CAPTURE(c.injection, json.dump());
        REQUIRE_FALSE(json["causes"].empty());
        CHECK(json["causes"][0]["effect"] == c.effect);
        const auto& first = json["causes"][0]["parameters"][0];
        CHECK(std::abs(first["value"].get<double>() - c.value) <
              4.0 * first["sigma"].get<double>() + 0.005 * c.value);
    }
}
