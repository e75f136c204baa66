// Stores far from those of the other control: empty ones, and logs without numbers of blocks.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::mill_of;

namespace {

/// G43 on a line of its own: with an empty length it is a move less.
const std::string program = R"(N10 G90 G54
N20 G0 X5. Y5.
N30 Z61.
N40 G43 H1
N50 G0 X-34.5 Y-26.5 Z55.
N60 X-56. Y-42.5
N70 Z5.
N80 G1 Z-4. F300
N90 X-21. Y2.
N100 X-11. Y27.
N110 X47. Y58.
N120 G0 Z50.
N130 X55. Y4.
N140 Z9.
N150 G1 Z-3.
N160 X31. Y52.
N170 X48. Y24.
N180 G0 Z50.
N190 G49
N200 X-30. Y-36.
N210 Z70.
N220 M30
)";

setup::Setup mill(double length, double z = 0.0) {
    return mill_of("work_offsets.G54 = { X = 0.0, Z = " + std::to_string(z) + " }\n" +
                   (length != 0.0 ? "tools.1 = { length_mm = " + std::to_string(length) +
                                        ", diameter_mm = 0 }\n"
                                  : std::string()));
}

records::PositionLog without_numbers(records::PositionLog log) {
    log.blocks = records::BlockColumn::none;
    return log;
}

void check_length(const choices::ControlGap& gap, double length) {
    REQUIRE_FALSE(gap.causes.empty());
    CHECK(gap.causes[0].name == "H1");
    CHECK(gap.causes[0].probability > 0.5);
    REQUIRE(gap.causes[0].numbers.size() == 1);
    CHECK(gap.causes[0].numbers[0].to == Approx(length).margin(1e-3));
}

}  // namespace

TEST_CASE("a tool length that is empty here is found though G43 is then no move") {
    const records::PositionLog log = log_bench::log_of(mill(121.21), program);
    check_length(gap_of(mill(0.0), log, program), 121.21);
    check_length(gap_of(mill(0.0), without_numbers(log), program), 121.21);
}

TEST_CASE("a length far from the other control's is found without numbers of blocks") {
    for (const double here : {12.0, 60.0, 160.0}) {
        INFO(here);
        const records::PositionLog log = without_numbers(log_bench::log_of(mill(121.21), program));
        check_length(gap_of(mill(here), log, program), 121.21);
        records::PositionLog cut = log;
        cut.rows.resize(16);
        check_length(gap_of(mill(here), cut, program), 121.21);
    }
}

TEST_CASE("an offset far from the other control's is found without numbers of blocks") {
    const records::PositionLog log = without_numbers(log_bench::log_of(mill(80.0, -42.5), program));
    const auto gap = gap_of(mill(80.0), log, program);
    REQUIRE_FALSE(gap.causes.empty());
    CHECK(gap.causes[0].name == "G54");
    CHECK(gap.causes[0].numbers[0].to == Approx(-42.5).margin(1e-3));
}

TEST_CASE("an edited block and a stale length without numbers: the value is right, or doubtful") {
    for (const char* edit : {"Y-42.5", "X31.", "Y58.", "Z-4.", "Z55."})
        for (const double length : {80.04, 82.0, 121.0}) {
            INFO(edit << ' ' << length);
            std::string edited = program;
            edited.insert(edited.find(edit) + 2, edit[1] == '-' ? "" : "1");
            if (edit[1] == '-') edited.insert(edited.find(edit) + 2, "1");
            const auto log = without_numbers(log_bench::log_of(mill(length), edited));
            const auto gap = gap_of(mill(80.0), log, program);
            CHECK(gap.verdict != GapVerdict::no_gap);
            for (const choices::GapCause& cause : gap.causes) {
                if (!cause.known || cause.probability < 0.5) continue;
                CAPTURE(cause.name);
                if (cause.name == "H1")
                    CHECK(cause.numbers[0].to == Approx(length).margin(0.01));
                else
                    CHECK(cause.probability < 0.75);
            }
        }
}

TEST_CASE("an empty length that a part of the log does not tell from its offset is a rival") {
    records::PositionLog log = log_bench::log_of(mill(121.21), program);
    log.rows.resize(16);
    log.rows.erase(log.rows.begin(), log.rows.begin() + 4);
    const auto gap = gap_of(mill(0.0), log, program);
    REQUIRE_FALSE(gap.causes.empty());
    for (const choices::GapCause& cause : gap.causes) {
        if (!cause.known) continue;
        CAPTURE(cause.name);
        const auto& rivals = cause.rivals;
        const bool has_length =
            cause.name == "H1" || std::find(rivals.begin(), rivals.end(), "H1") != rivals.end();
        CHECK((has_length || cause.probability < 0.5));
        CHECK(cause.probability < 0.7);
    }
}

TEST_CASE("one shift up to the end of a log that is cut off is one event, of many blocks or not") {
    records::PositionLog log = log_bench::log_of(mill(80.4), program);
    const auto whole = gap_of(mill(80.0), log, program);
    REQUIRE_FALSE(whole.causes.empty());
    CHECK(whole.causes[0].name == "H1");
    CHECK(whole.causes[0].probability > 0.8);
    log.rows.resize(16);
    const auto cut = gap_of(mill(80.0), log, program);
    REQUIRE_FALSE(cut.causes.empty());
    CHECK(cut.causes[0].name == "H1");
    CHECK(cut.causes[0].probability < 0.7);
    CHECK(cut.causes[0].probability > 0.5);
}

}  // namespace trunnion
