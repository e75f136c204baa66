// What changed between dates: the machine of Monday and of Friday in one table.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/alarm.h"
#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

records::ReadingTable map_and_passes(const setup::Setup& setup) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 40, 5);
    campaign::add_ballbar(table, setup, 36);
    return table;
}

/// The spheres and the cup are mounted anew for each session.
setup::Setup mounted_anew(setup::Setup truth, std::uint64_t seed) {
    SeededNoise random(seed);
    const auto some = [&] {
        return Vector3(0.02 * random.normal(), 0.02 * random.normal(), 0.02 * random.normal());
    };
    for (setup::Artefact& artefact : truth.artefacts) artefact.center_W_mm += some();
    if (truth.ballbar) truth.ballbar->cup_S_mm += some();
    return truth;
}

/// One machine a session.
records::ReadingTable measured_over(const std::vector<setup::Setup>& machines,
                                    const records::ReadingTable& table, std::uint64_t seed) {
    static const char* const names[] = {"Monday", "Friday", "Sunday"};
    std::vector<records::ReadingTable> all;
    for (std::size_t k = 0; k < machines.size(); ++k) {
        all.push_back(
            campaign::measured(mounted_anew(machines[k], 10 * seed + k), table, 100 * seed + k));
        for (records::Reading& row : all.back().rows) row.session = names[k];
        all.back().optional_columns.push_back("session");
    }
    return records::join_readings(all);
}

diagnosis::Diagnosis diagnosed(const setup::Setup& setup, const records::ReadingTable& table) {
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    options.over_sessions = true;
    return diagnosis::diagnose(setup, table, options);
}

const diagnosis::Cause* claim_of(const diagnosis::Diagnosis& d, const std::string& effect,
                                 const std::string& since) {
    const auto at = std::find_if(d.causes.begin(), d.causes.end(), [&](const diagnosis::Cause& c) {
        return c.effect == effect && c.since == since;
    });
    return at == d.causes.end() ? nullptr : &*at;
}

const diagnosis::SessionChange* change_of(const diagnosis::Diagnosis& d, const std::string& name,
                                          const std::string& since) {
    const auto at =
        std::find_if(d.changes.begin(), d.changes.end(), [&](const diagnosis::SessionChange& c) {
            return identification::full_name(c.parameter) == name && c.since == since;
        });
    return at == d.changes.end() ? nullptr : &*at;
}

/// Rms of the difference between two machines on positions of a table, um.
double apart_um(const setup::Setup& a, const setup::Setup& b, const records::ReadingTable& table) {
    const auto x = emulator::Replay(a, table).predict(effects::active_models(a));
    const auto y = emulator::Replay(b, table).predict(effects::active_models(b));
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) sum += std::pow(x[i] - y[i], 2);
    return 1e3 * std::sqrt(sum / static_cast<double>(x.size()));
}

}  // namespace

TEST_CASE("a backlash that has grown since Monday is what changed", "[diagnosis][over]") {
    const setup::Setup setup = campaign::bc_setup(), real = campaign::real_machine(setup);
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const setup::Setup monday = campaign::with_effect(real, "C.backlash: gap_rad=4e-5");
        const setup::Setup friday = campaign::with_effect(real, "C.backlash: gap_rad=1e-4");
        const diagnosis::Diagnosis d =
            diagnosed(setup, measured_over({monday, friday}, map_and_passes(setup), seed));
        INFO(said(d));
        CHECK(d.verdict == diagnosis::Verdict::explained);
        CHECK(d.causes.size() == 2);
        const diagnosis::Cause* always = claim_of(d, "C.backlash", "");
        const diagnosis::Cause* grown = claim_of(d, "C.backlash", "Friday");
        REQUIRE(always);
        REQUIRE(grown);
        CHECK(grown->probability > 0.9);
        const auto& by = grown->parameters.front();
        CHECK(std::abs(by.value - 6e-5) < 4.0 * by.sigma);
        CHECK(by.sigma < 3e-6);
        const diagnosis::SessionChange* change = change_of(d, "C.backlash.gap_rad", "Friday");
        REQUIRE(change);
        CHECK(change->claimed);
        CHECK(change->before == Approx(4e-5).margin(4.0 * by.sigma));
        for (const diagnosis::SessionChange& c : d.changes)
            if (!c.claimed && std::isfinite(c.parameter.sigma))
                CHECK(std::abs(c.parameter.value) < 4.5 * c.parameter.sigma);
    }
}

TEST_CASE("a change of a modelled effect starts from what it was the session before",
          "[diagnosis][over]") {
    setup::Setup setup = campaign::bc_setup();
    setup.model.modelled = {"location", "C.backlash", "X.backlash"};
    const setup::Setup real =
        campaign::with_effect(campaign::real_machine(setup), "X.backlash: gap_mm=0.004");
    std::vector<setup::Setup> machines;
    for (const char* gap : {"4e-5", "1e-4", "1.6e-4"})
        machines.push_back(campaign::with_effect(real, std::string("C.backlash: gap_rad=") + gap));
    records::ReadingTable read = measured_over(machines, map_and_passes(setup), 6);
    const auto wild = std::find_if(read.rows.begin(), read.rows.end(), [](const auto& row) {
        return row.session == "Friday" && row.device == records::Device::sphere;
    });
    *wild->value_mm += 0.1;
    const diagnosis::Diagnosis d = diagnosed(setup, read);
    INFO(said(d));
    for (const auto& [since, before] : {std::pair("Friday", 4e-5), {"Sunday", 1e-4}}) {
        const diagnosis::SessionChange* change = change_of(d, "C.backlash.gap_rad", since);
        REQUIRE(change);
        CHECK(change->claimed);
        CHECK(change->parameter.value == Approx(6e-5).margin(1e-5));
        CHECK(change->before == Approx(before).margin(1e-5));
        const diagnosis::SessionChange* other = change_of(d, "X.backlash.gap_mm", since);
        REQUIRE(other);
        CHECK_FALSE(other->claimed);
        CHECK(other->parameter.value == Approx(0.0).margin(5e-4));
        CHECK(other->before == Approx(0.004).margin(5e-4));
    }
    REQUIRE(d.sessions.size() == 3);
    CHECK(d.sessions[0].readings == d.sessions[2].readings);
    CHECK(d.sessions[1].readings + 1 == d.sessions[0].readings);  // without the wild one
}

TEST_CASE("a crash that moved the axis C is told as its new location", "[diagnosis][over]") {
    const setup::Setup setup = campaign::bc_setup(), monday = campaign::real_machine(setup);
    setup::Setup friday = monday;
    friday.machine.errors.location(*kinematics::parse_error_name("EX0C")) += 0.015;
    friday.machine.errors.location(*kinematics::parse_error_name("EA0C")) += 6e-5;
    const diagnosis::Diagnosis d =
        diagnosed(setup, measured_over({monday, friday}, map_and_passes(setup), 4));
    INFO(said(d));
    CHECK(d.verdict == diagnosis::Verdict::explained);
    REQUIRE(d.causes.size() == 1);
    CHECK(claim_of(d, "location", "Friday"));
    const diagnosis::SessionChange* shift = change_of(d, "location.EX0C_mm", "Friday");
    REQUIRE(shift);
    CHECK(std::abs(shift->parameter.value - 0.015) < 4.0 * shift->parameter.sigma);
    CHECK(shift->parameter.sigma < 1e-3);
    CHECK(shift->before == Approx(0.006).margin(2e-3));
    // Without the question the same readings have a gap that begins with the session.
    diagnosis::DiagnosisOptions plain;
    plain.plan_next = false;
    const diagnosis::Diagnosis asked_nothing = diagnosis::diagnose(
        setup, measured_over({monday, friday}, map_and_passes(setup), 4), plain);
    CHECK(asked_nothing.verdict != diagnosis::Verdict::no_gap);
    CHECK(asked_nothing.changes.empty());
}

TEST_CASE("a machine that stays the same has not changed, however it was set up",
          "[diagnosis][over]") {
    const setup::Setup setup = campaign::bc_setup(), real = campaign::real_machine(setup);
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 40, 6);
    int false_alarms = 0;
    double square = 0.0, count = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const diagnosis::Diagnosis d = diagnosed(setup, measured_over({real, real}, table, seed));
        INFO(seed << ": " << said(d));
        for (const diagnosis::SessionChange& c : d.changes) {
            false_alarms += c.claimed ? 1 : 0;
            if (!std::isfinite(c.parameter.sigma)) continue;
            square += std::pow(c.parameter.value / c.parameter.sigma, 2);
            count += 1.0;
        }
        CHECK(d.sessions.size() == 2);
    }
    CHECK(false_alarms <= 1);
    REQUIRE(count > 100.0);  // the stated sigma is the scatter: chi-squared over its freedom
    CHECK(square / count == Approx(1.0).margin(0.3));
}

TEST_CASE("of three sessions the change begins where it does, and the last machine is written",
          "[diagnosis][over]") {
    const setup::Setup setup = campaign::bc_setup(), real = campaign::real_machine(setup);
    const setup::Setup worn = campaign::with_effect(real, "X.backlash: gap_mm=0.006");
    for (const bool early : {true, false}) {
        const setup::Setup friday = early ? worn : real;
        const diagnosis::Diagnosis d =
            diagnosed(setup, measured_over({real, friday, worn}, map_and_passes(setup), 5));
        INFO(said(d));
        REQUIRE(!d.causes.empty());
        CHECK(d.causes.front().effect == "X.backlash");
        CHECK(d.causes.front().since == (early ? "Friday" : "Sunday"));
        // The set-up of a session does not matter between two passes of its own.
        records::ReadingTable fresh = campaign::empty_table(setup);
        campaign::add_ballbar(fresh, setup, 50);
        setup::Setup as_worn = worn, as_real = real;
        as_worn.artefacts = as_real.artefacts = d.setup.artefacts;
        as_worn.ballbar = as_real.ballbar = d.setup.ballbar;
        CHECK(apart_um(d.setup, as_worn, fresh) < 0.3 * apart_um(d.setup, as_real, fresh));
    }
}

TEST_CASE("set-up columns of two sessions never repeat each other", "[diagnosis][over]") {
    const setup::Setup setup = campaign::bc_setup(), real = campaign::real_machine(setup);
    const records::ReadingTable table = measured_over({real, real}, map_and_passes(setup), 1);
    const emulator::Replay replay(setup, table);
    const auto base = identification::fit_base(
        setup, table, replay, effects::make_catalogue(setup, effects::extent_of(setup, table)),
        setup.model.modelled);
    std::vector<std::string> names;
    for (const auto& p : base.parameters) names.push_back(identification::full_name(p));
    std::sort(names.begin(), names.end());
    CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
    for (Eigen::Index a = 0; a < base.columns.cols(); ++a)
        for (Eigen::Index b = 0; b < a; ++b) {
            const double both = base.columns.col(a).norm() * base.columns.col(b).norm();
            INFO(names[static_cast<std::size_t>(a)] << " " << names[static_cast<std::size_t>(b)]);
            CHECK(std::abs(base.columns.col(a).dot(base.columns.col(b))) < (1.0 - 1e-9) * both);
        }
}

namespace {

/// Runs of a laser along X, both ways at 11 targets; a run ends where the next one begins.
records::ReadingTable laser_runs(const setup::Setup& setup, int runs) {
    records::ReadingTable table = campaign::empty_table(setup);
    for (int k = 0; k < 22 * runs; ++k) {
        const int target = k % 22 < 11 ? k % 22 : 21 - k % 22;
        records::Reading row;
        row.index = k;
        row.time_s = 12.0 * k;
        row.test = "X";
        row.device = records::Device::linear;
        row.feature = "R1";
        row.direction_M = Vector3::UnitX();
        row.commanded[Axis::X] = 70.0 * target - 350.0;
        table.rows.push_back(row);
    }
    return table;
}

setup::Setup laser_bench() {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"m\"\nchain = \"w b X Y Z t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
        "[model]\nmodelled = []\nnoise_um = { linear = 0.8 }\n",
        "s.toml", notes);
}

}  // namespace

TEST_CASE("a scale that became smaller is a change, and no noise of repeated runs",
          "[diagnosis][over]") {
    const setup::Setup setup = laser_bench();
    const records::ReadingTable table = laser_runs(setup, 4);
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const setup::Setup cold = campaign::with_effect(setup, "X.scale: scale_ppm=40"),
                           warm = campaign::with_effect(setup, "X.scale: scale_ppm=25");
        const records::ReadingTable read = measured_over({cold, warm}, table, seed);
        const diagnosis::Diagnosis d = diagnosed(setup, read);
        INFO(said(d));
        CHECK(d.noise_um < 1.5 * d.after_rms_um);
        const auto changed = std::find_if(d.causes.begin(), d.causes.end(),
                                          [](const auto& c) { return c.since == "Friday"; });
        REQUIRE(changed != d.causes.end());
        CHECK(changed->share > 0.05);
        const diagnosis::SessionChange* scale = change_of(d, "X.scale.scale_ppm", "Friday");
        if (scale)
            CHECK(scale->parameter.value == Approx(-15.0).margin(4.0 * scale->parameter.sigma));
    }
}

TEST_CASE("a change that another effect explains as well is not certain", "[diagnosis][over]") {
    const setup::Setup setup = laser_bench();
    const setup::Setup worn = campaign::with_effect(setup, "X.scale: scale_ppm=30");
    const diagnosis::Diagnosis d =
        diagnosed(setup, measured_over({setup, worn}, laser_runs(setup, 3), 1));
    INFO(said(d));
    REQUIRE_FALSE(d.causes.empty());
    const diagnosis::Cause& first = d.causes.front();
    CHECK(first.since == "Friday");
    CHECK_FALSE(first.rivals.empty());
    CHECK(first.probability < 0.7);
    const auto change = std::find_if(d.changes.begin(), d.changes.end(), [&](const auto& c) {
        return c.parameter.effect == first.effect && c.probability > 0.0;
    });
    REQUIRE(change != d.changes.end());
    CHECK(change->probability.value() == first.probability.value());
    CHECK(change->claimed == (first.probability.value() >= 0.5));
}

TEST_CASE("one session has nothing to compare", "[diagnosis][over]") {
    const setup::Setup setup = campaign::bc_setup();
    const records::ReadingTable table =
        measured_over({campaign::real_machine(setup)}, map_and_passes(setup), 1);
    CHECK_THROWS_AS(diagnosed(setup, table), InputError);
}

}  // namespace trunnion
