// The terminal: help that fits, examples, words that were meant, completion from the own options.
#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

namespace {

const std::vector<std::string> commands{"backup",     "ballbar",    "check",    "compare",
                                        "compensate", "completion", "diagnose", "effects",
                                        "help",       "identify",   "import",   "merge",
                                        "pivot",      "predict",    "run",      "volumetric"};

std::size_t places(const std::string& line) {
    return static_cast<std::size_t>(std::count_if(line.begin(), line.end(), [](char c) {
        return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
    }));
}

/// The longest line of what was written to stdout.
std::string longest(const CommandBench& bench) {
    std::istringstream in(bench.read("out.txt"));
    std::string longest, line;
    while (std::getline(in, line))
        if (places(line) > places(longest)) longest = line;
    return longest;
}

}  // namespace

TEST_CASE("help of every command fits in 80 columns and has an example") {
    const CommandBench bench;
    REQUIRE(bench.trunnion("--help") == 0);
    const std::string all = bench.read("out.txt");
    CHECK(places(longest(bench)) <= 80);
    for (const std::string& command : commands) {
        CAPTURE(command);
        CHECK_THAT(all, Catch::Contains("\n  " + command + " "));
        REQUIRE(bench.trunnion(command + " --help") == 0);
        CAPTURE(longest(bench));
        CHECK(places(longest(bench)) <= 80);
        CHECK_THAT(bench.read("out.txt"), Catch::Contains("Example") &&
                                              Catch::Contains("  trunnion " + command) &&
                                              Catch::Contains("Usage: trunnion " + command));
    }
}

TEST_CASE("help knows commands and topics") {
    const CommandBench bench;
    for (const char* topic : {"exit-codes", "files", "frames", "functions", "units", "run", ""}) {
        CAPTURE(topic);
        CHECK(bench.trunnion(std::string("help ") + topic) == 0);
        CHECK(places(longest(bench)) <= 80);
    }
    CHECK(bench.trunnion("help unit") == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("did you mean 'units'?"));
}

TEST_CASE("mistyped commands, options, effects and axes lead to the word that was meant") {
    const CommandBench bench;
    const std::pair<const char*, const char*> cases[] = {
        {"rum p.nc", "there is no command 'rum', did you mean 'run'?"},
        {"pivot --svg --json", "--svg needs a value, and --json is an option"},
        {"pivot --svg --help", "--svg needs a value, and --help is an option"},
        {"run p.nc --trac t.csv", "did you mean '--trace'?"},
        {"run --trac t.csv", "did you mean '--trace'?"},
        {"check --frob", "check has no option '--frob'"},
        {"pivot --htlm=p.html", "did you mean '--html'?"},
        {"run p.nc --inject 'C.backlsh=60urad'", "did you mean 'C.backlash'?"},
        {"run p.nc --inject 'Z.scale: scale=4'", "did you mean 'scale_ppm'?"},
        {"run p.nc --inject 'Z.scale: scale=4'", "    Z.scale: scale=4\n             ^"},
        {"effects c.backlash2", "did you mean 'C.backlash'?"},
        {"backup lod x", "did you mean 'load'?"}};
    for (const auto& [words, meant] : cases) {
        CAPTURE(words);
        CHECK(bench.trunnion(words) == 2);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains(meant));
        CHECK(bench.read("out.txt").empty());
    }
    CHECK(bench.trunnion("run " + bench.write("p.nc", "O1\nM30\n") + " --measure 'axis Q'") == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("no axis 'Q'; it has X, Y, Z, B, C"));
    CHECK(bench.trunnion("simulate") == 2);
    CHECK_THAT(bench.read("err.txt"), !Catch::Contains("did you mean"));
}

TEST_CASE("effects lists the catalogue, and one of it with formula and example") {
    const CommandBench bench;
    REQUIRE(bench.trunnion("effects") == 0);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("tool.length") && Catch::Contains("B.tilt"));
    CHECK(places(longest(bench)) <= 80);
    REQUIRE(bench.trunnion("effects tool.length") == 0);
    CHECK_THAT(bench.read("out.txt"), Catch::Contains("--inject 'tool.length: error_mm="));
    REQUIRE(bench.trunnion("effects C.backlash --json") == 0);
    const auto json = nlohmann::json::parse(bench.read("out.txt"));
    CHECK(json["schema"] == "trunnion.effects/1");
    CHECK(json["effects"][0]["parameters"][0]["name"] == "gap_rad");
}

TEST_CASE("help on an unknown topic says where the topics are listed") {
    const CommandBench bench;
    CHECK(bench.trunnion("help qqqqq") == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("'trunnion help' lists commands and topics"));
    CHECK(bench.trunnion("help unit") == 2);
    CHECK_THAT(bench.read("err.txt"), Catch::Contains("units"));
}

TEST_CASE("completion and the man page name the program's own options") {
    const CommandBench bench;
    for (const char* form : {"bash", "zsh", "fish", "man"}) {
        CAPTURE(form);
        REQUIRE(bench.trunnion(std::string("completion ") + form) == 0);
        const std::string text = bench.read("out.txt");
        for (const std::string& command : commands) CHECK_THAT(text, Catch::Contains(command));
        CHECK_THAT(text,
                   Catch::Contains(form == std::string("man") ? "trace\\-chord" : "trace-chord"));
    }
    REQUIRE(bench.trunnion("completion bash") == 0);
    bench.write("use.sh", "source " + bench.file("out.txt") +
                              "\nCOMP_WORDS=(trunnion run --tra) COMP_CWORD=2\n_trunnion\n"
                              "echo \"${COMPREPLY[@]}\"\n");
    REQUIRE(std::system(
                ("bash " + bench.file("use.sh") + " > " + bench.file("words.txt")).c_str()) == 0);
    CHECK(bench.read("words.txt") == "--trace --trace-step --trace-chord\n");
    CHECK(bench.trunnion("completion tcsh") == 2);
}
