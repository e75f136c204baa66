// docs/instruments: every command of every page does what the page shows.
#include <catch2/catch.hpp>
#include <vector>

#include "tests/cli/command_bench.h"

namespace {

namespace fs = std::filesystem;

const std::string source = TRUNNION_SOURCE_DIR;

struct Shown {
    std::string command;             ///< without the word trunnion
    std::vector<std::string> lines;  ///< that its output holds, in this order
};

/// Blocks ```sh, each with the indented lines that follow it.
std::vector<Shown> commands_of(const fs::path& path) {
    std::ifstream page(path);
    std::vector<Shown> list;
    bool inside = false;
    for (std::string line; std::getline(page, line);) {
        if (line.starts_with("```"))
            inside = line == "```sh";
        else if (inside && line.starts_with("trunnion "))
            list.push_back({line.substr(9), {}});
        else if (line.starts_with("    ") && !list.empty())
            list.back().lines.push_back(line.substr(4));
    }
    return list;
}

void check_shown(const CommandBench& bench, const Shown& shown) {
    const std::string output = bench.read("err.txt") + bench.read("out.txt");
    INFO(output);
    std::size_t at = 0;
    for (const std::string& line : shown.lines) {
        INFO("line of the page: " << line);
        at = output.find(line, at);
        REQUIRE(at != std::string::npos);
    }
}

void check_page(const std::string& name, std::size_t commands) {
    const CommandBench bench;
    for (const auto& entry : fs::directory_iterator(source + "/docs/instruments"))
        fs::copy(entry.path(), bench.path);
    fs::current_path(bench.path);
    const std::vector<Shown> list = commands_of(bench.path / name);
    CHECK(list.size() == commands);
    std::size_t lines = 0;
    for (const Shown& shown : list) {
        INFO("trunnion " << shown.command);
        const int code = bench.trunnion(shown.command);
        INFO(bench.read("err.txt"));
        REQUIRE(code == 0);
        check_shown(bench, shown);
        lines += shown.lines.size();
    }
    CHECK(lines >= commands);
    fs::current_path(source);
}

}  // namespace

TEST_CASE("docs/instruments: a laser in four commands") {
    check_page("laser.md", 4);
}
TEST_CASE("docs/instruments: a ballbar in four commands") {
    check_page("ballbar.md", 4);
}
TEST_CASE("docs/instruments: points in four commands") {
    check_page("points.md", 4);
}
TEST_CASE("docs/instruments: a servo log in four commands") {
    check_page("servo_log.md", 4);
}
TEST_CASE("docs/instruments: a control's log of a program in three commands") {
    check_page("control_log.md", 3);
}
TEST_CASE("docs/instruments: prints of a measuring program in four commands") {
    check_page("dprnt.md", 4);
}
