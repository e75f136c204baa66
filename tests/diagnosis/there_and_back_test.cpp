// Lines of a laser that were read there and back beside a form without order: what both sides tell
// of the noise, and what the line of the form says of a scale.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "diagnosis/diagnosis.h"

namespace trunnion {
namespace {

setup::Setup stage_without_noise() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X t\"\n"
        "[machine.axis.X]\ndirection = [1, 0, 0]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, 0]\n"
        "[model]\nmodelled = []\n",
        "s.toml", notes);
}

/// Errors of a line, um; the form has a value of its own at each target.
struct LineErrors {
    double form_um = 0.0, gap_um = 0.0, noise_um = 0.6, scale_ppm = 0.0;
    int runs = 1;
    double zero_um = 0.0;  ///< from run to run more
    std::size_t targets = 10;
    double gap_from_mm = 0.0;  ///< no reversal below
    bool smooth = false;       ///< the form is two_waves()
};

/// A smooth form that no ripple imitates, by the part of the travel.
double two_waves(double part) {
    return std::sin(7.0 * part + 1.0) + 0.5 * std::sin(13.0 * part + 4.0);
}

records::ReadingTable there_and_back(const LineErrors& errors, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::vector<double> form_um;
    for (std::size_t k = 0; k < errors.targets; ++k)
        form_um.push_back(
            errors.form_um *
            (errors.smooth ? two_waves(static_cast<double>(k) / static_cast<double>(errors.targets))
                           : normal(engine)));
    records::ReadingTable table;
    table.path = "line.csv";
    table.axes = {Axis::X};
    table.comment[records::times_key] = records::invented;
    const auto add = [&](double at_mm, std::optional<double> value_um) {
        records::Reading row;
        row.index = static_cast<int>(table.rows.size());
        row.time_s = 60.0 * row.index;
        row.test = "X";
        row.commanded[Axis::X] = at_mm;
        row.feature = "R1";
        if (value_um) {
            row.device = records::Device::linear;
            row.direction_M = Vector3(1, 0, 0);
            row.value_mm = *value_um * 1e-3;
        }
        table.rows.push_back(row);
    };
    double zero_um = 0.0;
    const auto read = [&](std::size_t k, double side) {
        const double at_mm = 15.0 + 5.0 * static_cast<double>(k);
        const double gap_um = at_mm < errors.gap_from_mm ? 0.0 : errors.gap_um;
        add(at_mm, form_um[k] + 0.5 * side * gap_um + 1e-3 * errors.scale_ppm * at_mm + zero_um +
                       errors.noise_um * normal(engine));
    };
    for (int run = 0; run < errors.runs; ++run) {
        add(14.0, {});
        zero_um = errors.zero_um * run;
        for (std::size_t k = 0; k < errors.targets; ++k) read(k, 1.0);
        add(61.0, {});
        for (std::size_t k = errors.targets; k-- > 0;) read(k, -1.0);
    }
    return table;
}

diagnosis::Diagnosis diagnosed_line(const LineErrors& errors, unsigned seed) {
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    return diagnosis::diagnose(stage_without_noise(), there_and_back(errors, seed), options);
}

const diagnosis::Cause* cause_named(const diagnosis::Diagnosis& d, const std::string& name) {
    for (const diagnosis::Cause& c : d.causes)
        if (c.effect == name && (c.points.empty() || name == "X.positioning")) return &c;
    return nullptr;
}

bool has_rival(const diagnosis::Cause& cause, const std::string& name) {
    return std::find(cause.rivals.begin(), cause.rivals.end(), name) != cause.rivals.end();
}

}  // namespace

TEST_CASE("ten readings are too few, and no table in another unit", "[diagnosis]") {
    const records::ReadingTable line = there_and_back({.form_um = 15.0, .targets = 5}, 1);
    CHECK_THROWS_WITH(diagnosis::diagnose(stage_without_noise(), line, {}),
                      Catch::Contains("it takes 12 or more") && !Catch::Contains("seem to be in"));
}

// The form is twice the reversal: each alone leaves the other as scatter, and noise that nobody
// states took both. The differences of both sides scatter by 0.85 um only.
TEST_CASE("one run there and back tells its noise, and with it the reversal beside a form",
          "[diagnosis]") {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        INFO(seed);
        const diagnosis::Diagnosis d = diagnosed_line({.form_um = 15.0, .gap_um = 12.0}, seed);
        CHECK(d.noise_um < 1.5);
        CHECK(d.noise.source == diagnosis::NoiseSource::assumed);
        const diagnosis::Cause* play = cause_named(d, "X.backlash");
        REQUIRE(play);
        CHECK(play->probability > 0.8);
        CHECK(play->written);
    }
}

TEST_CASE("one run there and back without a reversal has no play", "[diagnosis]") {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        INFO(seed);
        const diagnosis::Diagnosis d = diagnosed_line({.form_um = 15.0}, seed);
        const diagnosis::Cause* play = cause_named(d, "X.backlash");
        CHECK((!play || play->probability < 0.5));
    }
}

// Errors of ten targets, 15 um each, have a line of about 330 ppm by themselves.
TEST_CASE("the line of a form is no scale, one far beyond it is", "[diagnosis]") {
    int lines = 0;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        INFO(seed);
        const diagnosis::Diagnosis of_form =
            diagnosed_line({.form_um = 15.0, .noise_um = 2.0, .runs = 4}, seed);
        const diagnosis::Cause* line = cause_named(of_form, "X.scale");
        if (line) {
            ++lines;
            CHECK(line->probability < 0.6);
            CHECK(has_rival(*line, "X.positioning"));
            CHECK(line->written);
        }
        const diagnosis::Diagnosis scaled = diagnosed_line(
            {.form_um = 15.0, .noise_um = 2.0, .scale_ppm = 5000.0, .runs = 4}, seed);
        const diagnosis::Cause* scale = cause_named(scaled, "X.scale");
        REQUIRE(scale);
        CHECK(scale->probability > 0.6);
        CHECK(scale->written);
    }
    CHECK(lines > 0);  // else nothing was tried
}

// Which of the two has the line does not matter for a compensation.
TEST_CASE("pitch data include the line that may be the form's own", "[diagnosis]") {
    const diagnosis::Diagnosis d = diagnosed_line({.form_um = 15.0,
                                                   .noise_um = 1.0,
                                                   .scale_ppm = 300.0,
                                                   .runs = 4,
                                                   .targets = 20,
                                                   .smooth = true},
                                                  2);
    const diagnosis::Cause* form = cause_named(d, "X.positioning");
    const diagnosis::Cause* line = cause_named(d, "X.scale");
    REQUIRE(form);
    REQUIRE(line);
    REQUIRE(line->probability < 0.5);
    CHECK(has_rival(*form, "X.scale"));
    REQUIRE(form->holds_between);
    CHECK(form->includes == "X.scale");
}

// The table of a reversal has no mean, so a reversal at one end of the travel needs both.
TEST_CASE("a reversal over a part of the travel is found beside a form", "[diagnosis]") {
    int named = 0;
    for (unsigned seed = 1; seed <= 6; ++seed) {
        const diagnosis::Diagnosis d =
            diagnosed_line({.form_um = 15.0, .gap_um = 8.0, .gap_from_mm = 42.0}, seed);
        named += std::any_of(d.causes.begin(), d.causes.end(), [](const auto& c) {
            return c.effect == "X.backlash" && c.probability >= 0.5;
        });
    }
    CHECK(named >= 5);
}

// What is written was tried on folds that left out both readings of some targets.
TEST_CASE("a form and a reversal at six targets, read there and back once, are written",
          "[diagnosis]") {
    for (unsigned seed = 1; seed <= 6; ++seed) {
        INFO(seed);
        const diagnosis::Diagnosis d =
            diagnosed_line({.form_um = 15.0, .gap_um = 12.0, .targets = 6}, seed);
        const diagnosis::Cause* play = cause_named(d, "X.backlash");
        REQUIRE(play);
        CHECK(play->written);
    }
}

// The zeros of the runs are free beside the causes: these explain the rest, and nothing said that
// the machine creeps by twice its noise from run to run.
TEST_CASE("zeros of runs that wander are listed beside the causes", "[diagnosis]") {
    const auto lists_zeros = [](const diagnosis::Diagnosis& d) {
        return std::any_of(d.where.begin(), d.where.end(),
                           [](const auto& place) { return place.by == "zero of a cycle"; });
    };
    const LineErrors steady{.gap_um = 40.0, .noise_um = 5.0, .runs = 5};
    LineErrors creeping = steady;
    creeping.zero_um = 8.0;
    const diagnosis::Diagnosis d = diagnosed_line(creeping, 4);
    REQUIRE(cause_named(d, "X.backlash"));
    CHECK(lists_zeros(d));
    CHECK_FALSE(lists_zeros(diagnosed_line(steady, 4)));
}

}  // namespace trunnion
