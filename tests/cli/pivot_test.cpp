// trunnion pivot and ballbar with readings, as a shop calls them: prints in, verdict out, bad
// input.
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

const std::string machines = std::string(TRUNNION_SOURCE_DIR) + "/machines/";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    REQUIRE(text.find(from) != std::string::npos);
    return text.replace(text.find(from), from.size(), to);
}

std::string whole(const std::string& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("pivot: what the programs print tells the stale store - without the simulator's truth") {
    const CommandBench bench;
    // The machine as it is: G54 as shipped, 1970x right.
    std::string text = whole(machines + "bc_table.toml");
    for (const char* line :
         {"19700 = 0.1443", "19701 = 0.1443", "19702 = 0.0534", "19705 = 0.0909"})
        text = replaced(text, line, std::string(line).substr(0, 8) + "0.0");
    const std::string real = bench.write("real.toml", text);
    REQUIRE(bench.trunnion("pivot --setup " + real + " --print " + bench.file("p.txt")) == 0);
    // The shop's setup knows other stores: those printed count.
    const std::string shop = machines + "bc_table.toml";
    REQUIRE(bench.trunnion("pivot " + bench.file("p.txt") + " --setup " + shop + " --json") == 0);
    const Json json = Json::parse(bench.read("out.txt"));
    CHECK(bench.read("err.txt").find("the printed value is used") != std::string::npos);
    CHECK(json["schema"] == "trunnion.pivot/1");
    for (const Json& store : json["stores"]) {
        CAPTURE(store.dump());
        CHECK(store["stale"].get<bool>() == (store["name"] == "G54"));
        if (store["name"] == "G54") {
            CHECK(std::abs(store["type_mm"].get<double>()) < 1.6e-3);
            CHECK(store["error_mm"].get<double>() == Approx(0.1443).margin(1.5e-3));
        }
    }
    CHECK(json["verdict"].get<std::string>().find("G54 as the pivot is stale") == 0);
    CHECK(json["unobservable"].size() >= 3);
    CHECK(json["maps"].size() == 4);
    CHECK(json["maps"][0]["functions"]["DPP"]["points"].size() == 13);
    CHECK(json["agree_after_typing_um"].get<double>() < 3.0);
}

TEST_CASE("pivot: a table of touches says the same as the prints") {
    const CommandBench bench;
    REQUIRE(bench.trunnion("pivot --write-programs " + bench.file("nc") + " --setup " + machines +
                           "bc_table.toml") == 0);
    std::string tables;
    for (const char* program : {"O8001", "O8003"}) {
        REQUIRE(bench.trunnion("run " + bench.file("nc/" + std::string(program) + ".nc") +
                               " --programs " + bench.file("nc") + " --setup " + machines +
                               "bc_table.toml --readings " + bench.file(program)) == 0);
        tables += " " + bench.file(program);
    }
    REQUIRE(bench.trunnion("pivot" + tables + " --setup " + machines + "bc_table.toml --json") ==
            0);
    const Json json = Json::parse(bench.read("out.txt"));
    for (const Json& group : json["groups"]) CHECK(group["stale"] == true);
    for (const Json& store : json["stores"])
        if (store["name"] == "G54")
            CHECK(store["error_mm"].get<double>() == Approx(0.1443).margin(1.5e-3));
}

TEST_CASE("pivot: the shop's programs that a stale store reaches are listed") {
    const CommandBench bench;
    fs::create_directories(bench.file("shop"));
    bench.write("shop/tcp.nc", "O1 (G54.2 IS NOT USED)\nG43.4 H1\nX1. B30.\nM30\n");
    bench.write("shop/flat.nc", "O2\nG1 X1. Y2.\nM30\n");
    bench.write("shop/post.nc", "O3\nG54\nG0 X1. B30. C10.\nM30\n");
    REQUIRE(bench.trunnion("pivot --json --programs " + bench.file("shop")) == 0);
    std::string found;
    const Json json = Json::parse(bench.read("out.txt"));
    for (const Json& part : json["affected"])
        if (!part["program"].is_null())
            found += fs::path(part["program"].get<std::string>()).filename().string() + " " +
                     part["function"].get<std::string>() + ";";
    CHECK(found == "post.nc DPP;tcp.nc RTCP;");
}

TEST_CASE("pivot: bad input ends with 2 and one message, nothing is overwritten") {
    const CommandBench bench;
    const std::string setup = " --setup " + machines + "bc_table.toml";
    REQUIRE(bench.trunnion("pivot --print " + bench.file("p.txt")) == 0);
    const std::string prints = bench.read("p.txt");
    bench.write("noise.txt", "hello\n");
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"pivot " + bench.file("p.txt"), "need the machine that they come from"},
        {"pivot " + bench.file("noise.txt") + setup, "no prints of the pivot programs"},
        {"pivot --setup " + machines + "mill_xy_table.toml", "two rotary axes"}};
    for (const auto& [words, why] : cases) {
        CAPTURE(words);
        CHECK(bench.trunnion(words) == 2);
        CAPTURE(bench.read("err.txt"));
        CHECK(bench.read("err.txt").find(why) != std::string::npos);
        CHECK(bench.read("p.txt") == prints);
    }
}

TEST_CASE("ballbar: passes of a real machine, before and after; its file stays as it is") {
    const CommandBench bench;
    std::string text = replaced(whole(machines + "ac_trunnion.toml"), "noise_um  = 0.5",
                                "noise_um  = 0.5\nsample_hz = 20");
    const std::string setup = bench.write("S.toml", text);
    REQUIRE(bench.trunnion("ballbar --setup " + setup + " --write-readings " + bench.file("b.csv") +
                           " --write-readings-after " + bench.file("a.csv") + " --json") == 0);
    const Json simulated = Json::parse(bench.read("out.txt"));
    CHECK(simulated["true_tip_um"].get<double>() < 3.0);
    CHECK(simulated["sphere_check"]["after_um"].get<double>() < 2.0);
    CHECK(simulated["sphere_check"]["before_um"].get<double>() > 50.0);
    const std::string before = bench.read("b.csv");
    REQUIRE(bench.trunnion("ballbar " + bench.file("b.csv") + " --setup " + setup + " --json") ==
            0);
    const Json measured = Json::parse(bench.read("out.txt"));
    REQUIRE(measured["errors"].size() == 8);
    for (std::size_t i = 0; i < 8; ++i) {
        CHECK(measured["errors"][i]["before"].get<double>() ==
              Approx(simulated["errors"][i]["before"].get<double>()).margin(1e-12));
        CHECK(measured["errors"][i]["after"].is_null());
    }
    CHECK(measured["circularity"].size() == 3);
    REQUIRE(bench.trunnion("ballbar " + bench.file("b.csv") + " " + bench.file("a.csv") +
                           " --setup " + setup + " --svg " + bench.file("svg")) == 0);
    CHECK(bench.read("out.txt").find("measured ballbar passes") != std::string::npos);
    CHECK(bench.read("b.csv") == before);
    CHECK(bench.trunnion("ballbar " + bench.file("b.csv")) == 2);
    CHECK(bench.read("err.txt").find("--setup") != std::string::npos);
    CHECK(bench.trunnion("ballbar --readings " + bench.file("b.csv")) == 2);
    CHECK(bench.read("b.csv") == before);
}
