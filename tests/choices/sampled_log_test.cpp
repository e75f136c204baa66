// Logs of samples by hand: the order within a block, ends that were not reached, rows that are
// missing, numbers that a program has twice, and the start.
#include "tests/choices/sampled_log.h"

#include "base/random.h"
#include "base/units.h"

namespace trunnion {

using choices::GapVerdict;
using log_bench::feed_mm;
using log_bench::rapid_mm;
using log_bench::SampledLog;

namespace {

const std::string holes = R"(N10 G21 G90 G17 G40 G49 G80 G54
N20 G0 X10. Y10.
N30 Z-20.
N40 G99 G81 X10. Y10. Z-32. R-18. F200
N50 X25. Y12.
N60 X40.
N70 G80
N80 G0 Z-1.
N90 X0.
N100 M30
)";

/// What a control makes of a hole's block: to `bottom`, in one stroke or with pecks, once or more.
struct Drilling {
    double bottom = -32.0;
    std::vector<double> pecks;  ///< depths before it, each with a full retract
    int times = 1;
};

SampledLog drilled(const Drilling& last) {
    SampledLog log({0, 0, 0});
    log.to(20, {10, 10, 0}, rapid_mm);
    log.to(30, {10, 10, -20}, rapid_mm);
    double x = 10, y = 10;
    const auto hole = [&](int block, const Drilling& by) {
        log.to(block, {x, y, -18}, rapid_mm);
        for (int k = 0; k < by.times; ++k) {
            for (const double z : by.pecks) {
                log.to(block, {x, y, z}, feed_mm);
                log.to(block, {x, y, -18}, rapid_mm);
            }
            log.to(block, {x, y, by.bottom}, feed_mm);
            log.to(block, {x, y, -18}, rapid_mm);
        }
    };
    hole(40, {});
    x = 25, y = 12;
    hole(50, {});
    x = 40;
    hole(60, last);
    log.to(80, {x, y, -1}, rapid_mm);
    log.to(90, {0, y, -1}, rapid_mm);
    return log;
}

GapVerdict verdict(const records::PositionLog& log, const std::string& program) {
    return log_bench::gap_of(log_bench::mill_of(), log, program).verdict;
}

void to_lines(records::PositionLog& log) {
    log.blocks = records::BlockColumn::none;
}

}  // namespace

TEST_CASE("a log of samples: a hole in one stroke is no hole with pecks, and no two holes") {
    for (const bool numbers : {true, false}) {
        INFO("numbers " << numbers);
        const auto of = [&](const Drilling& last) {
            records::PositionLog log = drilled(last).log;
            if (!numbers) to_lines(log);
            return verdict(log, holes);
        };
        CHECK(of({}) == GapVerdict::no_gap);
        CHECK(of({-32.0, {-22.0, -27.0}, 1}) == GapVerdict::unexplained);
        CHECK(of({-32.0, {}, 2}) == GapVerdict::unexplained);
    }
}

TEST_CASE("a log of samples: a depth that was not reached shows at the distance of its feed") {
    CHECK(verdict(drilled({-31.7, {}, 1}).log, holes) == GapVerdict::unexplained);
    CHECK(verdict(drilled({-32.3, {}, 1}).log, holes) == GapVerdict::unexplained);
    const choices::ControlGap gap = log_bench::gap_of(log_bench::mill_of(), drilled({}).log, holes);
    CHECK(log_bench::has_note(gap, "judged to the distance of its own samples"));
}

TEST_CASE(
    "a log of samples: with a row at every corner, a depth shows at less than their distance") {
    const auto log_with = [](double bottom) {
        SampledLog log({0, 0, 0});
        // As a log of equal parts of each move.
        const auto line = [&](int block, const log_bench::Place& end, int parts) {
            const log_bench::Place from = log.at();
            for (int k = 1; k <= parts; ++k) {
                log_bench::Place at;
                for (std::size_t a = 0; a < 3; ++a)
                    at[a] = from[a] + (end[a] - from[a]) * k / parts;
                log.add(block, at);
            }
        };
        line(20, {10, 10, 0}, 14);
        line(30, {10, 10, -20}, 20);
        for (const auto& [block, x, y] :
             {std::tuple{40, 10., 10.}, std::tuple{50, 25., 12.}, std::tuple{60, 40., 12.}}) {
            line(block, {x, y, -18}, block == 40 ? 2 : 15);
            line(block, {x, y, block == 60 ? bottom : -32.}, 14);
            line(block, {x, y, -18}, 14);
        }
        line(80, {40, 12, -1}, 17);
        line(90, {0, 12, -1}, 40);
        return log.log;
    };
    CHECK(verdict(log_with(-32.0), holes) == GapVerdict::no_gap);
    CHECK(verdict(log_with(-31.2), holes) == GapVerdict::unexplained);
}

TEST_CASE("a log of samples: uneven ones do not tell how far a motion went") {
    records::PositionLog log = drilled({}).log;
    SeededNoise random(8);
    std::erase_if(log.rows, [&](const auto&) { return random.uniform() < 0.8; });
    const choices::ControlGap gap = log_bench::gap_of(log_bench::mill_of(), log, holes);
    CHECK(gap.verdict == GapVerdict::no_gap);
    CHECK(!log_bench::has_note(gap, "judged to the distance of its own samples"));
}

TEST_CASE("a log of samples: a way back within a block is a gap, a rest and its noise are none") {
    const std::string line = "N10 G21 G90 G54\nN20 G1 X20. F200\nN30 Y20.\nN40 X0.\nN50 M30\n";
    const auto log_with = [&](const std::vector<double>& turns) {
        SampledLog log({0, 0, 0});
        for (const double x : turns) log.to(20, {x, 0, 0}, 0.5);
        log.to(20, {20, 0, 0}, 0.5);
        log.to(30, {20, 20, 0}, 0.5);
        log.to(40, {0, 20, 0}, 0.5);
        return log.log;
    };
    CHECK(verdict(log_with({}), line) == GapVerdict::no_gap);
    CHECK(verdict(log_with({12, 4}), line) == GapVerdict::unexplained);
    records::PositionLog rests = log_with({});
    const records::LoggedPosition here = rests.rows[17];
    rests.rows.insert(rests.rows.begin() + 17, 300, here);
    SeededNoise random(4);
    for (records::LoggedPosition& row : rests.rows) {
        row.sigma_mm = 0.002;
        for (const Axis axis : rests.axes) row.at[axis] += 0.002 * random.normal();
    }
    CHECK(verdict(rests, line) == GapVerdict::no_gap);
}

TEST_CASE("a log of samples: retracts of G73 that are not those of 5114") {
    std::string pecking = holes;
    pecking.replace(pecking.find("G81"), 3, "G73 Q4.");
    const auto log_with = [&](double back) {
        SampledLog log({0, 0, 0});
        log.to(20, {10, 10, 0}, 1.0);
        log.to(30, {10, 10, -20}, 1.0);
        for (const auto& [block, x, y] :
             {std::tuple{40, 10., 10.}, std::tuple{50, 25., 12.}, std::tuple{60, 40., 12.}}) {
            log.to(block, {x, y, block == 40 ? -20. : -18.}, 1.0);
            log.to(block, {x, y, -18}, 1.0);
            for (const double z : {-22., -26., -30.}) {
                log.to(block, {x, y, z}, 0.3);
                log.to(block, {x, y, z + back}, 0.3);
            }
            log.to(block, {x, y, -32}, 0.3);
            log.to(block, {x, y, -18}, 1.0);
        }
        log.to(80, {40, 12, -1}, 1.0);
        log.to(90, {0, 12, -1}, 1.0);
        return log.log;
    };
    const setup::Setup here = log_bench::mill_of("[control.parameters]\n5114 = 0.5\n");
    CHECK(log_bench::gap_of(here, log_with(0.5), pecking).verdict == GapVerdict::no_gap);
    const choices::ControlGap gap = log_bench::gap_of(here, log_with(2.0), pecking);
    CHECK((gap.verdict == GapVerdict::explained || gap.verdict == GapVerdict::ambiguous));
    REQUIRE(!gap.causes.empty());
    CHECK(gap.causes[0].name == "5114");
    // 0.1 mm lies between two samples, but not what this control goes farther.
    const choices::ControlGap less = log_bench::gap_of(
        log_bench::mill_of("[control.parameters]\n5114 = 1.5\n"), log_with(0.1), pecking);
    REQUIRE(!less.causes.empty());
    CHECK(less.causes[0].name == "5114");
    REQUIRE(less.causes[0].numbers.size() == 1);
    const choices::FittedNumber& number = less.causes[0].numbers[0];
    CHECK(number.sigma > 0.02);
    CHECK(std::abs(number.to - 0.1) < 2.0 * number.sigma);
}

TEST_CASE("a log of samples: a clearance of G83 that no sample shows is said to be not tested") {
    std::string pecking = holes;
    pecking.replace(pecking.find("N60 X40."), 8, "N60 G83 X40. Z-32. R-18. Q7.");
    const auto gap =
        log_bench::gap_of(log_bench::mill_of(), drilled({-32.0, {-25.0}, 1}).log, pecking);
    CHECK(std::find(gap.unseen.begin(), gap.unseen.end(), "5115") != gap.unseen.end());
    CHECK(log_bench::has_note(gap, "5115 (clearance of G83, here 1 mm) is not tested"));
    CHECK(std::find(gap.unseen.begin(), gap.unseen.end(), "5114") == gap.unseen.end());
}

TEST_CASE("a log of samples: missing rows are no gap, and hide no store") {
    const std::string ways = R"(N10 G21 G90 G17 G54
N20 G1 X30. Y5. F300
N30 Y25.
N40 X5. Y30.
N50 Z-8.
N60 X20. Y10.
N70 G3 X20. Y10. I-6. J0.
N80 G1 X50. Y12.
N90 Y40. Z-3.
N100 X0.
N110 M30
)";
    for (const double stale : {0.0, 0.1}) {
        SampledLog log({0, 0, 0});
        const auto line = [&](int block, double x, double y, double z) {
            log.to(block, {x + stale, y, z}, 0.7);
        };
        line(20, 30, 5, 0);
        line(30, 30, 25, 0);
        line(40, 5, 30, 0);
        line(50, 5, 30, -8);
        line(60, 20, 10, -8);
        for (int k = 1; k <= 720; ++k)
            line(70, 14 + 6 * std::cos(k * pi / 360), 10 + 6 * std::sin(k * pi / 360), -8);
        line(80, 50, 12, -8);
        line(90, 50, 40, -3);
        line(100, 0, 40, -3);
        auto& rows = log.log.rows;
        for (const std::size_t first : {60U, 130U}) {
            records::PositionLog cut = log.log;
            cut.rows.erase(cut.rows.begin() + static_cast<std::ptrdiff_t>(first),
                           cut.rows.begin() + static_cast<std::ptrdiff_t>(first) + 50);
            REQUIRE(rows.size() > 250);
            const choices::ControlGap gap = log_bench::gap_of(
                log_bench::mill_of("[control.work_offsets]\nG54 = { X = 0.0 }\n"), cut, ways);
            CHECK(log_bench::has_note(gap, "rows are missing after line"));
            if (stale == 0.0) {
                CHECK(gap.verdict == GapVerdict::no_gap);
                continue;
            }
            CHECK((gap.verdict == GapVerdict::explained || gap.verdict == GapVerdict::ambiguous));
            REQUIRE(!gap.causes.empty());
            CHECK(gap.causes[0].name == "G54");
        }
    }
}

TEST_CASE("a log of samples: rows without a number where the next block goes back") {
    const std::string strokes = R"(N10 G21 G90 G17 G54
N20 G1 X10. F300
N30 Z-12.
N40 Z0.
N50 X20.
N60 Z-9.
N70 Z-2.
N80 X30.
N90 M30
)";
    SampledLog log({0, 0, 0});
    log.to(20, {10, 0, 0}, 0.4);
    log.to(30, {10, 0, -12}, 0.4);
    log.to(40, {10, 0, 0}, 0.4);
    log.to(50, {20, 0, 0}, 0.4);
    log.to(60, {20, 0, -9}, 0.4);
    log.to(70, {20, 0, -2}, 0.4);
    log.to(80, {30, 0, -2}, 0.4);
    records::PositionLog late = log.log, sparse = log.log;
    for (std::size_t i = late.rows.size() - 1; i >= 2; --i)
        late.rows[i].block = log.log.rows[i - 2].block;
    CHECK(verdict(late, strokes) == GapVerdict::no_gap);
    for (std::size_t i = 0; i < sparse.rows.size(); ++i)
        if (i % 10 > 2) sparse.rows[i].block = 0;
    CHECK(verdict(sparse, strokes) == GapVerdict::no_gap);
}

TEST_CASE("a log of samples: numbers that a program has twice") {
    const std::string twice = R"(N10 G21 G90 G17 G54
N20 G1 X20. F300
N30 G3 X20. Y0. I-8. J0.
N40 G1 Y15.
N20 X5.
N30 G2 X5. Y15. I4. J4.
N40 G1 Z-4.
M30
)";
    SampledLog log({0, 0, 0});
    log.to(20, {20, 0, 0}, 0.9);
    for (int k = 1; k <= 360; ++k)
        log.to(30, {12 + 8 * std::cos(k * pi / 180), 8 * std::sin(k * pi / 180), 0}, 0.9);
    log.to(40, {20, 15, 0}, 0.9);
    log.to(20, {5, 15, 0}, 0.9);
    const double radius = std::hypot(4.0, 4.0);
    for (int k = 1; k <= 360; ++k) {
        const double a = -0.75 * pi - k * pi / 180;
        log.to(30, {9 + radius * std::cos(a), 19 + radius * std::sin(a), 0}, 0.9);
    }
    log.to(40, {5, 15, -4}, 0.9);
    // Chords of a degree are 0.3 um off the circle.
    for (records::LoggedPosition& row : log.log.rows) row.sigma_mm = 0.001;
    const choices::ControlGap gap = log_bench::gap_of(log_bench::mill_of(), log.log, twice);
    CHECK(gap.verdict == GapVerdict::no_gap);
    CHECK(!log_bench::has_note(gap, "the positions"));
}

TEST_CASE("a log of samples: one block with another end has no late numbers") {
    const std::string lifted = R"(N10 G21 G90 G17 G54
N20 G1 X30. F300
N30 Y20.
N40 Z12.
N50 Z30.
N60 X5. Y8.
N70 Z3.
N80 M30
)";
    const auto log_with = [](double z) {
        SampledLog log({0, 0, 0});
        log.to(20, {30, 0, 0}, 0.8);
        log.to(30, {30, 20, 0}, 0.8);
        log.to(40, {30, 20, z}, 0.8);
        log.add(40, {30, 20, z});
        log.to(50, {30, 20, 30}, 0.8);
        log.to(60, {5, 8, 30}, 0.8);
        log.to(70, {5, 8, 3}, 0.8);
        return log.log;
    };
    CHECK(verdict(log_with(12.0), lifted) == GapVerdict::no_gap);
    const choices::ControlGap gap = log_bench::gap_of(log_bench::mill_of(), log_with(12.1), lifted);
    CHECK(gap.verdict == GapVerdict::unexplained);
    CHECK(!log_bench::has_note(gap, "the positions"));
}

TEST_CASE("a log of samples: the control may have started before the first row") {
    const std::string relative =
        "N10 G21 G91 G0 X5.\nN20 X7. Y3.\nN30 G1 Y9. F300\nN40 X2.\nN50 M30\n";
    SampledLog log({0, 0, 0});
    log.to(10, {5, 0, 0}, 0.7);
    log.to(20, {12, 3, 0}, 0.7);
    log.to(30, {12, 12, 0}, 0.7);
    log.to(40, {14, 12, 0}, 0.7);
    CHECK(verdict(log.log, relative) == GapVerdict::no_gap);
    log.log.rows.erase(log.log.rows.begin());
    const choices::ControlGap gap = log_bench::gap_of(log_bench::mill_of(), log.log, relative);
    CHECK(gap.verdict == GapVerdict::no_gap);
    CHECK(log_bench::has_note(gap, "started at its machine zero"));
}

TEST_CASE("a log of samples: noise of the first rows is no shift of what the program moves") {
    const std::string relative =
        "N10 G21 G91 G0 X5.\nN20 X7. Y3.\nN30 G1 Y9. F300\nN40 X2.\nN50 M30\n";
    for (const unsigned seed : {1u, 2u, 3u, 4u, 5u, 6u}) {
        SampledLog log({0, 0, 0});
        for (int k = 0; k < 40; ++k) log.add(10, {0, 0, 0});  // the machine stands
        log.to(10, {5, 0, 0}, 0.7);
        log.to(20, {12, 3, 0}, 0.7);
        log.to(30, {12, 12, 0}, 0.7);
        log.to(40, {14, 12, 0}, 0.7);
        SeededNoise noise(seed);
        for (records::LoggedPosition& row : log.log.rows)
            for (const Axis axis : log.log.axes) row.at[axis] += 0.003 * noise.normal();
        INFO(seed);
        CHECK(verdict(log.log, relative) == GapVerdict::no_gap);
    }
}

}  // namespace trunnion
