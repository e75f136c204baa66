// The noise that a diagnosis finds, and the simpler forms of a cause.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "diagnosis/groups/candidate_groups.h"
#include "tests/support/campaign.h"
#include "tests/support/said.h"

namespace trunnion {

TEST_CASE("readings that scatter more or less than stated have a noise of that scale",
          "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 80, 3);
    for (const double scale : {0.75, 1.3}) {
        const diagnosis::Diagnosis d = diagnosis::diagnose(
            setup, campaign::measured(campaign::real_machine(setup), table, 4, scale));
        INFO(scale);
        CHECK(d.noise.sphere.scale == Approx(scale).epsilon(0.12));
    }
}

// Without noise the likelihood has no bound: a noise far below the arithmetic of the prediction
// left fits that were no numbers.
TEST_CASE("exact readings that no effect explains have a verdict", "[diagnosis]") {
    std::vector<std::string> notes;
    const setup::Setup setup =
        setup::load_setup(TRUNNION_SOURCE_DIR "/machines/bc_table.toml", notes);
    records::ReadingTable table = campaign::empty_table(setup);
    double before_rad = 0.0;
    for (int k = 0; k < 3000; ++k) {
        records::Reading row;
        const double c_rad = rad_from_deg(std::fmod(137.508 * k, 600.0) - 300.0);
        row.index = k;
        row.time_s = k;
        row.test = "t";
        row.device = records::Device::sphere;
        row.feature = "S1";
        row.commanded[Axis::X] = 120.0 * std::cos(c_rad);
        row.commanded[Axis::Y] = -120.0 * std::sin(c_rad);
        row.commanded[Axis::Z] = 230.0;
        row.commanded[Axis::C] = c_rad;
        row.direction_M = k % 2 ? Vector3(0, 1, 0) : Vector3(1, 0, 0);
        row.value_mm = (c_rad > before_rad ? 0.004 : -0.004) + 0.003 * std::sin(7.0 * c_rad);
        before_rad = c_rad;
        table.rows.push_back(row);
    }
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    const diagnosis::Diagnosis d = diagnosis::diagnose(setup, table, options);
    INFO(said(d));
    CHECK(d.verdict != diagnosis::Verdict::no_gap);
    CHECK(d.noise_um < 0.1 * d.rms_um);
}

// The machine drifts while the repeats are taken: to take the drift for noise would conceal it.
TEST_CASE("noise from repeats is estimated again beside the effects that were found",
          "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 3);
    const std::vector<records::Reading> first = table.rows;
    for (records::Reading row : first) {
        row.time_s += first.back().time_s + 60.0;
        table.rows.push_back(row);
    }
    const setup::Setup truth = campaign::with_effect(
        campaign::real_machine(setup), "thermal.drift: d_mm=[0.1, 0, 0.15], tau_s=600");
    const diagnosis::Diagnosis d =
        diagnosis::diagnose(setup, campaign::measured(truth, table, 4, 1.0));
    REQUIRE(d.noise.source == diagnosis::NoiseSource::repeats);
    CHECK(d.noise.sphere.scale == Approx(1.0).epsilon(0.15));
    CHECK(d.noise.sphere.shared < 0.2);
    REQUIRE(d.causes.size() == 1);
    CHECK(d.causes.front().effect == "thermal.drift");
}

TEST_CASE("straightness has the form without its slope, which is squareness", "[diagnosis]") {
    const effects::Catalogue catalogue = effects::make_catalogue(campaign::bc_setup());
    const effects::Effect& effect = *effects::find_effect(catalogue, "X.straightness");
    const auto forms = diagnosis::simpler_forms(effect);
    REQUIRE(forms.size() == 1);
    for (const effects::EffectParameter& p : effect.parameters) {
        INFO(p.name);
        CHECK(forms[0](p) == (p.name != "EYX_p1_mm" && p.name != "EZX_p1_mm"));
    }
    // An effect that is no polynomial of a slide loses no term by that rule.
    CHECK(diagnosis::simpler_forms(*effects::find_effect(catalogue, "X.backlash")).empty());
}

TEST_CASE("of a location each axis is a form, where there are several", "[diagnosis]") {
    setup::Setup setup = campaign::bc_setup();
    const auto forms_of = [&] {
        const effects::Catalogue catalogue = effects::make_catalogue(setup);
        const effects::Effect& effect = *effects::find_effect(catalogue, "location");
        std::vector<std::size_t> taken;
        for (const auto& takes : diagnosis::simpler_forms(effect))
            taken.push_back(static_cast<std::size_t>(
                std::count_if(effect.parameters.begin(), effect.parameters.end(), takes)));
        return taken;
    };
    CHECK(forms_of() == std::vector<std::size_t>{4, 4});  // EX0B, EZ0B, EA0B, EC0B and of C
    std::erase_if(setup.machine.chain.work, [](const auto& a) { return a.axis == Axis::C; });
    CHECK(forms_of().empty());
}

namespace {

/// Circles of the ballbar in one plane, both ways at two feeds. As a log has it that does not tell
/// the feed.
records::ReadingTable circles_of_one_plane(const setup::Setup& setup) {
    records::ReadingTable all = campaign::empty_table(setup), table = all;
    campaign::add_ballbar(all, setup, 120);
    for (records::Reading& row : all.rows)
        if (row.test.starts_with("plane0")) {
            row.feed_mm_min = 0.0;
            table.rows.push_back(row);
        }
    return table;
}

}  // namespace

// The circle shrinks with the square of the feed. Taken for repeats, the two feeds would hide it in
// the noise, and no other path could confirm the spike.
TEST_CASE("passes at two feeds are no repeats, and what one plane shows is written",
          "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    setup::Setup truth =
        campaign::with_effect(campaign::real_machine(setup), "servo.contour: lag2_s2=1e-4");
    truth = campaign::with_effect(
        truth, "X.reversal_spike: height_mm=0.006, decay_mm=1.5, law=1, run_up=1");
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    const diagnosis::Diagnosis d = diagnosis::diagnose(
        setup, campaign::measured(truth, circles_of_one_plane(setup), 8), options);
    INFO(said(d));
    CHECK(d.noise.source == diagnosis::NoiseSource::given);
    CHECK(d.verdict == diagnosis::Verdict::explained);
    for (const char* name : {"servo.contour", "X.reversal_spike"}) {
        INFO(name);
        const auto at = std::find_if(d.causes.begin(), d.causes.end(),
                                     [&](const diagnosis::Cause& c) { return c.effect == name; });
        REQUIRE(at != d.causes.end());
        CHECK(at->probability >= 0.5);
        CHECK(at->written);
    }
}

// An axis that is pushed to and fro while its command rests: no effect does that, and noise
// neither.
TEST_CASE("readings that are off alike one after the other are not called noise", "[diagnosis]") {
    std::vector<std::string> notes;
    const setup::Setup one = setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X t\"\n"
        "[machine.axis.X]\ndirection = [1, 0, 0]\n[model]\nmodelled = []\n",
        "s.toml", notes);
    std::mt19937_64 engine(5);
    std::normal_distribution<double> noise(0.0, 0.02);
    for (const bool pushed : {true, false}) {
        records::ReadingTable read;
        read.path = "log.csv";
        read.axes = {Axis::X};
        for (int k = 0; k < 111; ++k) {
            records::Reading row;
            row.index = k;
            row.time_s = 0.1 * k;
            row.test = "log";
            row.device = records::Device::axis;
            row.feature = "X";
            row.commanded[Axis::X] = 10.0;
            const double side = k / 10 % 2 == 0 ? 1.0 : -1.0;
            row.value_mm = noise(engine) + (pushed ? 0.3 * side : 0.0);
            read.rows.push_back(row);
        }
        const diagnosis::Diagnosis d = diagnosis::diagnose(one, read);
        INFO(said(d));
        const auto alike = std::any_of(d.causes.begin(), d.causes.end(), [](const auto& c) {
            return c.what.find("Successive readings") != std::string::npos;
        });
        CHECK(alike == pushed);
        if (pushed) CHECK(d.verdict == diagnosis::Verdict::unexplained);
        for (const diagnosis::Cause& c : d.causes)
            if (c.known) CHECK(c.probability < 0.5);
    }
}

}  // namespace trunnion
