// diagnose --program: numbers of blocks that are late, missing or counted from 0, and logs of a
// part of a program. Positions by hand: straight lines, a sample every 0.7 mm.
#include <cmath>

#include "tests/cli/control_gap_bench.h"

using namespace trunnion::control_gap_bench;  // NOLINT(google-build-using-namespace)

namespace {

struct Corner {
    double x, y, z;
};
/// In the program's coordinates; block k + 1 of the program ends at corner k, the first is the
/// start.
const std::vector<Corner> way{{0, 0, 0},    {31, 0, 0},   {31, 22, 0}, {13, 22, 0}, {13, 5, -6},
                              {2, 5, -6},   {2, 9, -6},   {26, 9, -6}, {26, 9, 11}, {7, 3, 11},
                              {7, 18, 11},  {38, 18, 2},  {38, 4, 2},  {19, 4, 2},  {19, 16, -3},
                              {33, 16, -3}, {33, 26, -3}, {0, 26, 9},  {0, 0, 9},   {12, 7, 1}};

std::string number_of(double value) {
    return std::to_string(value);
}

std::string program(const std::vector<Corner>& corners) {
    std::string out = "G90 G21 G17 G54\n";
    for (std::size_t k = 1; k < corners.size(); ++k)
        out += "N" + std::to_string(10 * k) + " G1 X" + number_of(corners[k].x) + " Y" +
               number_of(corners[k].y) + " Z" + number_of(corners[k].z) + " F500.\n";
    return out + "M30\n";
}

struct Sample {
    Corner at;
    int block;  ///< 1: the first with motion
};

std::vector<Sample> samples(const std::vector<Corner>& corners, const Corner& offset) {
    std::vector<Sample> out;
    double left = 0.0;  // before the next sample
    for (std::size_t k = 1; k < corners.size(); ++k) {
        const Corner &a = corners[k - 1], &b = corners[k];
        const double length = std::hypot(b.x - a.x, b.y - a.y, b.z - a.z);
        double way_mm = left;
        for (; way_mm < length; way_mm += 0.7) {
            const double s = way_mm / length;
            out.push_back({{a.x + s * (b.x - a.x) + offset.x, a.y + s * (b.y - a.y) + offset.y,
                            a.z + s * (b.z - a.z) + offset.z},
                           static_cast<int>(k)});
        }
        left = way_mm - length;
    }
    return out;
}

std::string text(const std::string& column, const std::vector<Sample>& rows,
                 const std::vector<std::string>& numbers) {
    std::string out = column + "x_mm,y_mm,z_mm\n";
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!column.empty()) out += numbers[i] + ",";
        out += number_of(rows[i].at.x) + "," + number_of(rows[i].at.y) + "," +
               number_of(rows[i].at.z) + "\n";
    }
    return out;
}

/// N numbers, `late(i)` rows behind at row i.
template <class Late>
std::vector<std::string> numbers(const std::vector<Sample>& rows, Late late) {
    std::vector<std::string> out;
    for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
        const int from = std::clamp(i - late(i), 0, static_cast<int>(rows.size()) - 1);
        out.push_back(std::to_string(10 * rows[static_cast<std::size_t>(from)].block));
    }
    return out;
}
std::vector<std::string> in_time(const std::vector<Sample>& rows) {
    return numbers(rows, [](int) { return 0; });
}

unsigned random_of(unsigned& seed) {
    seed = seed * 1664525U + 1013904223U;
    return seed >> 8U;
}

Json judged(const Bench& bench, const std::string& log, const std::string& of = program(way)) {
    Control here;
    here.g54 = "X = 0.0";
    bench.write("here.toml", here.text());
    bench.write("part.nc", of);
    bench.write("log.csv", log);
    return bench.asked();
}

const Corner same{0, 0, 0}, stale{0.05, 0, 0};

/// A log with `write` of the same control, of a stale G54, and of a program with one other number.
template <class Write>
void check_three(const Bench& bench, const std::string& note, Write write) {
    Json result = judged(bench, write(samples(way, same)));
    INFO(result.dump(1) << bench.read("err.txt"));
    CHECK(result["verdict"] == "no-gap");
    CHECK_THAT(bench.read("err.txt"), Catch::Contains(note));
    result = judged(bench, write(samples(way, stale)));
    INFO(result.dump(1) << bench.read("err.txt"));
    CHECK_THAT(bench.read("err.txt"), Catch::Contains(note));
    CHECK((result["verdict"] == "explained" || result["verdict"] == "ambiguous"));
    CHECK(cause(result)["effect"] == "G54");
    CHECK(value(cause(result), "G54.X") == Approx(0.05).margin(1e-3));
    std::vector<Corner> edited = way;
    edited[12].x += 0.8;
    edited[13].x += 0.8;
    result = judged(bench, write(samples(edited, same)));
    INFO(result.dump(1) << bench.read("err.txt"));
    CHECK(result["verdict"] == "unexplained");
    for (const Json& claim : result["causes"])
        if (claim["effect"] != "unknown") CHECK(claim["probability"].get<double>() < 0.5);
}

}  // namespace

TEST_CASE("diagnose --program: numbers in time get no note, whatever the gap") {
    const Bench bench;
    check_three(bench, "N numbers of the program",
                [](const std::vector<Sample>& rows) { return text("N,", rows, in_time(rows)); });
    CHECK_THAT(bench.read("err.txt"), !Catch::Contains("the positions"));
}

TEST_CASE("diagnose --program: late or early numbers hide no store and make none") {
    const Bench bench;
    for (const int late : {1, 2, 4, -1}) {
        INFO("late by " << late);
        const std::string note = std::to_string(std::abs(late)) + " rows " +
                                 (late > 0 ? "behind" : "ahead of") + " the positions";
        check_three(bench, note, [late](const std::vector<Sample>& rows) {
            return text("N,", rows, numbers(rows, [late](int) { return late; }));
        });
    }
    for (const int least : {0, 1}) {
        INFO("late by " << least << " and up to two more");
        check_three(bench, "rows behind the positions", [least](const std::vector<Sample>& rows) {
            return text("N,", rows, numbers(rows, [least](int i) { return least + i / 60 % 3; }));
        });
    }
}

TEST_CASE("diagnose --program: rows without a number go by their neighbours or positions") {
    const Bench bench;
    for (const bool runs : {false, true}) {
        INFO("runs " << runs);
        check_three(bench, "N numbers of the program", [runs](const std::vector<Sample>& rows) {
            std::vector<std::string> told = in_time(rows);
            unsigned seed = 11;
            for (std::size_t i = 0; i < told.size(); ++i)
                if (random_of(seed) % 100 < (runs ? 3 : 30))
                    for (std::size_t k = i; k < std::min(told.size(), i + (runs ? 12 : 1)); ++k)
                        told[k].clear();
            return text("N,", rows, told);
        });
    }
}

TEST_CASE("diagnose --program: lines that are counted from 0") {
    const Bench bench;
    check_three(bench, "the lines agree if the first one is 0",
                [](const std::vector<Sample>& rows) {
                    std::vector<std::string> told;
                    for (const Sample& row : rows) told.push_back(std::to_string(row.block));
                    return text("line,", rows, told);
                });
    check_three(bench, "", [](const std::vector<Sample>& rows) {
        std::vector<std::string> told;
        for (const Sample& row : rows) told.push_back(std::to_string(row.block + 1));
        return text("line,", rows, told);
    });
    CHECK_THAT(bench.read("err.txt"), !Catch::Contains("the first one is 0"));
}

TEST_CASE("diagnose --program: a log that begins within the program") {
    const Bench bench;
    const auto later = [](std::vector<Sample> rows) {
        rows.erase(rows.begin(), rows.begin() + 150);  // within block 6
        return rows;
    };
    const std::string note = "begins within the program: the moves before line";
    check_three(bench, note, [&](const std::vector<Sample>& rows) {
        return text("N,", later(rows), in_time(later(rows)));
    });
    check_three(bench, note,
                [&](const std::vector<Sample>& rows) { return text("", later(rows), {}); });
    check_three(bench, note, [&](const std::vector<Sample>& rows) {
        std::vector<std::string> told;
        for (const Sample& row : later(rows)) told.push_back(std::to_string(row.block));
        return text("line,", later(rows), told);
    });
}

TEST_CASE("diagnose --program: a first block that the other control skips is no later begin") {
    const Bench bench;
    std::string skipping = program(way);
    skipping.insert(skipping.find("N10 "), "/N5 G1 X50. Y7. Z3. F500.\n");
    const std::vector<Sample> rows = samples(way, same);
    for (const char* column : {"N,", ""}) {
        const Json result = judged(bench, text(column, rows, in_time(rows)), skipping);
        INFO(result.dump(1) << bench.read("err.txt"));
        CHECK(cause(result)["effect"] == "block_skip.1=on");
        CHECK_THAT(bench.read("err.txt"), !Catch::Contains("begins within"));
    }
}
