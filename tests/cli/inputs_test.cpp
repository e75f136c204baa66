// Every JSON result and every page names the files that it was made from, by the hash of the bytes
// that were read.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>

#include "base/read_file.h"
#include "base/sha256.h"
#include "tests/cli/command_bench.h"

using Json = nlohmann::json;
using trunnion::sha256;

namespace {

struct Bench : CommandBench {
    std::string part = write("part.nc", "O1\nG90 G21 G54\nG1 X10. F500.\nM98 P77\nM30\n");
    std::string other = write("other.nc", "O1\nG90 G21 G54\nG1 X11. F500.\nM30\n");
    std::string sub = write("O0077.nc", "O77\nG1 X20.\nM99\n");
    std::string setup = [this] {
        std::filesystem::copy_file(TRUNNION_SOURCE_DIR "/machines/bc_table.toml", file("m.toml"));
        return file("m.toml");
    }();
    std::string table = [this] {
        std::string text =
            "# schema = trunnion.readings/1\nindex,time_s,test,device,feature,x_mm,y_mm,z_mm,b_deg,"
            "c_deg,dir_x,dir_y,dir_z,value_mm\n";
        for (int k = 0; k < 36; ++k) {
            const double c_rad = k * std::numbers::pi / 18.0;
            text += std::to_string(k) + "," + std::to_string(k) + ",t,sphere,S1," +
                    std::to_string(120.0 * std::cos(c_rad)) + "," +
                    std::to_string(-120.0 * std::sin(c_rad)) + ",230,0," + std::to_string(10 * k) +
                    (k % 2 == 0 ? ",1,0,0,0.00" : ",0,1,0,0.00") + std::to_string(k % 7) + "\n";
        }
        return write("table.csv", text);
    }();

    /// Path to hash, as the JSON on stdout tells.
    std::map<std::string, std::string> inputs(const std::string& words) const {
        INFO(words);
        CHECK(trunnion(words) < 2);
        INFO(read("err.txt"));
        std::map<std::string, std::string> list;
        const Json json = Json::parse(read("out.txt"));
        for (const Json& input : json.at("inputs")) list[input["path"]] = input["sha256"];
        return list;
    }
    /// All of these files, each by the hash of its text, and no other.
    void tells(const std::string& words, const std::vector<std::string>& paths) const {
        const auto list = inputs(words);
        INFO(words);
        CHECK(list.size() == paths.size());
        for (const std::string& path : paths) {
            INFO(path);
            REQUIRE(list.count(path) == 1);
            CHECK(list.at(path) == sha256(trunnion::read_file(path)));
        }
    }
};

}  // namespace

TEST_CASE("the JSON of every command names all that it read, by hash") {
    const Bench b;
    const std::string with = " --json --setup " + b.setup;
    b.tells("run " + b.part + with, {b.part, b.sub, b.setup});
    b.tells("check " + b.part + " --format json --setup " + b.setup, {b.part, b.sub, b.setup});
    b.tells("compare " + b.part + " " + b.other + with, {b.part, b.other, b.sub, b.setup});
    b.tells("compensate " + b.part + with + " --out " + b.file("c.nc"), {b.part, b.sub, b.setup});
    b.tells("volumetric --grid 2 --rotary-grid 1" + with, {b.setup});
    b.tells("effects" + with, {b.setup});
    b.tells("predict " + b.table + with, {b.table, b.setup});
    b.tells("identify " + b.table + with + " --effects C.backlash", {b.table, b.setup});
    const std::string held = b.write(
        "held.csv", std::regex_replace(b.read("table.csv"), std::regex(",0[.]00"), ",0.01"));
    b.tells("diagnose " + b.table + with + " --holdout " + held, {b.table, held, b.setup});
    const std::string log = b.file("log.csv");
    REQUIRE(b.trunnion("run " + b.other + " --setup " + b.setup + " --trace " + log) == 0);
    b.tells("diagnose " + log + " --program " + b.other + with, {log, b.other, b.setup});  // a row
    CHECK(b.inputs("pivot" + with).count(b.setup) == 1);
    CHECK(b.inputs("pivot" + with).size() > 1);  // the programs of the test
}

TEST_CASE("the hash is that of the bytes that were read, from standard input too") {
    const Bench b;
    const auto list = b.inputs("run - --json --setup " + b.setup + " < " + b.other);
    CHECK(list.at("standard input") == sha256(trunnion::read_file(b.other)));
}

TEST_CASE("merged parts name the files of the shards as one process does") {
    const Bench b;
    const std::string suite = b.write("s.toml",
                                      "schema = \"trunnion.suite/1\"\n"
                                      "[[case]]\nname = \"a\"\nprogram = \"part.nc\"\n"
                                      "against = \"part.nc\"\n"
                                      "[[case]]\nname = \"b\"\nprogram = \"other.nc\"\n"
                                      "against = \"part.nc\"\n");
    const std::string words = "compare --suite " + suite + " --setup " + b.setup;
    CHECK(b.trunnion(words + " --json") == 1);
    const std::string whole = b.read("out.txt");
    CHECK(b.trunnion(words + " --json --threads 4") == 1);
    CHECK(b.read("out.txt") == whole);
    for (const char* shard : {"1/2", "2/2"})
        CHECK(b.trunnion(words + " --out " + b.file("p{i}.json") + " --shard " + shard) < 2);
    CHECK(b.trunnion("merge " + b.file("p1.json") + " " + b.file("p2.json") + " --format json") ==
          1);
    CHECK(b.read("out.txt") == whole);
    CHECK(Json::parse(whole)["inputs"].size() == 5);
}

TEST_CASE("a page names the same files") {
    const Bench b;
    CHECK(b.trunnion("run " + b.part + " --setup " + b.setup + " --html " + b.file("r.html")) == 0);
    for (const std::string& path : {b.part, b.sub, b.setup})
        CHECK_THAT(b.read("r.html"), Catch::Contains(sha256(trunnion::read_file(path))));
}
