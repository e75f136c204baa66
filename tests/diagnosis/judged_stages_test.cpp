// What a judge of real stages found: few repeats, displays that show zero, a play that winds up
// over a part of the travel, the start of the first pass, and separate readings beside a setup
// without the cause.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "base/units.h"
#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup judged_stage(const std::string& noise = "") {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\n" +
            noise,
        "m.toml", notes);
}

/// A line of X; nothing read at NaN.
void add_reading(records::ReadingTable& table, double at_mm, double value_mm) {
    records::Reading row;
    row.index = static_cast<int>(table.rows.size());
    row.time_s = 20.0 * row.index;
    row.test = "x";
    row.commanded[Axis::X] = at_mm;
    if (!std::isnan(value_mm)) {
        row.device = records::Device::linear;
        row.feature = "R1";
        row.direction_M = Vector3::UnitX();
        row.value_mm = value_mm;
    }
    table.rows.push_back(row);
}

records::ReadingTable stage_table() {
    records::ReadingTable table;
    table.path = "x.csv";
    table.axes = {Axis::X};
    return table;
}

/// One way over 0, 50, .. mm again and again.
records::ReadingTable one_way(int targets, int runs, const std::function<double(int, int)>& mm) {
    records::ReadingTable table = stage_table();
    for (int run = 0; run < runs; ++run) {
        add_reading(table, -5.0, NAN);
        for (int k = 0; k < targets; ++k) add_reading(table, 50.0 * k, mm(k, run));
    }
    return table;
}

/// There and back over a part of the travel, again and again: a play of 15 um, of which a part
/// builds up on the way behind each reversal.
records::ReadingTable wound_up(double decay_mm, std::uint64_t seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 3e-4);
    records::ReadingTable table = stage_table();
    double at_mm = -60.0, since_mm = 0.0;
    int side = 1;
    add_reading(table, at_mm, NAN);
    const auto go_to = [&](double end_mm) {
        const int way = end_mm > at_mm ? 1 : -1;
        if (way != side) since_mm = 0.0;
        side = way;
        while (std::abs(end_mm - at_mm) > 1e-9) {
            at_mm += 5.0 * side;
            since_mm += 5.0;
            const double wound = 1.0 - 2.0 * std::exp(-since_mm / decay_mm);
            add_reading(table, at_mm, -8e-3 * side * wound + noise(engine));
        }
    };
    for (const double end_mm : {50.0, -50.0, 20.0, -20.0, 50.0, 0.0, 30.0, -50.0}) go_to(end_mm);
    return table;
}

}  // namespace

TEST_CASE("few repeats that contradict the usual noise are the noise", "[diagnosis][judged]") {
    const double size_mm = GENERATE(0.005, 0.02);
    int loud = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        std::mt19937_64 engine(seed);
        std::normal_distribution<double> noise(0.0, size_mm);
        const auto table = one_way(4, 3, [&](int, int) { return noise(engine); });
        if (diagnosed(judged_stage(), table).verdict != diagnosis::Verdict::no_gap) ++loud;
    }
    CHECK(loud <= 3);
}

TEST_CASE("some repeats that are small by accident do not contradict what is stated",
          "[diagnosis][judged]") {
    // Differences of two runs of 0.55 of the size that 1 um would give; chance 0.02.
    constexpr double mean_um[] = {0.9, -1.2, 0.3, 1.6, -0.4, -0.8, 1.1, -1.5, 0.2, 0.7, -0.9, 0.6};
    constexpr double half_um[] = {0.4,  -0.5, 0.3,  0.45, -0.3, -0.4,
                                  0.35, 0.5,  -0.4, 0.3,  -0.5, 0.2};
    const auto table = one_way(12, 2, [&](int k, int run) {
        return 1e-3 * (mean_um[k] + (run == 0 ? half_um[k] : -half_um[k]));
    });
    const diagnosis::Diagnosis d = diagnosed(judged_stage("noise_um = { linear = 1.0 }\n"), table);
    INFO(said(d));
    CHECK(d.noise.source == diagnosis::NoiseSource::given);
    CHECK(d.verdict == diagnosis::Verdict::no_gap);
}

TEST_CASE("a display that shows zero most of the time has a last digit", "[diagnosis][judged]") {
    const auto table = one_way(11, 6, [](int k, int run) {
        return (k == 3 && run == 1) || (k == 7 && run == 4) || (k == 8 && run == 2) ? 0.01 : 0.0;
    });
    const diagnosis::Diagnosis d = diagnosed(judged_stage(), table);
    INFO(said(d) << ", set aside " << d.outliers);
    CHECK(d.verdict == diagnosis::Verdict::no_gap);
    CHECK(d.outliers == 0);
}

TEST_CASE("a play that winds up over a part of the travel is a play", "[diagnosis][judged]") {
    const double decay_mm = GENERATE(6.0, 8.0);
    const diagnosis::Diagnosis d = diagnosed(judged_stage(), wound_up(decay_mm, 3));
    INFO(decay_mm << " mm: " << said(d));
    CHECK(claims(d, "X.backlash"));
    CHECK(d.verdict != diagnosis::Verdict::unexplained);
}

TEST_CASE("what the start of one pass shows is never nearly certain", "[diagnosis][judged]") {
    // Hysteresis that begins unwound: in the first pass alone there is no reversal behind.
    std::mt19937_64 engine(GENERATE(1, 2, 3));
    std::normal_distribution<double> noise(0.0, 4e-4);
    records::ReadingTable table = stage_table();
    double at_mm = -5.0, wound = 0.0;
    add_reading(table, at_mm, NAN);
    const auto go_to = [&](double next_mm, bool reads) {
        const double side = next_mm > at_mm ? 1.0 : -1.0;
        wound += (side - wound) * (1.0 - std::exp(-std::abs(next_mm - at_mm) / 20.0));
        at_mm = next_mm;
        add_reading(table, at_mm, reads ? -5.7e-3 * wound + noise(engine) : NAN);
    };
    for (int run = 0; run < 3; ++run) {
        for (int k = 0; k <= 14; ++k) go_to(25.0 * k, true);
        go_to(355.0, false);
        for (int k = 14; k >= 0; --k) go_to(25.0 * k, true);
        go_to(-5.0, false);
    }
    const diagnosis::Diagnosis d = diagnosed(judged_stage(), table);
    INFO(said(d));
    CHECK(claims(d, "X.backlash"));
    for (const diagnosis::Cause& cause : d.causes)
        if (cause.effect == "thermal.drift") CHECK(cause.probability < 0.75);
}

TEST_CASE("separate readings do not refute a cause that the tested setup lacks",
          "[diagnosis][judged]") {
    // A ripple of 12.5 mm at targets every 4 mm: other periods are the same there.
    std::mt19937_64 engine(5);
    std::normal_distribution<double> noise(0.0, 3e-4);
    const auto rippled = [&](int runs) {
        records::ReadingTable table = stage_table();
        for (int run = 0; run < runs; ++run) {
            add_reading(table, -5.0, NAN);
            for (int k = 0; k <= 50; ++k)
                add_reading(table, 4.0 * k,
                            4e-3 * std::sin(2.0 * pi * 4.0 * k / 12.5) + noise(engine));
        }
        return table;
    };
    const records::ReadingTable table = rippled(4), holdout = rippled(1);
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    const diagnosis::Diagnosis alone = diagnosis::diagnose(judged_stage(), table, options);
    options.holdout = &holdout;
    const diagnosis::Diagnosis beside = diagnosis::diagnose(judged_stage(), table, options);
    INFO(said(alone) << "; " << said(beside));
    REQUIRE(claims(alone, "X.cyclic"));
    REQUIRE(claims(beside, "X.cyclic"));
    CHECK(beside.causes.front().probability > alone.causes.front().probability - 0.05);
    CHECK(beside.verdict == alone.verdict);
}

TEST_CASE("a slip that is as likely as its rival is written", "[diagnosis][judged]") {
    std::mt19937_64 engine(7);
    std::normal_distribution<double> noise(0.0, 1e-3);
    const auto table = one_way(
        11, 6, [&](int k, int run) { return noise(engine) + (11 * run + k > 30 ? -0.04 : 0.0); });
    const diagnosis::Diagnosis d = diagnosed(judged_stage(), table);
    INFO(said(d));
    REQUIRE(claims(d, "artefact.moved"));
    CHECK(d.writes_causes);
}

}  // namespace trunnion
