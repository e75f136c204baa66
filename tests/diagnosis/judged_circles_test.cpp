// What a judge of circles found: keys of a spike or a ripple were sought beside the set-up alone,
// and what a wrong key leaves became tables; a true play beside a lag was doubted for its sign.
// Circles of this file's own arithmetic.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <string>

#include "base/units.h"
#include "diagnosis/prepare/turning_points.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

constexpr double circle_mm = 150.0, circle_noise_mm = 3e-4;

setup::Setup judged_mill() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n"
        "[ballbar]\ncup_mm = [0, 0, -120]\nlength_mm = 150\nfree = [\"cup\", \"length\"]\n"
        "[[artefact]]\nname = \"P1\"\nkind = \"center_pivot\"\ncenter_mm = [200, 150, 60]\n"
        "free = [\"center\"]\n"
        "[model]\nmodelled = []\nnoise_um = { ballbar = 0.3 }\n",
        "mill.toml", notes);
}

/// Errors of a mill that turns in circles; of X where no axis is named.
struct Mill {
    double spike_mm = 0.0, spike_y_mm = 0.0, decay_mm = 1.0;
    double gap_mm = 0.0, gap_y_mm = 0.0;
    double lag_s = 0.0;  ///< of X, less that of Y
    double scale = 0.0, ripple_mm = 0.0, period_mm = 10.0, squareness_rad = 0.0;
};

/// Position along an axis and its way.
struct Along {
    double at_mm = 0.0, speed_mm_s = 0.0;
    double sign() const { return speed_mm_s > 0.0 ? 1.0 : -1.0; }
    double since_reversal_mm() const { return circle_mm + sign() * at_mm; }
};

double play_and_spike_mm(const Along& a, double gap_mm, double spike_mm, double decay_mm) {
    return a.sign() * (0.5 * gap_mm - spike_mm * std::exp(-a.since_reversal_mm() / decay_mm));
}

double longer_mm(const Mill& m, double angle, double speed_rad_s) {
    const Along x{circle_mm * std::cos(angle), -circle_mm * std::sin(angle) * speed_rad_s};
    const Along y{circle_mm * std::sin(angle), circle_mm * std::cos(angle) * speed_rad_s};
    const double place_mm = 200.0 + x.at_mm;
    const double dx = play_and_spike_mm(x, m.gap_mm, m.spike_mm, m.decay_mm) -
                      m.lag_s * x.speed_mm_s + m.scale * x.at_mm +
                      m.ripple_mm * std::cos(2.0 * pi * place_mm / m.period_mm + 0.5) -
                      m.squareness_rad * y.at_mm;
    const double dy = play_and_spike_mm(y, m.gap_y_mm, m.spike_y_mm, m.decay_mm);
    return dx * std::cos(angle) + dy * std::sin(angle);
}

/// Circles both ways at two feeds, `from_deg` on.
records::ReadingTable circles(const Mill& mill, unsigned seed, double from_deg = 45.37) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, circle_noise_mm);
    records::ReadingTable table;
    table.path = "circles.csv";
    table.axes = {Axis::X, Axis::Y, Axis::Z};
    double time_s = 0.0;
    for (const double feed_mm_min : {500.0, 2000.0})
        for (const int sense : {1, -1}) {
            const double speed_rad_s = sense * feed_mm_min / 60.0 / circle_mm;
            for (int k = 0; k <= 240; ++k) {
                const double angle = rad_from_deg(from_deg + sense * 1.5 * k);
                records::Reading row;
                row.index = static_cast<int>(table.rows.size());
                row.time_s = time_s += rad_from_deg(1.5) / std::abs(speed_rad_s);
                row.test = (sense > 0 ? "ccw " : "cw ") + std::to_string(int(feed_mm_min));
                row.device = records::Device::ballbar;
                row.feature = "P1";
                row.feed_mm_min = feed_mm_min;
                row.commanded[Axis::X] = 200.0 + circle_mm * std::cos(angle);
                row.commanded[Axis::Y] = 150.0 + circle_mm * std::sin(angle);
                row.commanded[Axis::Z] = 180.0;
                row.value_mm = longer_mm(mill, angle, speed_rad_s) + noise(engine);
                table.rows.push_back(row);
            }
            time_s += 60.0;
        }
    return table;
}

/// The effects are claimed, nothing else is, and later circles are predicted.
void check_found(const Mill& mill, const std::vector<std::string>& effects) {
    const diagnosis::Diagnosis d = diagnosed(judged_mill(), circles(mill, 1));
    INFO(said(d));
    for (const std::string& effect : effects) CHECK(probability_of(d, effect) > 0.8);
    for (const diagnosis::Cause& cause : d.causes)
        if (cause.probability >= 0.8)
            CHECK(std::count(effects.begin(), effects.end(), cause.effect) == 1);
    CHECK(left_beside(d.setup, circles(mill, 2)) < 1.15 * circle_noise_mm);
}

}  // namespace

TEST_CASE("a spike beside a play has its own decay", "[diagnosis][judged][circle]") {
    check_found({.spike_mm = 0.02, .gap_mm = 0.01}, {"X.reversal_spike", "X.backlash"});
}

TEST_CASE("a spike beside a lag has its own decay", "[diagnosis][judged][circle]") {
    check_found({.spike_mm = 0.02, .lag_s = 1e-3}, {"X.reversal_spike", "servo.mismatch"});
}

TEST_CASE("a spike beside a ripple has its own decay", "[diagnosis][judged][circle]") {
    check_found({.spike_mm = 0.012, .ripple_mm = 0.004}, {"X.reversal_spike", "X.cyclic"});
}

TEST_CASE("a ripple beside a scale has its own period", "[diagnosis][judged][circle]") {
    // A circle does not tell the scale of X from that of Y and the length of the bar.
    const Mill mill{.scale = 80e-6, .ripple_mm = 0.01};
    const diagnosis::Diagnosis d = diagnosed(judged_mill(), circles(mill, 1));
    INFO(said(d));
    CHECK(probability_of(d, "X.cyclic") > 0.8);
    for (const diagnosis::Cause& cause : d.causes)
        if (cause.probability >= 0.8) CHECK(cause.effect == "X.cyclic");
    CHECK(left_beside(d.setup, circles(mill, 2)) < 1.15 * circle_noise_mm);
}

TEST_CASE("a play against a lag is no correction of it", "[diagnosis][judged][circle]") {
    const double gap_mm = GENERATE(7e-3, -7e-3);
    check_found({.gap_mm = gap_mm, .lag_s = 0.55e-3}, {"X.backlash", "servo.mismatch"});
}

TEST_CASE("the first row of a circle that begins at a quadrant tells no spike",
          "[diagnosis][judged][circle]") {
    const auto rows_of = [](double from_deg) {
        return diagnosis::turning_starts(
            diagnosis::prepare(judged_mill(), circles({}, 1, from_deg)));
    };
    CHECK(rows_of(0.0) == std::vector<std::size_t>{0, 241, 482, 723});
    CHECK(rows_of(45.37).empty());
    // The way back passes the quadrant between its first rows.
    CHECK(rows_of(0.4) == std::vector<std::size_t>{241, 723});

    const Mill mill{.gap_mm = 0.01, .lag_s = 1e-3};
    const diagnosis::Diagnosis d = diagnosed(judged_mill(), circles(mill, 1, 0.0));
    INFO(said(d));
    CHECK(probability_of(d, "X.reversal_spike") < 0.5);
    CHECK(probability_of(d, "X.backlash") > 0.8);
}

}  // namespace trunnion
