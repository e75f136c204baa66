// What a stale store must not hide: another cause beside it, and rows that it leaves far away.
#include <map>

#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::log_of;
using log_bench::mill_of;
using log_bench::SampledLog;

namespace {

const std::string cycles = R"(N10 G90 G21 G17 G40 G49 G80 G54
N30 G43 H1 Z50.
N40 G0 X0. Y0.
N50 G1 Z2. F500.
N60 X40. Y10.
N70 G2 X60. Y30. R30.
N90 G0 Z30.
N110 G99 G73 X10. Y10. Z-9. R3. Q4. F200.
N120 X25.
N130 G98 G89 X10. Y-10. Z-12. R3. P100
N140 G80
N150 G0 X70. Y40.
N170 G91 G1 X-5. Y-6.
N180 X-5. Z-1.
N190 G90 Z80.
N200 M30
)";

setup::Setup mill(double x, const char* retreat) {
    return mill_of("work_offsets.G54 = { X = " + std::to_string(x) +
                   ", Y = -20, Z = 5 }\ntools.1 = { length_mm = 150, diameter_mm = 6 }\n" +
                   "parameters.5114 = " + retreat + "\n");
}

/// A contour at G54 X 0.5, a row every 0.25 mm.
SampledLog contour_log() {
    SampledLog log({0, 0, 0});
    log.to(20, {0.5, 0, 0}, 0.25);
    log.to(20, {40.5, 0, 0}, 0.25);
    log.to(30, {40.5, 25, 0}, 0.25);
    log.to(40, {5.5, 25, 0}, 0.25);
    log.to(50, {5.5, 3, 0}, 0.25);
    log.to(60, {30.5, 3, 0}, 0.25);
    return log;
}

}  // namespace

TEST_CASE(
    "a far store does not hide that rows are ends of moves, nor the retreat that these show") {
    records::PositionLog log = log_of(mill(60.0, "0.3"), cycles);
    log.blocks = records::BlockColumn::none;
    log.ends = false;
    for (records::LoggedPosition& row : log.rows) row.end = false;
    const auto gap = gap_of(mill(10.0, "1.0"), log, cycles);
    REQUIRE(gap.causes.size() == 2);
    CHECK(gap.causes[0].name == "G54");
    CHECK(gap.causes[1].name == "5114");
    CHECK(gap.causes[1].numbers[0].to == Approx(0.3).margin(1e-3));
}

TEST_CASE(
    "a length far from the other control's is found where no column tells that rows are ends") {
    for (const double length : {165.0, 240.0, 350.0}) {
        INFO(length);
        const auto there = mill_of(
            "work_offsets.G54 = { X = 10, Y = -20, Z = 5 }\ntools.1 = { "
            "length_mm = " +
            std::to_string(length) + ", diameter_mm = 6 }\n");
        records::PositionLog log = log_of(there, cycles);
        log.blocks = records::BlockColumn::none;
        log.ends = false;
        for (records::LoggedPosition& row : log.rows) row.end = false;
        const auto gap = gap_of(mill(10.0, "1.0"), log, cycles);
        std::map<std::string, double> found;
        for (const choices::GapCause& cause : gap.causes)
            for (const choices::FittedNumber& number : cause.numbers)
                found[number.name] = number.to;
        CHECK((gap.verdict == GapVerdict::explained || gap.verdict == GapVerdict::ambiguous));
        CHECK((found["H1"] == Approx(length).margin(1e-3) ||
               found["G54.Z"] == Approx(5.0 + length - 150.0).margin(1e-3)));
    }
}

TEST_CASE("a log with rows that stay millimetres away is not explained, however few they are") {
    const std::string program =
        "N10 G90 G54\nN20 G1 X40. F500.\nN30 Y25.\nN40 X5.\nN50 Y3.\n"
        "N60 X30.\nM30\n";
    const auto here = mill_of("work_offsets.G54 = { X = 0.0 }\n");
    records::PositionLog log = contour_log().log;
    const auto whole = gap_of(here, log, program);
    CHECK(whole.verdict == GapVerdict::ambiguous);
    log.rows[300].at[Axis::Z] += 2.0;
    const auto gap = gap_of(here, log, program);
    CHECK(gap.verdict == GapVerdict::partly_explained);
    REQUIRE(!gap.left.empty());
    CHECK(gap.left[0].worst.apart == Approx(2.0).margin(0.1));
}

TEST_CASE("causes that do as much leave room for none of them") {
    const auto gap = gap_of(mill(10.0, "1.0"), log_of(mill(10.4, "1.0"), cycles), cycles);
    REQUIRE(gap.causes.size() == 1);
    CHECK(gap.causes[0].rivals.size() > 0);
    const double odds = gap.causes[0].probability;
    CHECK(odds < 0.5);
    CHECK(2.0 * odds < 0.97);
    CHECK(2.0 * odds > 0.8);
}

}  // namespace trunnion
