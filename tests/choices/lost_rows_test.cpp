// Logs without times in which rows are missing: some in a row, or single ones everywhere.
#include "tests/choices/sampled_log.h"

namespace trunnion {

using choices::ControlGap;
using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::has_note;
using log_bench::mill_of;
using log_bench::Place;
using log_bench::SampledLog;

namespace {

/// Slots 12 mm deep, with a retract to 40 mm between them, and rapids of three rows each.
constexpr int slots = 8;
constexpr double feed = 0.21, rapid = 15.0;

std::string slots_program() {
    std::string out = "N10 G90 G21 G17 G54\nN20 G0 X0. Y0. Z40.\n";
    for (int k = 0; k < slots; ++k) {
        const int n = 100 * (k + 1);
        out += "N" + std::to_string(n) + " G0 X" + std::to_string(10 * k) + ". Y0.\n";
        out += "N" + std::to_string(n + 10) + " G1 Z28. F500.\n";
        out += "N" + std::to_string(n + 20) + " X" + std::to_string(10 * k + 6) + ". Y15.\n";
        out += "N" + std::to_string(n + 30) + " G0 Z40.\n";
    }
    return out + "N990 M30\n";
}

/// `x_mm`: of a stale offset. The retract of slot `stays_down` is not made.
records::PositionLog slots_log(double x_mm = 0.0, int stays_down = -1) {
    SampledLog log({0, 0, 0});
    log.to(20, {x_mm, 0, 40}, rapid);
    for (int k = 0; k < slots; ++k) {
        const int n = 100 * (k + 1);
        const double x = 10.0 * k + x_mm;
        const double low = stays_down >= 0 && k == stays_down + 1 ? 28.0 : 40.0;
        log.to(n, {x, 0, low}, rapid);
        log.to(n + 10, {x, 0, 28}, feed);
        log.to(n + 20, {x + 6, 15, 28}, feed);
        if (k != stays_down) log.to(n + 30, {x + 6, 15, 40}, rapid);
    }
    return log.log;
}

/// Without the rows from `first` on.
records::PositionLog without(records::PositionLog log, std::size_t first, std::size_t count) {
    const auto from = log.rows.begin() + static_cast<std::ptrdiff_t>(first);
    log.rows.erase(from, from + static_cast<std::ptrdiff_t>(count));
    return log;
}

/// Row in the middle of the moves of a block.
std::size_t middle_of(const records::PositionLog& log, int block) {
    std::size_t first = log.rows.size(), last = 0;
    for (std::size_t i = 0; i < log.rows.size(); ++i) {
        if (log.rows[i].block != block) continue;
        first = std::min(first, i);
        last = i;
    }
    return (first + last) / 2;
}

}  // namespace

TEST_CASE("rows lost from the middle of a move to that of another one are no gap") {
    const records::PositionLog log = slots_log();
    CHECK(gap_of(mill_of(), log, slots_program()).verdict == GapVerdict::no_gap);
    const std::size_t first = middle_of(log, 320), behind = middle_of(log, 510);
    const ControlGap gap = gap_of(mill_of(), without(log, first, behind - first), slots_program());
    CHECK(gap.verdict == GapVerdict::no_gap);
    CHECK(has_note(gap, "rows are missing"));
}

TEST_CASE("rows lost beside a stale store leave the store") {
    const records::PositionLog log = slots_log(0.4);
    const std::size_t first = middle_of(log, 320), behind = middle_of(log, 510);
    const ControlGap gap = gap_of(mill_of(), without(log, first, behind - first), slots_program());
    CHECK(gap.verdict == GapVerdict::ambiguous);
    REQUIRE(gap.causes.size() == 1);
    CHECK(gap.causes[0].name == "G54");
}

TEST_CASE("a control that leaves out a retract has lost no rows") {
    const ControlGap gap = gap_of(mill_of(), slots_log(0.0, 3), slots_program());
    CHECK(gap.verdict == GapVerdict::unexplained);
    CHECK_FALSE(has_note(gap, "rows are missing"));
}

TEST_CASE("a hole that was not drilled is a gap, however long the distances of rapids are") {
    std::string program = "N10 G90 G21 G17 G54\nN20 G0 X0. Y0. Z40.\n";
    SampledLog log({0, 0, 0});
    log.to(20, {0, 0, 40}, rapid);
    for (int k = 1; k <= 9; ++k) {
        const std::string n = std::to_string(k);
        program += "N" + n + "00 G0 X" + std::to_string(20 * k) + ".\nN" + n +
                   "10 G1 Z32. F500.\nN" + n + "20 G0 Z40.\n";
        log.to(100 * k, {20.0 * k, 0, 40}, rapid);
        if (k == 5) continue;
        log.to(100 * k + 10, {20.0 * k, 0, 32}, feed);
        log.to(100 * k + 20, {20.0 * k, 0, 40}, rapid);
    }
    program += "N9000 M30\n";
    const ControlGap gap = gap_of(mill_of(), log.log, program);
    CHECK(gap.verdict == GapVerdict::unexplained);
    REQUIRE(gap.left.size() == 1);
    CHECK(gap.left[0].worst.line == 16);
    CHECK(gap.left[0].worst.apart == Approx(7.8).margin(0.3));
}

TEST_CASE("single rows that are missing everywhere are no gap") {
    std::string program = "N10 G90 G21 G17 G54\nN20 G0 X0. Y0. Z40.\n";
    SampledLog log({0, 0, 0});
    log.to(20, {0, 0, 40}, 4.0);
    for (int k = 1; k <= 12; ++k) {  // each out and back by 10 mm
        const std::string y = std::to_string(5 * k) + ".\n", n = std::to_string(k);
        program += "N" + n + "00 G0 Y" + y + "N" + n + "10 X10.\nN" + n + "20 X0.\n";
        program += "N" + n + "30 G1 X-30. F500.\nN" + n + "40 X0.\n";
        log.to(100 * k, {0, 5.0 * k, 40}, 4.0);
        log.to(100 * k + 10, {10, 5.0 * k, 40}, 4.0);
        log.to(100 * k + 20, {0, 5.0 * k, 40}, 4.0);
        log.to(100 * k + 30, {-30, 5.0 * k, 40}, feed);
        log.to(100 * k + 40, {0, 5.0 * k, 40}, feed);
    }
    std::vector<records::LoggedPosition> kept;
    for (std::size_t i = 0; i < log.log.rows.size(); ++i) {
        const int block = log.log.rows[i].block;
        if (i % 12 != 3 && block != 610 && block != 620) kept.push_back(log.log.rows[i]);
    }
    log.log.rows = kept;
    const ControlGap gap = gap_of(mill_of(), log.log, program + "N9000 M30\n");
    CHECK(gap.verdict == GapVerdict::no_gap);
}

}  // namespace trunnion
