// Positions logged by a control: rows whose times run backwards are not in their order.
#include "imports/position_log.h"

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
