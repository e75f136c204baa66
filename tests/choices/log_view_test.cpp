// Block numbers of a log: N numbers or lines, and what is refused.
#include "choices/log_view.h"

#include "base/alarm.h"
#include "tests/choices/log_bench.h"

namespace trunnion {

namespace {

/// N numbers that are also numbers of lines, and more lines than N numbers.
const std::string small_numbers =
    "%\nO0031 (CLAMP)\n(REV B)\nN1 G21 G90 G54\nN2 G0 X4. Y9.\n"
    "N3 G1 Z-3. F200\nN4 X22.\nN5 Y31. Z1.\nG0 Z40.\nM30\n%\n";
const std::string tens = "N10 G21 G90\nN20 G0 X3.\nN30 Y8.\nN40 X0.\nN50 M30\n";

records::PositionLog log_of_blocks(const std::vector<int>& blocks) {
    records::PositionLog log;
    log.path = "l.csv";
    log.axes = {Axis::X};
    log.blocks = records::BlockColumn::number;
    log.step = 1e-4;
    for (const int block : blocks) {
        log.rows.emplace_back();
        log.rows.back().block = block;
        log.rows.back().line = static_cast<int>(log.rows.size()) + 1;
    }
    return log;
}

choices::LogOfProgram seen(const std::vector<int>& blocks, const std::string& program) {
    return choices::log_of_program(log_of_blocks(blocks), {log_bench::program_of(program)});
}

/// Message and row of the refusal.
std::pair<std::string, int> refused(const std::vector<int>& blocks, const std::string& program) {
    try {
        (void)seen(blocks, program);
    } catch (const InputError& e) {
        return {e.message, e.where.line};
    }
    return {};
}

}  // namespace

TEST_CASE("the numbers of blocks are N numbers if most of them are N numbers of the program") {
    for (const auto& blocks : {std::vector{2, 3, 4, 5}, {2, 2, 0, 3}}) {
        const choices::LogOfProgram log = seen(blocks, small_numbers);
        REQUIRE(log.notes.size() == 1);
        CHECK_THAT(log.notes[0], Catch::Contains("are N numbers of the program"));
        CHECK(log.view.key_of({"", 5}) == log.view.rows[0].key);  // N2 is on line 5
    }
    const choices::LogOfProgram lines = seen({5, 6, 7, 8, 9}, small_numbers);
    CHECK(lines.notes.empty());
    CHECK(lines.view.key_of({"", 5}) == lines.view.rows[0].key);
}

TEST_CASE("rows with an N number that the program lacks are set aside, most of them are refused") {
    const choices::LogOfProgram log = seen({2, 2, 3, 4, 9, 9, 5}, small_numbers);  // line 9 exists
    CHECK(log.view.rows.size() == 5);
    CHECK(log.view.rows[3].cut);
    CHECK(log.foreign == std::set<int>{9});
    CHECK_THAT(log.notes.front(),
               Catch::Contains("p.nc has no N9: the rows of this block are set"));
    const auto [text, row] = refused({20, 999, 30, 999, 40, 999, 999}, tens);
    CHECK_THAT(text, Catch::StartsWith(
                         "block N999: p.nc has most N numbers of this column, but not this one"));
    CHECK(row == 3);
    const auto [lines, first] = refused({2, 700, 800}, tens);
    CHECK_THAT(lines, Catch::StartsWith("block 700: p.nc has 5 lines and no such N number"));
    CHECK(first == 3);
}

TEST_CASE("a block that the program lacks is no agreement, and hides no stale store") {
    const std::string there =
        "N10 G21 G90 G54\nN20 G0 X3.\nN30 Y8.\nN35 Z20.\nN36 Z0.\nN40 X9.\n"
        "N50 Y3.\nN60 X1.\nN70 M30\n";
    const auto mill = [](double x) {
        return log_bench::setup_of(
            "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
            "[control.work_offsets]\nG54 = { X = " +
            std::to_string(x) + " }\n");
    };
    std::string here = there;
    here.erase(here.find("N35"), here.find("N40") - here.find("N35"));
    for (const double x : {0.0, 0.25}) {
        records::PositionLog log = log_bench::log_of(mill(x), there);
        log.blocks = records::BlockColumn::number;
        constexpr int numbers[] = {0, 10, 20, 30, 35, 36, 40, 50, 60, 70};
        for (records::LoggedPosition& row : log.rows)
            row.block = numbers[static_cast<std::size_t>(row.block)];
        const choices::ControlGap gap = log_bench::gap_of(mill(0.0), log, here);
        const auto unknown = std::find_if(gap.causes.begin(), gap.causes.end(),
                                          [](const auto& cause) { return !cause.known; });
        REQUIRE(unknown != gap.causes.end());
        CHECK_THAT(unknown->what, Catch::Contains("blocks that the program lacks"));
        CHECK(gap.verdict == (x == 0.0 ? choices::GapVerdict::unexplained
                                       : choices::GapVerdict::partly_explained));
        CHECK(gap.causes[0].known == (x != 0.0));
    }
}

}  // namespace trunnion
