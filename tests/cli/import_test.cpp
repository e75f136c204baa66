// trunnion import: the commands of docs/readings.md on its files, and what is refused.
#include <catch2/catch.hpp>
#include <sstream>

#include "records/readings.h"
#include "tests/cli/command_bench.h"

using namespace trunnion;

namespace {

/// Files of the page (```kind name) written into the bench; its commands (```sh).
std::vector<std::string> prepare(const CommandBench& bench) {
    std::ifstream page(std::string(TRUNNION_SOURCE_DIR) + "/docs/readings.md");
    std::vector<std::string> commands;
    std::string line, text, name;
    bool inside = false;
    while (std::getline(page, line)) {
        if (!line.starts_with("```")) {
            if (inside) text += line + '\n';
            continue;
        }
        if (inside && name.empty()) commands.push_back(text);
        if (inside && !name.empty()) bench.write(name, text);
        inside = !inside;
        text.clear();
        const std::size_t blank = line.find(' ');
        name = blank == std::string::npos ? "" : line.substr(blank + 1);
    }
    return commands;
}

/// The words behind `trunnion`, files in the bench's folder.
std::string in_folder(const CommandBench& bench, const std::string& command) {
    std::istringstream words(command.substr(command.find(' ')));
    std::string word, out;
    while (words >> word) {
        const bool file = word.find('.') != std::string::npos;
        out += ' ' + (file ? bench.file(word) : word);
    }
    return out;
}

}  // namespace

TEST_CASE("the imports of docs/readings.md do what the page says") {
    const CommandBench bench;
    const auto commands = prepare(bench);
    REQUIRE(commands.size() >= 5);
    for (const std::string& command : commands) {
        INFO(command);
        CHECK(bench.trunnion(in_folder(bench, command)) == 0);
        INFO(bench.read("err.txt"));
        const std::string out = command.substr(command.rfind(' ') + 1);
        std::vector<std::string> notes;
        const std::string text = bench.read(out.substr(0, out.find('\n')));
        CHECK_FALSE(records::parse_readings(text, "out.csv", notes).rows.empty());
        CHECK(notes.empty());
    }
    CHECK(bench.trunnion("import iso230-2 " + bench.file("laser_x.txt") + " --setup " +
                         bench.file("machine.toml") + " --out " + bench.file("o.csv")) == 0);
    CHECK_THAT(bench.read("err.txt"),
               Catch::Contains("X, 2 runs both ways at 3 targets, mm") &&
                   Catch::Contains("B -4.00 (mean -3.00), M 1.50, E 5.00, R 5.13, A 6.13 µm"));
}

TEST_CASE("an import that is refused writes nothing") {
    const CommandBench bench;
    prepare(bench);
    const std::string setup = " --setup " + bench.file("machine.toml"),
                      out = " --out " + bench.file("no.csv");
    const std::string log = bench.write("bad.csv", "time [s],X cmd,X act\n1,1,1\n0,2,2\n");
    const std::pair<std::string, std::string> cases[] = {
        {"axis-log " + log + setup, "bad.csv:3:1: error: times are not in ascending order"},
        {"axis-log " + log, "--setup is missing"},
        {"axis-log " + bench.file("none.csv") + setup, "none.csv"},
        {"servo " + log + setup, "servo"},
        {"table " + log + setup, "--map"},
        {"axis-log " + log + setup + " --with colour=red", "colour"}};
    for (const auto& [words, message] : cases) {
        INFO(words);
        CHECK(bench.trunnion("import " + words + out) == 2);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains(message));
        CHECK_FALSE(std::filesystem::exists(bench.file("no.csv")));
    }
}

TEST_CASE("readings are judged against no machine that nobody named") {
    const CommandBench bench;
    const std::string r =
        bench.write("r.csv", "index,time_s,test,device,feature,x_mm,value_mm\n0,0,t,,,0,\n");
    for (const std::string command : {"identify ", "diagnose ", "predict "}) {
        CHECK(bench.trunnion(command + r) == 2);
        CHECK_THAT(bench.read("err.txt"), Catch::Contains("--setup is missing"));
        CHECK(bench.read("out.txt").empty());
    }
}
