// diagnose --program: stale stores smaller than the noise of a row, and logs on a coarse grid.
#include <cmath>
#include <random>

#include "tests/cli/control_gap_bench.h"

using namespace trunnion::control_gap_bench;  // NOLINT(google-build-using-namespace)

namespace {

const std::string frame = R"(N10 G90 G21 G17 G54
N20 G0 X-30. Y-30.
N30 G1 Z-2. F400.
N40 X30.
N50 Y10.
N60 G3 X20. Y20. I-10. J0.
N70 G1 X-10.
N80 G2 X-30. Y0. R20.
N90 G1 Y-30.
N100 X12. Y7. Z4.
N110 X-14. Y18.
N120 Y-20. Z9.
N130 G0 Z25.
N140 M30
)";

/// A log under another offset, each coordinate changed by `change`.
template <class Change>
Json judged(const Bench& bench, const std::string& g54, Change change) {
    Control there;
    there.g54 = g54;
    bench.asked(frame, {}, there, " --trace-step 0.15");
    std::istringstream lines(bench.read("log.csv"));
    std::string line, text = "line,x_mm,y_mm,z_mm\n";
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        std::vector<std::string> cell;
        std::istringstream cells(line);
        for (std::string one; std::getline(cells, one, ',');) cell.push_back(one);
        text += cell[2];
        for (const std::size_t k : {6U, 7U, 8U}) text += ',' + change(std::stod(cell[k]));
        text += '\n';
    }
    bench.write("log.csv", text);
    return bench.asked();
}

std::string with(int digits, double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return text;
}

}  // namespace

TEST_CASE("diagnose --program: a stale store within the noise shows over many rows") {
    const Bench bench;
    struct Case {
        const char* x;
        double sigma_mm;
        bool stale;
    };
    for (const Case& c :
         {Case{"10.0", 0.01, false}, Case{"10.02", 0.01, true}, Case{"10.01", 0.005, true},
          Case{"10.005", 0.005, true}, Case{"10.0", 0.002, false}}) {
        INFO(c.x << ' ' << c.sigma_mm);
        std::mt19937 random(7);
        std::normal_distribution<double> noise(0.0, c.sigma_mm);
        const Json result = judged(bench, std::string("X = ") + c.x + ", Y = -20.0, Z = 5.0",
                                   [&](double v) { return with(5, v + noise(random)); });
        INFO(result.dump(1));
        if (!c.stale) {
            CHECK(result["verdict"] == "no-gap");
            continue;
        }
        CHECK(result["verdict"] == "ambiguous");  // the external offset does the same
        REQUIRE(result["causes"].size() == 1);
        const Json& claim = result["causes"][0];
        CHECK(claim["effect"] == "G54");
        CHECK(value(claim, "G54.X") == Approx(std::stod(c.x)).margin(0.2 * c.sigma_mm));
    }
}

TEST_CASE("diagnose --program: the mean of noise that lasts over rows is no store") {
    const Bench bench;
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 0.003);
    double last = 0.0;
    const Json result = judged(bench, "X = 10.0, Y = -20.0, Z = 5.0", [&](double v) {
        last = 0.9 * last + 0.3 * noise(random);
        return with(5, v + last + noise(random));
    });
    INFO(result.dump(1));
    CHECK(result["verdict"] == "no-gap");
}

TEST_CASE("diagnose --program: the noise of a log is at least that of the grid of its values") {
    const Bench bench;
    struct Case {
        double grid_mm;
        const char* x;
        bool stale;
    };
    for (const Case& c : {Case{0.00254, "10.0", false}, Case{0.00254, "10.05", true},
                          Case{0.01, "10.0", false}, Case{0.01, "10.05", true}}) {
        INFO(c.grid_mm << ' ' << c.x);
        const Json result =
            judged(bench, std::string("X = ") + c.x + ", Y = -20.0, Z = 5.0",
                   [&](double v) { return with(5, std::round(v / c.grid_mm) * c.grid_mm); });
        INFO(result.dump(1));
        CHECK(result["gap"]["noise_um"].get<double>() > 300.0 * c.grid_mm);
        if (!c.stale) {
            CHECK(result["verdict"] == "no-gap");
            continue;
        }
        CHECK(result["verdict"] == "ambiguous");
        REQUIRE(result["causes"].size() == 1);
        CHECK(result["causes"][0]["effect"] == "G54");
        CHECK(value(result["causes"][0], "G54.X") == Approx(10.05).margin(0.001));
    }
}
