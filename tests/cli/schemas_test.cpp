// docs/schemas: what every command prints with --json is what its schema says.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/cli/command_bench.h"
#include "tests/cli/json_schema.h"

namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

const std::string source = TRUNNION_SOURCE_DIR;

std::string machine(const std::string& name) {
    return source + "/machines/" + name + ".toml";
}

std::string bracket(const std::string& name) {
    return source + "/programs/examples/bracket_" + name + ".nc";
}

std::string instrument(const std::string& name) {
    return source + "/docs/instruments/" + name;
}

JsonSchema schema(const std::string& name) {
    std::ifstream file(source + "/docs/schemas/" + name + ".json");
    return JsonSchema(Json::parse(file));
}

/// Runs the command with --json and holds its output against the schema; the exit code is free.
Json held(const CommandBench& bench, const std::string& name, const std::string& words) {
    INFO(words);
    bench.trunnion(words + " --json");
    const Json printed = Json::parse(bench.read("out.txt"), nullptr, false);
    INFO(bench.read("err.txt"));
    REQUIRE_FALSE(printed.is_discarded());
    std::string faults;
    for (const std::string& fault : schema(name).faults(printed)) faults += fault + '\n';
    INFO(faults);
    CHECK(faults.empty());
    return printed;
}

/// Readings of the shipped program O8002 on a machine with an effect.
std::string touches(const CommandBench& bench, const std::string& effect) {
    const std::string file = bench.file("touches.csv");
    REQUIRE(bench.trunnion("run O8002 --readings " + file + " --inject '" + effect + "'") == 0);
    return file + " --setup " + machine("bc_table");
}

}  // namespace

TEST_CASE("schemas: the test's validator finds what is missing, wrong or not described") {
    const JsonSchema run = schema("compensate");
    Json good{{"schema", "trunnion.compensate/1"}, {"blocks", 3}, {"notes", Json::array()}};
    good["before"] = good["after"] =
        good["in_gap"] = {{"tip_um", 1.5}, {"turned_urad", 0}, {"kept_urad", 0.0}};
    CHECK(run.faults(good).empty());
    const auto with = [&](const std::string& key, const Json& value) {
        Json other = good;
        other[key] = value;
        return run.faults(other).size();
    };
    CHECK(with("schema", "trunnion.compensate/2") == 1);
    CHECK(with("blocks", 1.5) == 1);
    CHECK(with("blocks", -1) == 1);
    CHECK(with("notes", {1, "word"}) == 1);
    CHECK(with("more", 1) == 1);
    good.erase("in_gap");
    CHECK(run.faults(good).size() == 1);
}

TEST_CASE("schemas: every command that takes --json has one") {
    const CommandBench bench;
    const std::vector<std::pair<std::string, std::string>> names{{"run", "run"},
                                                                 {"check", "check"},
                                                                 {"compare", "compare"},
                                                                 {"merge", "compare"},
                                                                 {"pivot", "pivot"},
                                                                 {"ballbar", "ballbar"},
                                                                 {"effects", "effects"},
                                                                 {"identify", "identification"},
                                                                 {"import", "import"},
                                                                 {"diagnose", "diagnosis"},
                                                                 {"predict", "prediction"},
                                                                 {"compensate", "compensate"},
                                                                 {"volumetric", "volumetric"}};
    REQUIRE(bench.trunnion("completion bash") == 0);
    std::istringstream lines(bench.read("out.txt"));
    std::size_t found = 0;
    for (const auto& [command, name] : names) {
        INFO(command);
        REQUIRE(bench.trunnion(command + " --help") == 0);
        CHECK_THAT(bench.read("out.txt"), Catch::Contains("--json"));
        CHECK(fs::exists(source + "/docs/schemas/" + name + ".json"));
    }
    for (std::string line; std::getline(lines, line);)
        found += line.find("--json") != std::string::npos ? 1 : 0;
    CHECK(found == names.size());
}

TEST_CASE("schemas: run, check and compare") {
    const CommandBench bench;
    held(bench, "run", "run " + bracket("g43_4"));
    const std::string bad = bench.write("bad.nc", "O1\n#100=3.\nG0X1.\nG999\nM30\n");
    CHECK(held(bench, "run", "run " + bad + " --vars 100-101")["status"] == "alarm");
    const std::string loop = bench.write("loop.nc", "O1\nN1GOTO1\nM30\n");
    CHECK(held(bench, "run", "run " + loop + " --max-blocks 100")["limit"] == "blocks");
    CHECK(held(bench, "check", "check " + bad)["findings"].size() == 1);
    CHECK(held(bench, "compare", "compare " + bracket("g43_4") + " " + bracket("g68_2"))["equal"]);
    held(bench, "compare", "compare " + bracket("g43_4") + " " + bracket("post"));
    held(bench, "compare", "compare " + bad + " " + bracket("post"));
    fs::create_directories(bench.path / "other");
    fs::copy_file(bracket("post"), bench.path / "other/bracket_g43_4.nc");
    const std::string folders = source + "/programs/examples " + bench.file("other");
    CHECK(held(bench, "compare", "compare " + folders)["cases"].size() == 3);
    bench.trunnion("compare " + folders + " --shard 1/1 --out " + bench.file("part.json"));
    held(bench, "compare", "merge " + bench.file("part.json"));
}

TEST_CASE("schemas: pivot, ballbar, volumetric, compensate and effects") {
    const CommandBench bench;
    held(bench, "pivot", "pivot");
    held(bench, "pivot", "pivot " + touches(bench, "pivot.g54: dg_mm=[0.03, 0, 0.02]"));
    const std::string ac = " --setup " + machine("ac_trunnion"), csv = bench.file("bar.csv");
    held(bench, "ballbar", "ballbar --write-readings " + csv + ac);
    held(bench, "ballbar", "ballbar " + csv + ac);
    held(bench, "volumetric", "volumetric" + ac);
    held(bench, "compensate", "compensate " + bracket("g43_4") + " --out " + bench.file("c.nc"));
    held(bench, "effects", "effects");
}

TEST_CASE("schemas: a control's log") {
    const CommandBench bench;
    const std::string csv = bench.file("log.csv"), setup = " --setup " + instrument("machine.toml");
    held(bench, "import",
         "import axis-log " + instrument("control_log.csv") + " --out " + csv + setup);
    const Json gap =
        held(bench, "diagnosis",
             "diagnose " + csv + " --program " + instrument("control_part.nc") + setup);
    CHECK(gap["of"] == "control");
    CHECK(gap["causes"].size() > 0);
}

TEST_CASE("schemas: import, predict, identify and diagnose") {
    const CommandBench bench;
    const std::string csv = bench.file("laser.csv"), setup = " --setup " + instrument("bench.toml");
    held(bench, "import", "import iso230-2 " + instrument("laser_x.txt") + " --out " + csv + setup);
    held(bench, "identification", "identify " + csv + setup + " --effects X.scale");
    const Json laser = held(bench, "diagnosis", "diagnose " + csv + setup);
    CHECK(laser["causes"].size() > 0);
    const std::string worn = touches(bench, "C.positioning: cos2_rad=4e-5");
    held(bench, "prediction", "predict " + worn);
    CHECK(held(bench, "prediction", "predict " + worn + " --effects C.tilt")["jacobian"]["rows"]
              .size() == 603);
    held(bench, "identification", "identify " + worn + " --monte-carlo 3");
    held(bench, "identification", "identify " + worn + " --effects pivot.p1970x");
    held(bench, "diagnosis", "diagnose " + worn);
}

TEST_CASE("schemas: diagnose over sessions says since when") {
    const CommandBench bench;
    std::string files;
    for (const auto& [day, effect] : {std::pair{"monday", "C.positioning: cos2_rad=0"},
                                      {"friday", "C.positioning: cos2_rad=8e-5"}}) {
        const std::string file = bench.file(std::string(day) + ".csv");
        REQUIRE(bench.trunnion("run O8002 --readings " + file + " --inject '" + effect + "'") == 0);
        files += " " + file;
    }
    const Json json = held(bench, "diagnosis",
                           "diagnose" + files + " --over sessions --setup " + machine("bc_table"));
    REQUIRE(json["causes"].size() == 1);
    CHECK(json["causes"][0]["since"] == "friday");
    CHECK(json["over"]["sessions"].size() == 2);
}

TEST_CASE("schemas: diagnose --program") {
    const CommandBench bench;
    const std::string words = "diagnose " + instrument("control_log.csv") + " --program " +
                              instrument("control_part.nc") + " --setup ";
    CHECK(held(bench, "control_gap", words + instrument("machine.toml"))["causes"].size() == 2);
}
