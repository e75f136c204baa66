// What a judge of lines and turns found: places that are wrong in every visit, rough forms, ripples
// on even targets, wind-up of a rotary axis, long beds.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "base/units.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup judged_bed() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"bed\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\n",
        "bed.toml", notes);
}

setup::Setup judged_turntable() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"t\"\nchain = \"w C b t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, 1]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\n",
        "turn.toml", notes);
}

/// What a line reads: device, direction, axis, targets (mm or rad), runs both ways.
struct Line {
    records::Device device = records::Device::linear;
    Vector3 direction_M = Vector3::UnitX();
    Axis axis = Axis::X;
    std::vector<double> targets;
    int runs = 3;
};

/// Value (mm or rad) of a target on a side, `way` behind the reversal.
using ValueAt = std::function<double(std::size_t target, int side, double way)>;

void add_row(records::ReadingTable& table, const Line& line, double at,
             std::optional<double> value) {
    records::Reading row;
    row.index = static_cast<int>(table.rows.size());
    row.time_s = 10.0 * row.index;
    row.test = "line";
    row.commanded[line.axis] = at;
    if (value) {
        row.device = line.device;
        row.feature = "R1";
        row.angular = line.device == records::Device::angle;
        row.direction_M = line.direction_M;
        row.value_mm = value;
    }
    table.rows.push_back(row);
}

records::ReadingTable there_and_back(const Line& line, double noise_size, unsigned seed,
                                     const ValueAt& value) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, noise_size);
    records::ReadingTable table;
    table.path = "line.csv";
    table.axes = line.axis == Axis::C ? std::vector<Axis>{Axis::C}
                                      : std::vector<Axis>{Axis::X, Axis::Y, Axis::Z};
    const double over = 0.05 * (line.targets.back() - line.targets.front());
    const std::size_t count = line.targets.size();
    for (int run = 0; run < line.runs; ++run)
        for (const int side : {1, -1}) {
            const double from = side > 0 ? line.targets.front() - over : line.targets.back() + over;
            add_row(table, line, from, std::nullopt);
            for (std::size_t k = 0; k < count; ++k) {
                const std::size_t target = side > 0 ? k : count - 1 - k;
                const double at = line.targets[target];
                add_row(table, line, at, value(target, side, std::abs(at - from)) + noise(engine));
            }
        }
    return table;
}

std::vector<double> evenly(int count, double step) {
    std::vector<double> list;
    for (int k = 0; k < count; ++k) list.push_back(step * k);
    return list;
}

/// Independent values of the targets.
std::vector<double> rough(std::size_t count, double size, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> value(0.0, size);
    std::vector<double> list;
    for (std::size_t k = 0; k < count; ++k) list.push_back(value(engine));
    return list;
}

}  // namespace

TEST_CASE("a target that is wrong in every visit is a gap", "[diagnosis][judged]") {
    const double size_mm = GENERATE(0.012, 0.024, 0.09);
    const int count = GENERATE(21, 41);
    const Line line{.targets = evenly(count, 50.0)};
    const auto table = there_and_back(
        line, 1e-3, 3, [&](std::size_t k, int, double) { return k == 7 ? size_mm : 0.0; });
    const diagnosis::Diagnosis d = diagnosed(judged_bed(), table);
    INFO(size_mm << " mm, " << count << " targets: " << said(d) << ", set aside " << d.outliers);
    CHECK(d.verdict != diagnosis::Verdict::no_gap);
    CHECK(d.outliers == 0);
}

TEST_CASE("readings of a target that are spoiled one by one are set aside", "[diagnosis][judged]") {
    const Line line{.targets = evenly(21, 50.0)};
    int visit = 0;
    const auto table = there_and_back(line, 1e-3, 3, [&](std::size_t k, int, double) {
        if (k != 7) return 0.0;
        ++visit;
        return visit == 2 ? 0.03 : visit == 5 ? -0.05 : 0.0;
    });
    const diagnosis::Diagnosis d = diagnosed(judged_bed(), table);
    INFO(said(d) << ", set aside " << d.outliers);
    CHECK(d.verdict == diagnosis::Verdict::no_gap);
    CHECK(d.outliers == 2);
}

TEST_CASE("a tooth that is wrong in every visit is a gap", "[diagnosis][judged]") {
    Line line{records::Device::angle, Vector3::UnitZ(), Axis::C, evenly(36, pi / 18.0), 4};
    const auto table = there_and_back(
        line, 1.5e-6, 5, [](std::size_t k, int, double) { return k == 11 ? 150e-6 : 0.0; });
    const diagnosis::Diagnosis d = diagnosed(judged_turntable(), table);
    INFO(said(d) << ", set aside " << d.outliers);
    CHECK(d.verdict != diagnosis::Verdict::no_gap);
    CHECK(d.outliers == 0);
}

TEST_CASE("errors of any form are followed at each target, whatever their direction",
          "[diagnosis][judged]") {
    const int count = GENERATE(21, 41);
    const auto [device, direction, name] = GENERATE(table<records::Device, Vector3, std::string>(
        {{records::Device::linear, Vector3::UnitX(), "X.positioning"},
         {records::Device::linear, Vector3::UnitY(), "X.straightness"},
         {records::Device::angle, Vector3::UnitY(), "X.angular"}}));
    const Line line{device, direction, Axis::X, evenly(count, 50.0)};
    const std::vector<double> form = rough(line.targets.size(), 0.01, 11);
    const double unit = device == records::Device::angle ? 1e-3 : 1.0;  // 10 urad, 10 um
    const auto value = [&](std::size_t k, int, double) { return unit * form[k]; };
    const diagnosis::Diagnosis d =
        diagnosed(judged_bed(), there_and_back(line, unit * 1e-3, 12, value));
    INFO(name << ", " << count << " targets: " << said(d));
    CHECK(claims(d, name));
    // A specialist's fit, the mean of each target, leaves 1.08 of the noise.
    CHECK(left_beside(d.setup, there_and_back(line, unit * 1e-3, 13, value)) < 1.3e-3 * unit);
}

TEST_CASE("a ripple whose period the targets leave open is written at these",
          "[diagnosis][judged]") {
    const Line line{.targets = evenly(51, 4.0)};
    const bool bowed = GENERATE(false, true);
    const auto value = [&](std::size_t k, int, double) {
        const double q = line.targets[k];
        return 4e-3 * std::sin(2.0 * pi * q / 12.5) + (bowed ? 4e-8 * q * (200.0 - q) : 0.0);
    };
    const diagnosis::Diagnosis d = diagnosed(judged_bed(), there_and_back(line, 3e-4, 1, value));
    INFO(bowed << ": " << said(d));
    CHECK(claims(d, "X.cyclic"));
    CHECK(d.writes_causes);
    CHECK(left_beside(d.setup, there_and_back(line, 3e-4, 2, value)) < 4e-4);
    // Between the targets the period decides: nothing is written there.
    Line between = line;
    for (double& q : between.targets) q += 1.7;
    const auto nothing = [](std::size_t, int, double) { return 0.0; };
    CHECK(left_beside(d.setup, there_and_back(between, 1e-6, 3, nothing)) < 4e-4);
}

TEST_CASE("a ripple of a rotary axis whose order the faces leave open is written at these",
          "[diagnosis][judged]") {
    const Line line{records::Device::angle, Vector3::UnitZ(), Axis::C, evenly(25, pi / 12.0)};
    const auto value = [&](std::size_t k, int side, double) {
        return 20e-6 * std::cos(180.0 * line.targets[k] + 0.4) - 8e-6 * side;
    };
    const diagnosis::Diagnosis d =
        diagnosed(judged_turntable(), there_and_back(line, 1e-6, 1, value));
    INFO(said(d));
    CHECK(claims(d, "C.backlash"));
    CHECK(left_beside(d.setup, there_and_back(line, 1e-6, 2, value)) < 1.4e-6);
}

TEST_CASE("a rotary axis that winds up over some degrees has no error of its position",
          "[diagnosis][judged]") {
    const double decay_rad = rad_from_deg(GENERATE(15.0, 25.0, 40.0));
    const Line line{records::Device::angle, Vector3::UnitZ(), Axis::C, evenly(25, pi / 12.0), 2};
    const auto value = [&](std::size_t, int side, double way) {
        return -side * 19e-6 * (1.0 - 1.5 * std::exp(-way / decay_rad));
    };
    const diagnosis::Diagnosis d =
        diagnosed(judged_turntable(), there_and_back(line, 1.5e-6, 4, value));
    INFO(said(d));
    CHECK(claims(d, "C.backlash"));
    CHECK(probability_of(d, "C.reversal_spike") > 0.5);
    CHECK(probability_of(d, "C.positioning") < 0.5);
    CHECK(left_beside(d.setup, there_and_back(line, 1.5e-6, 5, value)) < 3.0e-6);
}

TEST_CASE("the angles of a bed of six metres are no impossible cause", "[diagnosis][judged]") {
    const Line roll{records::Device::angle, Vector3::UnitX(), Axis::X, evenly(25, 250.0), 2};
    Line pitch = roll;
    pitch.direction_M = Vector3::UnitY();
    const auto along = [&](std::size_t k) { return roll.targets[k]; };
    records::ReadingTable table = there_and_back(roll, 1e-6, 1, [&](std::size_t k, int, double) {
        return 20e-6 * std::sin(1.5 * pi * along(k) / 6000.0);
    });
    // The bed hangs between feet 2.4 m apart.
    const auto slope = [&](std::size_t k, int, double) {
        return 16e-6 * std::sin(2.0 * pi * (along(k) - 600.0) / 2400.0);
    };
    for (records::Reading row : there_and_back(pitch, 1e-6, 2, slope).rows) {
        row.test = "pitch";
        row.index = static_cast<int>(table.rows.size());
        row.time_s += 1000.0;
        table.rows.push_back(row);
    }
    const diagnosis::Diagnosis d = diagnosed(judged_bed(), table);
    INFO(said(d));
    CHECK(d.causes.front().effect == "X.angular");
    CHECK(d.causes.front().probability > 0.8);
}

TEST_CASE("two spoiled ones of 48 separate readings do not refute a cause", "[diagnosis][judged]") {
    const Line line{.targets = evenly(11, 50.0)};
    const auto value = [&](std::size_t k, int side, double) {
        return 5e-3 * side + 1e-5 * line.targets[k];
    };
    const records::ReadingTable table = there_and_back(line, 1e-3, 1, value);
    Line once = line;
    once.targets = evenly(24, 20.0);
    once.runs = 1;
    records::ReadingTable holdout =
        there_and_back(once, 1e-3, 2, [&](std::size_t k, int side, double) {
            const double spoiled = (k == 6 && side > 0) || (k == 17 && side < 0) ? 0.05 : 0.0;
            return 5e-3 * side + 1e-5 * once.targets[k] + spoiled;
        });
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    options.holdout = &holdout;
    const diagnosis::Diagnosis d = diagnosis::diagnose(judged_bed(), table, options);
    INFO(said(d));
    CHECK(probability_of(d, "X.backlash") > 0.8);
    CHECK(d.verdict != diagnosis::Verdict::unexplained);
}

}  // namespace trunnion
