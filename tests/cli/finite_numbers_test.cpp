// NaN, infinite and enormous numbers in every numeric cell of a table and every number of a setup:
// refused at their place or worked out to finite results, never written.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <regex>
#include <vector>

#include "records/readings.h"
#include "setup/setup.h"
#include "tests/cli/command_bench.h"

using namespace trunnion;

namespace {

const std::string header =
    "# schema = trunnion.readings/1\nindex,time_s,test,device,feature,x_mm,y_mm,z_mm,b_deg,c_deg,"
    "dir_x,dir_y,dir_z,px_mm,py_mm,pz_mm,feed_mm_min,spindle_deg,temperature_c,load_kg,"
    "extension_mm,sigma_mm,value_mm\n";

/// A sphere found at turns of C to and fro, with some backlash; every numeric column filled.
std::vector<std::string> rows() {
    std::vector<std::string> list;
    for (int k = 0; k < 36; ++k) {
        const double c_deg = k < 18 ? 20.0 * k : 360.0 - 20.0 * (k - 17);
        const double c_rad = c_deg * std::numbers::pi / 180.0;
        list.push_back(fmt::format(
            "{},{},t,sphere,S1,{},{},230,0,{},{},{},{},0,0,0,0,0,20,0,0,"
            "0.001,{}",
            k, k, 120.0 * std::cos(c_rad), -120.0 * std::sin(c_rad), c_deg, int{k % 3 == 0},
            int{k % 3 == 1}, int{k % 3 == 2}, 0.001 * (k % 7) + (k < 18 ? 0.004 : -0.004)));
    }
    return list;
}

std::string table_of(const std::vector<std::string>& rows) {
    std::string text = header;
    for (const std::string& row : rows) text += row + '\n';
    return text;
}

std::vector<std::string> cells_of(const std::string& row) {
    std::vector<std::string> cells(1);
    for (const char c : row)
        if (c == ',')
            cells.emplace_back();
        else
            cells.back() += c;
    return cells;
}

/// The table with one cell of its 9th row changed.
std::string with_cell(std::size_t column, const std::string& text) {
    std::vector<std::string> list = rows();
    std::vector<std::string> cells = cells_of(list[8]);
    cells[column] = text;
    list[8].clear();
    for (const std::string& cell : cells) list[8] += (list[8].empty() ? "" : ",") + cell;
    return table_of(list);
}

std::string text_of(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// Place and length of each number behind a sign of equality, outside texts and comments.
std::vector<std::pair<std::size_t, std::size_t>> numbers_of(const std::string& toml) {
    static const std::regex number("(^|[ \\[,=])([-+]?[0-9]+(\\.[0-9]+)?(e-?[0-9]+)?)");
    std::vector<std::pair<std::size_t, std::size_t>> places;
    for (std::size_t start = 0; start < toml.size();) {
        const std::size_t end = std::min(toml.find('\n', start), toml.size());
        const std::string line = toml.substr(start, end - start);
        const std::size_t equal = line.find('='), behind = line.find('#');
        const std::string value =
            equal < behind ? line.substr(equal + 1, behind - std::min(behind, equal + 1)) : "";
        if (value.find('"') == std::string::npos)
            for (std::sregex_iterator it(value.begin(), value.end(), number), none; it != none;
                 ++it)
                places.emplace_back(start + equal + 1 + static_cast<std::size_t>(it->position(2)),
                                    it->length(2));
        start = end + 1;
    }
    return places;
}

/// No text of a result says nan or inf as a number.
bool tells_no_number(const std::string& text) {
    static const std::regex word("(^|[^A-Za-z])-?(nan|inf)([^A-Za-z]|$)");
    return !std::regex_search(text, word);
}

}  // namespace

TEST_CASE("every numeric cell of a table refuses what is no finite number, at its place") {
    std::vector<std::string> notes;
    REQUIRE(records::parse_readings(table_of(rows()), "t.csv", notes).rows.size() == 36);
    const std::vector<std::string> names = cells_of(header.substr(header.find('\n') + 1));
    for (std::size_t column = 0; column < names.size(); ++column) {
        if (names[column] == "test" || names[column] == "device" || names[column] == "feature")
            continue;
        for (const char* wrong : {"nan", "-nan", "inf", "-inf", "1e200", "-1e200", "1e999"}) {
            INFO(names[column] << " " << wrong);
            try {
                records::parse_readings(with_cell(column, wrong), "t.csv", notes);
                FAIL("taken");
            } catch (const InputError& e) {
                CHECK(e.where.line == 11);
                CHECK(e.where.column > 0);
            }
        }
    }
}

TEST_CASE(
    "the largest numbers that a table may hold give no NaN, and no setup that cannot be read") {
    const CommandBench bench;
    const std::string machine = TRUNNION_SOURCE_DIR "/machines/bc_table.toml";
    const std::vector<std::string> names = cells_of(header.substr(header.find('\n') + 1));
    for (std::size_t column = 0; column < names.size(); ++column) {
        if (names[column] == "test" || names[column] == "device" || names[column] == "feature")
            continue;
        const std::string table = bench.write("t.csv", with_cell(column, "1e9"));
        for (const char* command : {"identify ", "diagnose "}) {
            std::filesystem::remove(bench.file("x.toml"));
            const int code = bench.trunnion(command + table + " --allow-large --json --setup " +
                                            machine + " --out " + bench.file("x.toml"));
            INFO(names[column] << ": " << command << bench.read("err.txt"));
            CHECK((code == 0 || code == 2));
            CHECK(tells_no_number(bench.read("out.txt")));
            CHECK(std::filesystem::exists(bench.file("x.toml")) == (code == 0));
            if (code != 0) continue;
            std::vector<std::string> notes;
            CHECK_NOTHROW(setup::load_setup(bench.file("x.toml"), notes));
        }
    }
}

TEST_CASE("every number of a setup refuses what is no finite number") {
    for (const auto& file : std::filesystem::directory_iterator(TRUNNION_SOURCE_DIR "/machines")) {
        const std::string text = text_of(file);
        const auto numbers = numbers_of(text);
        CHECK(numbers.size() > 20);
        for (const auto& [at, length] : numbers)
            for (const char* wrong : {"nan", "inf", "-inf", "1e200", "-1e200", "1e999"}) {
                std::string changed = text;
                changed.replace(at, length, wrong);
                INFO(file.path() << " at " << at << ": " << wrong);
                std::vector<std::string> notes;
                CHECK_THROWS_AS(setup::parse_setup(changed, "m.toml", notes), InputError);
            }
    }
}

TEST_CASE("the largest number in each place of a setup gives no NaN, and nothing unreadable") {
    const CommandBench bench;
    const std::string table = bench.write("t.csv", table_of(rows()));
    const std::string text = text_of(TRUNNION_SOURCE_DIR "/machines/bc_table.toml");
    for (const auto& [at, length] : numbers_of(text)) {
        std::string changed = text;
        changed.replace(at, length, "1e12");
        const std::string setup = bench.write("m.toml", changed);
        std::filesystem::remove(bench.file("x.toml"));
        const int code = bench.trunnion("identify " + table + " --allow-large --json --setup " +
                                        setup + " --out " + bench.file("x.toml"));
        INFO(changed.substr(text.rfind('\n', at) + 1, 60) << "\n" << bench.read("err.txt"));
        CHECK((code == 0 || code == 2));
        CHECK(tells_no_number(bench.read("out.txt")));
        CHECK(std::filesystem::exists(bench.file("x.toml")) == (code == 0));
        if (code != 0) continue;
        std::vector<std::string> notes;
        CHECK_NOTHROW(setup::load_setup(bench.file("x.toml"), notes));
    }
}

TEST_CASE("zeros with a sign, denormals and 1e308 in a cell or a setup give no NaN") {
    const CommandBench bench;
    const std::string machine = TRUNNION_SOURCE_DIR "/machines/bc_table.toml";
    const auto check = [&](const std::string& words, const std::string& where) {
        const int code = bench.trunnion(words);
        INFO(where << ": " << words << "\n" << bench.read("err.txt"));
        CHECK((code == 0 || code == 2));
        CHECK(tells_no_number(bench.read("out.txt")));
    };
    const std::vector<std::string> names = cells_of(header.substr(header.find('\n') + 1));
    for (std::size_t column = 0; column < names.size(); ++column) {
        if (names[column] == "test" || names[column] == "device" || names[column] == "feature")
            continue;
        for (const char* number : {"-0", "5e-324", "-1e-310", "1e308"}) {
            const std::string table = bench.write("t.csv", with_cell(column, number));
            for (const char* command : {"identify ", "predict "})
                check(command + table + " --setup " + machine, names[column] + " " + number);
        }
    }
    const std::string table = bench.write("t.csv", table_of(rows()));
    const std::string text = text_of(machine);
    for (const auto& [at, length] : numbers_of(text))
        for (const char* number : {"-0.0", "5e-324", "-1e-310", "1e308"}) {
            std::string changed = text;
            changed.replace(at, length, number);
            const std::string setup = bench.write("m.toml", changed);
            check("predict " + table + " --setup " + setup,
                  changed.substr(text.rfind('\n', at) + 1, 60));
            check("volumetric --grid 2 --rotary-grid 2 --json --setup " + setup,
                  changed.substr(text.rfind('\n', at) + 1, 60));
        }
}
