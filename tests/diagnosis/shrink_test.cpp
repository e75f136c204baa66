// How far the gap shrinks: calibrated values, outliers in small tables, and what the interval must
// cover on readings taken elsewhere.
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// Shrink that noise-free readings of `truth` at other positions show, against the base alone.
double shrink_elsewhere(const diagnosis::Diagnosis& d, const setup::Setup& base,
                        const setup::Setup& truth, const records::ReadingTable& fresh) {
    const auto values = [&](const setup::Setup& setup) {
        return emulator::Replay(setup, fresh).predict(effects::active_models(setup));
    };
    const std::vector<double> real = values(truth), with = values(d.setup), without = values(base);
    double before = 0.0, after = 0.0;
    for (std::size_t i = 0; i < real.size(); ++i) {
        before += std::pow(real[i] - without[i], 2);
        after += std::pow(real[i] - with[i], 2);
    }
    return 1.0 - std::sqrt(after / before);
}

setup::Setup base_of(const setup::Setup& setup, const records::ReadingTable& readings) {
    const emulator::Replay replay(setup, readings);
    const effects::Catalogue catalogue =
        effects::make_catalogue(setup, effects::extent_of(setup, readings));
    return identification::fit_base(setup, readings, replay, catalogue, setup.model.modelled).setup;
}

struct Interval {
    int inside = 0, sets = 0;
    void look(const std::string& effect, int poses, int samples) {
        const setup::Setup setup = campaign::bc_setup();
        for (std::uint64_t seed = 1; seed <= 4; ++seed) {
            const setup::Setup truth = campaign::with_effect(campaign::real_machine(setup), effect);
            records::ReadingTable table = campaign::empty_table(setup),
                                  fresh = campaign::empty_table(setup);
            if (poses > 0) campaign::add_sphere_map(table, setup, poses, seed);
            if (samples > 0) campaign::add_ballbar(table, setup, samples);
            if (poses > 0) campaign::add_sphere_map(fresh, setup, 40, seed + 100);
            if (samples > 0) campaign::add_ballbar(fresh, setup, samples + 17);
            const records::ReadingTable readings = campaign::measured(truth, table, seed);
            const diagnosis::Diagnosis d = diagnosis::diagnose(setup, readings);
            const double shrink = shrink_elsewhere(d, base_of(setup, readings), truth, fresh);
            INFO(effect << ", seed " << seed << ": " << shrink << " in " << d.after.low << ".."
                        << d.after.high);
            ++sets;
            if (d.after.low <= shrink && shrink <= d.after.high) ++inside;
            CHECK(d.after.low > shrink - 0.5);  // nor is it so wide that it says nothing
        }
    }
};

}  // namespace

TEST_CASE("the interval covers the shrink at positions that were not measured", "[diagnosis]") {
    Interval interval;
    interval.look("C.backlash: gap_rad=8e-5", 40, 0);
    interval.look("B.cyclic: cos_rad=3e-5, periods_per_turn=45", 60, 0);
    interval.look("thermal.drift: d_mm=[0.02, -0.01, 0.015], tau_s=900", 40, 36);
    interval.look("X.reversal_spike: height_mm=0.012, decay_mm=6, law=0", 0, 60);
    interval.look("servo.mismatch: tau_x_s=1e-4, tau_y_s=-1e-4", 0, 48);
    interval.look("gravity.sag: twist_rad=6e-5", 50, 0);
    CHECK(interval.sets == 24);
    CHECK(interval.inside >= 21);  // 95 %: less than one time in a hundred
}

TEST_CASE("a calibrated location that no longer fits is a gap, not the location", "[diagnosis]") {
    setup::Setup setup = campaign::bc_setup();
    for (const char* name : {"EX0B", "EZ0B", "EA0B", "EC0B", "EX0C", "EY0C", "EA0C", "EB0C"}) {
        const bool linear = std::string(name)[1] == 'X' || std::string(name)[1] == 'Y' ||
                            std::string(name)[1] == 'Z';
        setup.model.calibration[name] = {0.0, linear ? 5e-4 : 5e-6};
    }
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 5);
    SECTION("XY.squareness bends the location of both axes away from its calibration") {
        const diagnosis::Diagnosis d = diagnosis::diagnose(
            setup, campaign::measured(campaign::with_effect(setup, "XY.squareness: angle_rad=6e-5"),
                                      table, 3));
        REQUIRE(!d.causes.empty());
        CHECK(d.causes.front().effect == "XY.squareness");
    }
    SECTION("nothing is wrong") {
        for (std::uint64_t seed = 1; seed <= 5; ++seed)
            CHECK(diagnosis::diagnose(setup, campaign::measured(setup, table, seed)).verdict ==
                  diagnosis::Verdict::no_gap);
    }
}

TEST_CASE("a few wild readings in a small table are left out, not explained", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup(), real = campaign::real_machine(setup);
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 35, 9);
    int loud = 0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        records::ReadingTable readings = campaign::measured(real, table, seed);
        std::size_t wild = 0;
        for (std::size_t k = 11 + seed; k < readings.rows.size(); k += 53)
            if (readings.rows[k].value_mm) {
                *readings.rows[k].value_mm += wild++ % 2 ? 9e-3 : -7e-3;
            }
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, readings);
        CHECK(d.outliers >= wild);
        loud += d.verdict == diagnosis::Verdict::no_gap ? 0 : 1;
    }
    CHECK(loud <= 1);
}

TEST_CASE("held-out readings: the interval knows that their noise is a sample", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth =
        campaign::with_effect(campaign::real_machine(setup), "C.backlash: gap_rad=5e-5");
    records::ReadingTable table = campaign::empty_table(setup),
                          fresh = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 40, 5);
    campaign::add_sphere_map(fresh, setup, 20, 6);
    int inside = 0;
    constexpr int sets = 20;
    for (std::uint64_t seed = 1; seed <= sets; ++seed) {
        const records::ReadingTable readings = campaign::measured(truth, table, seed);
        const records::ReadingTable held = campaign::measured(truth, fresh, seed + 50);
        diagnosis::DiagnosisOptions options;
        options.holdout = &held;
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, readings, options);
        const double shrink = shrink_elsewhere(d, base_of(setup, readings), truth, fresh);
        CHECK(d.after.low < 1.0);
        inside += d.after.low <= shrink && shrink <= d.after.high ? 1 : 0;
    }
    CHECK(inside >= 17);
}

TEST_CASE("held-out readings without the gap refute its cause", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup(), real = campaign::real_machine(setup);
    const setup::Setup truth = campaign::with_effect(real, "C.backlash: gap_rad=4e-5");
    records::ReadingTable table = campaign::empty_table(setup),
                          fresh = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 5);
    campaign::add_sphere_map(fresh, setup, 20, 6);
    for (const std::uint64_t seed : {1u, 2u, 3u})
        for (const bool repaired : {true, false}) {
            const records::ReadingTable held =
                campaign::measured(repaired ? real : truth, fresh, seed + 50);
            diagnosis::DiagnosisOptions options;
            options.plan_next = false;
            options.holdout = &held;
            const diagnosis::Diagnosis d =
                diagnosis::diagnose(setup, campaign::measured(truth, table, seed), options);
            INFO(seed << ", repaired " << repaired << ": H " << d.explained);
            CHECK((d.verdict == diagnosis::Verdict::unexplained) == repaired);
            if (repaired) CHECK(d.after.shrink < 0.1);
            // The lost motion moves the spheres by a few um; the noise of a touch is 0.8 um.
            CHECK(d.after.rms_before_um > 0.5);
            CHECK(d.after.rms_before_um < 20.0);
            if (!repaired) CHECK(d.after.rms_before_um > 1.1 * d.after.rms_after_um);
        }
}

TEST_CASE("held-out readings that cannot show a cause say nothing of it", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup truth = campaign::with_effect(campaign::real_machine(setup),
                                                     "clamp.shift: shift_b_mm=[0.006, 0, 0.006]");
    records::ReadingTable table = campaign::empty_table(setup),
                          fresh = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, 5);
    campaign::add_sphere_map(fresh, setup, 5, 6);
    for (records::Reading& row : table.rows) row.clamped = std::fmod(row.time_s, 200.0) < 25.0;
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const records::ReadingTable held = campaign::measured(truth, fresh, seed + 50);
        diagnosis::DiagnosisOptions options;
        options.plan_next = false;
        options.holdout = &held;
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(setup, campaign::measured(truth, table, seed), options);
        INFO(seed << ": H " << d.explained);
        CHECK(d.explained > 0.5);
        REQUIRE_FALSE(d.causes.empty());
        CHECK(d.causes.front().effect == "clamp.shift");
    }
}

TEST_CASE("a slip between two readings is said to lie in the middle between them", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 50, 5);
    const double start_s = table.rows[100].time_s;
    double before_s = 0.0, after_s = 1e9;
    for (const records::Reading& row : table.rows) {
        if (row.device == records::Device::none || row.feature != "S1") continue;
        if (row.time_s < start_s) before_s = std::max(before_s, row.time_s);
        if (row.time_s >= start_s) after_s = std::min(after_s, row.time_s);
    }
    const std::string slip = "artefact.moved: shift_mm=[0.02, 0.01, -0.015], artefact=0, time_s=" +
                             std::to_string(start_s - 1.0);
    const diagnosis::Diagnosis d = diagnosis::diagnose(
        setup,
        campaign::measured(campaign::with_effect(campaign::real_machine(setup), slip), table, 4));
    REQUIRE(!d.causes.empty());
    REQUIRE(d.causes.front().effect == "artefact.moved");
    for (const identification::FitParameter& p : d.causes.front().parameters)
        if (p.name == "time_s") CHECK(p.value == Approx(0.5 * (before_s + after_s)).margin(1.0));
}

}  // namespace trunnion
