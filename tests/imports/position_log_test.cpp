// Positions logged by a control: rows whose times run backwards are not in their order.
#include "imports/position_log.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "base/alarm.h"
#include "tests/imports/import_bench.h"

using namespace trunnion;

namespace {

std::size_t rows_of(const std::string& text) {
    return imports::read_position_log(text, "log.csv", import_bench::setup()).rows.size();
}

}  // namespace

TEST_CASE("times of a log that run backwards are refused with line and column") {
    struct Case {
        std::string text;
        int line, column;
    };
    for (const Case& c :
         {Case{"time [ms],N,X cmd [mm]\n0,10,1\n8,10,2\n24,10,3\n16,10,4\n", 5, 1},
          {"line,time_s,x_mm\n3,0.5,1\n3,0.25,2\n", 3, 3},
          {"x_mm;timestamp\n1,5;2025-03-01 08:15:30\n2,5;2025-03-01 08:15:29\n", 3, 5},
          {"zeit;x_mm\n08:15:30;1,5\n08:15:28;2,5\n", 3, 1}}) {
        INFO(c.text);
        try {
            (void)rows_of(c.text);
            FAIL("not refused");
        } catch (const InputError& e) {
            CHECK_THAT(e.message, Catch::Contains("the times run backwards"));
            CHECK(e.where.program == "log.csv");
            CHECK(e.where.line == c.line);
            CHECK(e.where.column == c.column);
        }
    }
}

TEST_CASE("times of a log that stand still, are missing or pass midnight are in order") {
    CHECK(rows_of("time [ms],X cmd [mm]\n0,1\n0,2\n,3\n8,4\n") == 4);
    CHECK(rows_of("time,x_mm\n23:59:59,1\n00:00:00,2\n00:00:01,3\n") == 3);
    CHECK(rows_of("T,x_mm\n12,1\n3,2\n") == 2);  // a tool
}

TEST_CASE("a position that no axis reaches is refused with line and column") {
    for (const char* cell : {"1e300", "-2e10", "1e8"}) {
        INFO(cell);
        try {
            (void)rows_of(std::string("line,x_mm,y_mm\n3,1,2\n3,1,") + cell + "\n");
            FAIL("not refused");
        } catch (const InputError& e) {
            CHECK(e.where.line == 3);
            CHECK(e.where.column == 5);
        }
    }
}

TEST_CASE("the step of a log is that of its values where they are coarser than printed") {
    const auto step_of = [](double grid_mm, int digits, int rows) {
        std::string text = "line,x_mm,y_mm\n";
        for (int k = 0; k < rows; ++k) {
            char line[80];
            const double x = grid_mm * std::round(40.0 * std::sin(0.02 * k) / grid_mm),
                         y = grid_mm * std::round((0.137 * k - 7.0) / grid_mm);
            std::snprintf(line, sizeof line, "3,%.*f,%.*f\n", digits, x, digits, y);
            text += line;
        }
        return imports::read_position_log(text, "log.csv", import_bench::setup()).step;
    };
    CHECK(step_of(0.00254, 5, 500) == Approx(0.00254).epsilon(1e-3));
    CHECK(step_of(0.00254, 6, 500) == Approx(0.00254).epsilon(1e-3));
    CHECK(step_of(0.00254, 4, 500) == Approx(0.00254).epsilon(1e-3));
    CHECK(step_of(0.01, 4, 500) == Approx(0.01).epsilon(1e-3));
    CHECK(step_of(0.001, 3, 500) == Approx(0.001));
    CHECK(step_of(1e-5, 5, 500) == Approx(1e-5));
    CHECK(step_of(0.01, 4, 20) == Approx(1e-4));  // too few to tell
    // The lowest values stand alone: from them on, the step is not yet known well enough.
    std::string text = "line,x_mm,y_mm\n3,-97.3099,-61.7601\n";
    for (int k = 0; k < 400; ++k) {
        char line[80];
        std::snprintf(line, sizeof line, "3,%.4f,%.4f\n",
                      0.00254 * std::round(40.0 * std::sin(0.02 * k) / 0.00254),
                      0.00254 * std::round((0.137 * k - 7.0) / 0.00254));
        text += line;
    }
    CHECK(imports::read_position_log(text, "log.csv", import_bench::setup()).step ==
          Approx(0.00254).epsilon(1e-3));
}

TEST_CASE("a log of positions of some axes is imported without the others") {
    const auto setup = import_bench::setup();
    const std::string text = "N,X cmd [mm],Y cmd [mm]\n20,1.5,2.5\n20,1.75,2.5\n";
    const auto log_of = [&](const std::vector<std::string>& told) {
        return imports::read_position_log(
            import_bench::imported(setup, {imports::ImportKind::axis_log, text, told, ""}).readings,
            "log.csv", setup);
    };
    CHECK(log_of({}).axes == std::vector{Axis::X, Axis::Y});
    CHECK(log_of({}).rows.size() == 2);
    CHECK(log_of({}).rows[1].at[Axis::X] == 1.75);
    CHECK(log_of({"at=Z=5"}).axes.size() == 5);  // told: the others stand at 0
}

TEST_CASE("an unknown unit is refused where all columns name their own, too") {
    import_bench::refuses(
        import_bench::setup(),
        {imports::ImportKind::axis_log, "N,X cmd [mm]\n20,1.5\n", {"unit=furlong"}, ""}, "furlong",
        0);
}

TEST_CASE("rows that a log of even times has lost are seen by their times") {
    const auto log_with = [](int lost_from, int lost_to) {
        std::string text = "time [ms],N,X cmd [mm]\n";
        for (int k = 0; k < 120; ++k)
            if (k < lost_from || k >= lost_to)
                text += std::to_string(20 * k) + ",20," + std::to_string(k) + "\n";
        return imports::read_position_log(text, "log.csv", import_bench::setup());
    };
    const auto cuts = [](const records::PositionLog& log) {
        return std::count_if(log.rows.begin(), log.rows.end(),
                             [](const auto& row) { return row.cut; });
    };
    CHECK(cuts(log_with(0, 0)) == 0);
    const records::PositionLog lost = log_with(50, 60);
    CHECK(cuts(lost) == 1);
    CHECK(lost.rows[49].cut);
    CHECK(cuts(log_with(50, 51)) == 0);  // one late row is none
}
