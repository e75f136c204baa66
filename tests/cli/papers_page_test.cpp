// docs/papers.md: its commands are run, and each number of its tables is one that they give.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/cli/command_bench.h"

namespace {

using Json = nlohmann::json;

std::vector<std::string> split(const std::string& line, char mark) {
    std::vector<std::string> parts;
    std::istringstream in(line);
    for (std::string part; std::getline(in, part, mark);) parts.push_back(part);
    return parts;
}

std::string page() {
    std::ostringstream text;
    text << std::ifstream(std::string(TRUNNION_SOURCE_DIR) + "/docs/papers.md").rdbuf();
    return text.str();
}

/// Rows of the page's table whose first cell is the key: "EY0A" -> {"72.6", "72.586", ...}.
std::vector<std::string> row_of(const std::string& key) {
    for (const std::string& line : split(page(), '\n'))
        if (line.rfind("| " + key + " |", 0) == 0) {
            std::vector<std::string> cells = split(line, '|');
            cells.erase(cells.begin(), cells.begin() + 2);
            for (std::string& cell : cells)
                cell = cell.substr(1, cell.size() > 1 ? cell.size() - 2 : 0);
            return cells;
        }
    FAIL("docs/papers.md has no row " + key);
    return {};
}

/// A number as the page prints it, compared within half its last digit (and a hair).
void same_as_printed(double value, const std::string& printed) {
    INFO(printed);
    const std::size_t point = printed.find('.');
    const double step =
        point == std::string::npos ? 1.0 : std::pow(10.0, -double(printed.size() - point - 1));
    CHECK(std::abs(value - std::stod(printed)) <= 0.5001 * step);
}

/// Runs the command as the page shows it, its output in the bench's folder.
void run_shown(const CommandBench& bench, const std::string& words, const std::string& file,
               const std::string& more = "") {
    CHECK_THAT(page(), Catch::Contains("\n    trunnion " + words + (file.empty() ? "" : " ") +
                                       file + "\n"));
    std::filesystem::current_path(TRUNNION_SOURCE_DIR);
    REQUIRE(bench.trunnion(words + " " + (file.empty() ? "" : bench.file(file)) + more) == 0);
}

/// true less believed tip of each row of a trace, um.
std::vector<std::array<double, 3>> tip_errors_um(const CommandBench& bench,
                                                 const std::string& file) {
    const std::vector<std::string> lines = split(bench.read(file), '\n');
    const std::vector<std::string> names = split(lines[0], ',');
    std::map<std::string, std::size_t> at;
    for (std::size_t i = 0; i < names.size(); ++i) at[names[i]] = i;
    std::vector<std::array<double, 3>> errors;
    for (std::size_t row = 1; row < lines.size(); ++row) {
        const std::vector<std::string> cells = split(lines[row], ',');
        std::array<double, 3> error{};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::string axis(1, "xyz"[k]);
            error[k] = 1000.0 * (std::stod(cells[at["true_" + axis + "_mm"]]) -
                                 std::stod(cells[at["tip_" + axis + "_mm"]]));
        }
        errors.push_back(error);
    }
    return errors;
}

}  // namespace

TEST_CASE("papers 2021: radii of the four maps") {
    const CommandBench bench;
    run_shown(bench, "pivot --svg", "out/pivot", " --json");
    const Json maps = Json::parse(bench.read("out.txt"))["maps"];
    REQUIRE(maps.size() == 4);
    for (std::size_t i = 0; i < 4; ++i) {
        const auto cells =
            row_of(std::to_string(i + 1) + ": " + maps[i]["name"].get<std::string>());
        const Json& f = maps[i]["functions"];
        const char* names[] = {"DPP", "RTDFO", "RTCP", "TW"};
        for (std::size_t k = 0; k < 4; ++k)
            same_as_printed(1000.0 * f[names[k]]["radius_mm"].get<double>(), cells[k]);
        same_as_printed(1000.0 * f["DPP"]["expected_radius_mm"].get<double>(), cells[4]);
        same_as_printed(1000.0 * f["TW"]["expected_radius_mm"].get<double>(), cells[5]);
    }
}

TEST_CASE("papers 2015: errors before and after") {
    const CommandBench bench;
    run_shown(bench, "ballbar --setup machines/ac_trunnion.toml", "", " --json");
    for (const Json& error : Json::parse(bench.read("out.txt"))["errors"]) {
        const auto cells = row_of(error["name"]);
        const double unit = error["unit"] == "mm" ? 1e3 : 1e6;
        same_as_printed(unit * error["before"].get<double>(), cells[1]);
        same_as_printed(unit * error["after"].get<double>(), cells[3]);
        // The machine has the paper's error: found within four sigma.
        CHECK(std::abs(error["before"].get<double>() - std::stod(cells[0]) / unit) <
              4.0 * error["sigma_before"].get<double>());
    }
}

TEST_CASE("papers 2022: the three exercises") {
    const CommandBench bench;
    const auto exercise = [&](int number) {
        const std::string n = std::to_string(number);
        run_shown(bench,
                  "run programs/papers/htm_exercise_" + n + ".nc --setup machines/htm_exercise_" +
                      n + ".toml --truth --trace",
                  "e" + n + ".csv");
        return tip_errors_um(bench, "e" + n + ".csv");
    };
    const auto beam = exercise(1).back();
    same_as_printed(-beam[2], row_of("lateral (Z)")[1]);
    same_as_printed(-beam[0], row_of("Abbe (X)")[1]);
    // Exercise 2: the same errors at each Y, in the order of Z. The first block stands still.
    const auto slides = exercise(2);
    REQUIRE(slides.size() == 11);
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            CHECK(slides[i][k] == Approx(slides[i + 4][k]).margin(1e-6));
    const auto post = exercise(3);
    const auto paper = row_of("paper, along Y / µm"), here = row_of("here, along Y / µm");
    REQUIRE(post.size() == 8);
    for (std::size_t i = 0; i < 8; ++i) {
        same_as_printed(post[i][1] - 400e3, paper[i]);
        same_as_printed(post[i][1] - 400e3, here[i]);
    }
}

TEST_CASE("papers: the tool paths of 2015 are a page") {
    const CommandBench bench;
    const std::string words =
        "run programs/ballbar/O8200.nc --setup machines/ac_trunnion.toml --html ";
    CHECK_THAT(page(), Catch::Contains("`trunnion " + words + "paths.html`"));
    std::filesystem::current_path(TRUNNION_SOURCE_DIR);
    REQUIRE(bench.trunnion(words + bench.file("paths.html")) == 0);
    CHECK(bench.read("paths.html").size() > 500'000);
}
