// Lines of one axis as judges from outside made them: readings in another order, to the last digit,
// over part of a turn, at few targets. Each of them was answered wrongly once.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "setup/setup.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// A machine with one axis, X or C; `limits`: a line of its table, or empty.
setup::Setup one_axis(bool rotary, const std::string& limits = "") {
    std::vector<std::string> notes;
    const std::string name = rotary ? "C" : "X";
    return setup::parse_setup(
        "[machine]\nname = \"one axis\"\nchain = \"" + std::string(rotary ? "w b C t" : "w b X t") +
            "\"\n[machine.axis." + name + "]\n" +
            (rotary ? "direction = [0, 0, 1]\npoint_mm = [0, 0, 0]\n" : "direction = [1, 0, 0]\n") +
            limits +
            "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
            "[model]\nmodelled = []\n",
        "one.toml", notes);
}

/// What the axis does at a target when it comes from a side, mm or rad.
using Deviation = std::function<double(std::size_t target, int side)>;

/// Readings of one axis: targets (mm or rad), noise (mm or rad), and the step of the last digit (0:
/// none).
struct Readings {
    bool rotary = false;
    std::vector<double> target;
    Deviation deviation;
    double noise = 0.0, digit = 0.0;
    records::ReadingTable table = {};
    std::mt19937_64 engine{1};

    void move_to(double position) {
        records::Reading row;
        row.index = static_cast<int>(table.rows.size());
        row.time_s = 10.0 * row.index;
        row.commanded[axis()] = position;
        row.test = "test";
        table.rows.push_back(row);
    }
    void read(std::size_t k, int side) {
        move_to(target[k] - side * 0.01 * (target.back() - target.front()));
        move_to(target[k]);
        records::Reading& row = table.rows.back();
        row.device = rotary ? records::Device::angle : records::Device::linear;
        row.feature = "R1";
        row.angular = rotary;
        row.direction_M = rotary ? Vector3::UnitZ() : Vector3::UnitX();
        double value = deviation(k, side) + noise * std::normal_distribution<double>()(engine);
        if (digit > 0.0) value = digit * std::round(value / digit);
        row.value_mm = value;
    }
    /// Runs over all targets, up and down.
    void read_runs(int runs) {
        const std::size_t n = target.size();
        for (int run = 0; run < runs; ++run) {
            for (std::size_t k = 0; k < n; ++k) read(k, 1);
            for (std::size_t k = n; k-- > 0;) read(k, -1);
        }
    }
    diagnosis::Diagnosis diagnosed(const std::string& limits = "") {
        table.path = "test.csv";
        table.axes = {axis()};
        table.side_before[index_of(axis())] = -1;
        return diagnosis::diagnose(one_axis(rotary, limits), table);
    }
    Axis axis() const { return rotary ? Axis::C : Axis::X; }
};

std::vector<double> evenly(double first, double last, std::size_t count) {
    std::vector<double> list;
    for (std::size_t k = 0; k < count; ++k)
        list.push_back(first +
                       (last - first) * static_cast<double>(k) / static_cast<double>(count - 1));
    return list;
}

/// Independent numbers of this size, the same for the same seed.
std::vector<double> drawn(std::size_t count, double size, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> number(0.0, size);
    std::vector<double> list;
    for (std::size_t k = 0; k < count; ++k) list.push_back(number(engine));
    return list;
}

const diagnosis::Cause* most_probable(const diagnosis::Diagnosis& d, const std::string& effect) {
    const diagnosis::Cause* best = nullptr;
    for (const diagnosis::Cause& c : d.causes)
        if (c.effect == effect && (!best || c.probability.value() > best->probability.value()))
            best = &c;
    return best;
}

}  // namespace

TEST_CASE("targets read many times each are no cycles of their own", "[diagnosis]") {
    const std::vector<double> form_mm = drawn(11, 8e-3, 3);
    for (const bool blocks : {true, false}) {
        Readings r{false, evenly(0.0, 500.0, 11),
                   [&](std::size_t k, int side) { return form_mm[k] - 2.5e-3 * side; }, 3e-4};
        if (blocks)
            for (std::size_t k = 0; k < r.target.size(); ++k)
                for (const int side : {1, -1})
                    for (int time = 0; time < 6; ++time) r.read(k, side);
        else
            r.read_runs(6);
        const diagnosis::Diagnosis d = r.diagnosed();
        INFO(blocks << ' ' << said(d));
        CHECK(probability_of(d, "X.positioning") > 0.8);
        CHECK(probability_of(d, "X.backlash") > 0.8);
        CHECK(d.explained > 0.95);
        CHECK(d.after_rms_um < 0.6);
    }
}

TEST_CASE("readings that repeat to their last digit are explained", "[diagnosis]") {
    constexpr double arcsec = pi / 180.0 / 3600.0;
    const std::vector<double> at = evenly(-0.5 * pi, 0.5 * pi, 7);
    Readings r{true, at, [&](std::size_t k, int) { return 8.0 * arcsec * std::sin(at[k]); }, 0.0,
               0.1 * arcsec};
    r.read_runs(3);
    const diagnosis::Diagnosis d = r.diagnosed("limits_deg = [-110, 110]\n");
    INFO(said(d));
    CHECK(probability_of(d, "C.positioning") > 0.7);
    CHECK(d.explained > 0.95);
    // A tenth of a second of arc is 0.48 urad, evenly distributed.
    CHECK(d.noise_um == Approx(0.14).epsilon(0.1));
}

TEST_CASE("a form over part of a turn is a table, within any limits of travel", "[diagnosis]") {
    for (const char* limits : {"", "limits_deg = [-20, 80]\n", "limits_deg = [-179, 179]\n"})
        for (const unsigned seed : {1u, 2u, 6u}) {
            const std::vector<double> form_rad = drawn(8, 4e-5, seed);
            Readings r{true, evenly(0.0, rad_from_deg(45.0), 8),
                       [&](std::size_t k, int) { return form_rad[k]; }, 3e-6};
            r.engine.seed(seed);
            r.read_runs(5);
            const diagnosis::Diagnosis d = r.diagnosed(limits);
            INFO(limits << seed << ' ' << said(d));
            CHECK(probability_of(d, "C.positioning") > 0.7);
            CHECK(probability_of(d, "control.rounding") < 0.3);
            CHECK(d.outliers == 0);
            CHECK(d.after_rms_um < 5.0);
        }
}

TEST_CASE("a play that differs between three targets is found", "[diagnosis]") {
    const std::vector<double> form_mm = {0.012, -0.007, 0.009}, play_mm = {0.005, 0.0085, -0.0036};
    Readings r{false,
               {15.0, 35.0, 55.0},
               [&](std::size_t k, int side) { return form_mm[k] + 0.5 * side * play_mm[k]; },
               1e-3};
    for (int time = 0; time < 10; ++time)
        for (std::size_t k = 0; k < 3; ++k)
            for (const int side : {1, -1}) r.read(k, side);
    const diagnosis::Diagnosis d = r.diagnosed();
    INFO(said(d));
    CHECK(probability_of(d, "X.backlash") > 0.8);
    CHECK(d.after_rms_um < 1.2);
}

TEST_CASE("an uneven resolver has an order and its overtone, and no fast ripple", "[diagnosis]") {
    std::vector<double> at = evenly(0.0, 2.0 * pi, 101);
    at.pop_back();
    for (std::size_t k = 0; k < at.size(); ++k)
        at[k] += 0.004 * std::sin(7.3 * static_cast<double>(k));
    Readings r{true, at,
               [&](std::size_t k, int) {
                   return 1.4e-2 * std::sin(4.0 * at[k]) + 1.4e-3 * std::cos(8.0 * at[k]);
               },
               2e-4};
    r.read_runs(1);
    const diagnosis::Diagnosis d = r.diagnosed();
    INFO(said(d));
    CHECK(probability_of(d, "C.positioning") > 0.6);
    CHECK(probability_of(d, "C.cyclic") < 0.3);
    CHECK(d.after_rms_um < 300.0);
}

TEST_CASE("the screw of a short stage has its ripple", "[diagnosis]") {
    for (const double period_mm : {1.0, 2.0}) {
        std::mt19937_64 engine(5);
        std::uniform_real_distribution<double> place_mm(0.0, 50.0);
        std::vector<double> at;
        for (int k = 0; k < 60; ++k) at.push_back(place_mm(engine));
        std::sort(at.begin(), at.end());
        Readings r{
            false, at,
            [&](std::size_t k, int) { return 0.02 * std::sin(2.0 * pi * at[k] / period_mm); },
            3e-4};
        r.read_runs(2);
        const diagnosis::Diagnosis d = r.diagnosed();
        const diagnosis::Cause* ripple = most_probable(d, "X.cyclic");
        INFO(period_mm << ' ' << said(d));
        REQUIRE(ripple);
        CHECK(ripple->probability.value() > 0.8);
        for (const auto& p : ripple->parameters)
            if (p.name == "period_mm") CHECK(p.value == Approx(period_mm).epsilon(0.002));
    }
}

TEST_CASE("a ripple at few targets far apart is a rival of the line that it looks like",
          "[diagnosis]") {
    // Five pairs of places 10.2 mm apart: a ripple of 2 mm falls along them.
    std::vector<double> at;
    for (int k = 0; k < 5; ++k)
        for (const double more_mm : {0.0, 0.2}) at.push_back(15.0 + 10.2 * k + more_mm);
    Readings r{false, at, [&](std::size_t k, int) { return 0.021 * std::cos(pi * at[k]); }, 2.6e-5};
    r.read_runs(5);
    const diagnosis::Diagnosis d = r.diagnosed();
    INFO(said(d));
    CHECK(probability_of(d, "X.scale") < 0.5);
    bool named = false;
    for (const diagnosis::Cause& c : d.causes)
        named = named || c.effect == "X.cyclic" ||
                std::count(c.rivals.begin(), c.rivals.end(), "X.cyclic") > 0;
    CHECK(named);
    CHECK(d.verdict != diagnosis::Verdict::explained);
}

TEST_CASE("deviations of a tenth of a micrometre are in their unit", "[diagnosis]") {
    Readings r{
        false, evenly(0.0, 60.0, 12),
        [](std::size_t k, int side) { return 1e-6 * static_cast<double>(k) + 1.0e-4 * side; },
        1.2e-5};
    r.read_runs(1);
    const diagnosis::Diagnosis d = r.diagnosed();
    INFO(said(d));
    CHECK(probability_of(d, "X.backlash") > 0.7);
    for (const diagnosis::Cause& c : d.causes)
        CHECK(std::count(c.rivals.begin(), c.rivals.end(), "readings.mistaken") == 0);
}

}  // namespace trunnion
