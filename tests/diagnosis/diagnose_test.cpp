#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/alarm.h"
#include "base/random.h"
#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

struct Bench {
    setup::Setup setup = campaign::bc_setup();
    setup::Setup real = campaign::real_machine(setup);
    records::ReadingTable table = campaign::empty_table(setup);
    Bench() {
        campaign::add_sphere_map(table, setup, 50, 5);
        campaign::add_ballbar(table, setup, 36);
    }
    diagnosis::Diagnosis of(const setup::Setup& truth, std::uint64_t seed,
                            double noise = 1.0) const {
        return diagnosis::diagnose(setup, campaign::measured(truth, table, seed, noise));
    }
};

}  // namespace

TEST_CASE("nothing is claimed on noise alone", "[diagnosis]") {
    const Bench bench;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        REQUIRE(bench.of(bench.real, seed).verdict == diagnosis::Verdict::no_gap);
        REQUIRE(bench.of(bench.real, seed, 1.3).verdict == diagnosis::Verdict::no_gap);
        REQUIRE(bench.of(bench.real, seed, 0.7).verdict == diagnosis::Verdict::no_gap);
    }
    REQUIRE(bench.of(bench.real, 1, 1.3).noise.source == diagnosis::NoiseSource::assumed);
    REQUIRE(bench.of(bench.real, 1, 1.0).noise.source == diagnosis::NoiseSource::given);
    records::ReadingTable small = campaign::empty_table(bench.setup);
    campaign::add_sphere_map(small, bench.setup, 30, 2);
    int loud = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed)
        if (diagnosis::diagnose(bench.setup, campaign::measured(bench.real, small, seed)).verdict !=
            diagnosis::Verdict::no_gap)
            ++loud;
    REQUIRE(loud <= 2);
}

TEST_CASE("a single effect is named first, with its size and how far the gap shrinks",
          "[diagnosis]") {
    const Bench bench;
    struct Case {
        const char *injection, *effect, *parameter;
        double value;
    };
    const Case cases[] = {
        {"C.backlash: gap_rad=8e-5", "C.backlash", "gap_rad", 8e-5},
        {"X.backlash: gap_mm=0.004", "X.backlash", "gap_mm", 0.004},
        {"XY.squareness: angle_rad=4e-5", "XY.squareness", "angle_rad", 4e-5},
        {"servo.mismatch: tau_x_s=4e-4", "servo.mismatch", "", 0},
        {"servo.contour: lag2_s2=1e-4", "servo.contour", "lag2_x_s2", 1e-4},
        {"thermal.drift: d_mm=[0.01, 0, 0.02], tau_s=900", "thermal.drift", "", 0},
        {"pivot.g54: dg_mm=[0.005, 0.004, -0.005]", "pivot.g54", "", 0},
        {"B.positioning: cos2_rad=2e-5, sin1_rad=2e-5", "B.positioning", "", 0},
        {"C.cyclic: cos_rad=3e-5, periods_per_turn=45", "C.cyclic", "periods_per_turn", 45},
        {"Y.reversal_spike: height_mm=0.006, decay_mm=4", "Y.reversal_spike", "", 0},
        {"artefact.moved: shift_mm=[0.01, 0, 0.01], artefact=1, time_s=700", "artefact.moved",
         "artefact", 1}};
    for (const Case& c : cases) {
        const diagnosis::Diagnosis result =
            bench.of(campaign::with_effect(bench.real, c.injection), 7);
        INFO(c.injection);
        REQUIRE(!result.causes.empty());
        const diagnosis::Cause& first = result.causes.front();
        std::string all;
        for (const diagnosis::Cause& cause : result.causes)
            all += cause.effect + " " + std::to_string(cause.share) + "  ";
        INFO(all);
        REQUIRE(first.effect == c.effect);
        REQUIRE(first.share > 0.95);
        REQUIRE((result.verdict == diagnosis::Verdict::explained ||
                 result.verdict == diagnosis::Verdict::ambiguous));
        REQUIRE(first.heldout.shrink > 0.75);
        REQUIRE(first.heldout.low <= first.heldout.shrink);
        REQUIRE(first.heldout.high >= first.heldout.shrink);
        for (const identification::FitParameter& p : first.parameters)
            if (p.name == c.parameter) REQUIRE(p.value == Approx(c.value).epsilon(0.1));
    }
}

TEST_CASE("two effects at once are both named", "[diagnosis]") {
    const Bench bench;
    const setup::Setup truth =
        campaign::with_effect(campaign::with_effect(bench.real, "C.backlash: gap_rad=8e-5"),
                              "servo.contour: lag2_s2=1e-4");
    const diagnosis::Diagnosis result = bench.of(truth, 3);
    REQUIRE(result.causes.size() == 2);
    double share = 0.0;
    for (const diagnosis::Cause& cause : result.causes) share += cause.share;
    REQUIRE(share == Approx(1.0).margin(0.08));
}

TEST_CASE("a gap outside the catalogue is said to be unknown", "[diagnosis]") {
    const Bench bench;
    records::ReadingTable readings = campaign::measured(bench.real, bench.table, 3);
    for (records::Reading& row :
         readings.rows)  // a ripple of the readings with time that nothing makes
        if (row.value_mm) *row.value_mm += 0.002 * std::sin(row.time_s / 60.0);
    const diagnosis::Diagnosis result = diagnosis::diagnose(bench.setup, readings);
    REQUIRE(result.verdict == diagnosis::Verdict::unexplained);
    const auto unknown =
        std::find_if(result.causes.begin(), result.causes.end(),
                     [](const diagnosis::Cause& c) { return c.effect == "unknown"; });
    REQUIRE(unknown != result.causes.end());
    REQUIRE(unknown->share > 0.5);
    REQUIRE(std::any_of(result.where.begin(), result.where.end(),
                        [](const diagnosis::DriverShare& d) { return d.by == "time"; }));
}

TEST_CASE("what a cause leaves open and chance may have made is said as unlikely", "[diagnosis]") {
    const Bench bench;
    records::ReadingTable readings = campaign::measured(
        campaign::with_effect(bench.real, "C.backlash: gap_rad=8e-6"), bench.table, 1);
    for (records::Reading& row : readings.rows)
        if (row.value_mm) *row.value_mm += 0.0004 * std::sin(row.time_s / 60.0);
    const diagnosis::Diagnosis result = diagnosis::diagnose(bench.setup, readings);
    REQUIRE(result.verdict == diagnosis::Verdict::partly_explained);
    REQUIRE(result.causes.size() == 2);
    CHECK(result.causes[0].effect == "C.backlash");
    CHECK(result.causes[1].effect == "unknown");
    CHECK(result.causes[1].probability > 0.0);
    CHECK(result.causes[1].probability < 0.1);
    CHECK(result.causes[1].what.find("What left-out readings do not confirm") == 0);
}

TEST_CASE("a few wild readings change neither the noise nor the claim", "[diagnosis]") {
    const Bench bench;
    const auto with_outliers = [&](const setup::Setup& truth, bool repeat) {
        records::ReadingTable table = bench.table;
        if (repeat)
            for (records::Reading row : bench.table.rows) {
                row.time_s += bench.table.rows.back().time_s + 60.0;
                row.test += "_again";
                table.rows.push_back(row);
            }
        table = campaign::measured(truth, table, 11);
        for (std::size_t k = 17; k < table.rows.size(); k += 50)  // 2 %, 8 um
            if (table.rows[k].value_mm) *table.rows[k].value_mm += k % 100 == 17 ? 8e-3 : -8e-3;
        return diagnosis::diagnose(bench.setup, table);
    };
    const setup::Setup truth = campaign::with_effect(bench.real, "C.backlash: gap_rad=8e-5");
    for (const bool repeat : {false, true}) {
        INFO("repeats: " << repeat);
        const diagnosis::Diagnosis null = with_outliers(bench.real, repeat);
        REQUIRE(null.verdict == diagnosis::Verdict::no_gap);
        REQUIRE(null.outliers > 10);
        REQUIRE(null.noise.source ==
                (repeat ? diagnosis::NoiseSource::repeats : diagnosis::NoiseSource::given));
        REQUIRE(null.noise.ballbar.scale == Approx(1.0).margin(0.1));
        REQUIRE(null.noise.sphere.scale == Approx(1.0).margin(0.15));
        const diagnosis::Diagnosis gap = with_outliers(truth, repeat);
        REQUIRE(gap.causes.size() == 1);
        REQUIRE(gap.causes.front().effect == "C.backlash");
        REQUIRE(gap.causes.front().parameters.front().value == Approx(8e-5).epsilon(0.1));
    }
}

TEST_CASE("touches that share a centre error and neighbours along a pass make no gap",
          "[diagnosis]") {
    const Bench bench;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        records::ReadingTable table = bench.table;
        for (records::Reading row :
             bench.table.rows) {  // all passes twice: the repeats show the memory
            row.time_s += bench.table.rows.back().time_s + 60.0;
            row.test += "_again";
            table.rows.push_back(row);
        }
        table = campaign::measured(bench.real, table, seed, 0.6);
        SeededNoise random(100 + seed);
        double shared = 0.0;
        std::string test;
        for (records::Reading& row : table.rows) {
            if (row.device != records::Device::ballbar) continue;
            if (row.test != test) shared = random.normal();
            test = row.test;
            shared = 0.9 * shared + std::sqrt(1.0 - 0.81) * random.normal();
            *row.value_mm += 0.3e-3 * 0.8 * shared;
        }
        const diagnosis::Diagnosis result = diagnosis::diagnose(bench.setup, table);
        INFO("seed " << seed);
        REQUIRE(result.verdict == diagnosis::Verdict::no_gap);
        REQUIRE(result.noise.source == diagnosis::NoiseSource::repeats);
        REQUIRE(result.noise.ballbar.shared > 0.4);
        REQUIRE(result.noise.ballbar.memory > 0.75);
    }
}

TEST_CASE("noise that the setup states wrongly is said to be assumed, whatever else is found",
          "[diagnosis]") {
    const Bench bench;
    const setup::Setup gap = campaign::with_effect(bench.real, "C.backlash: gap_rad=8e-5");
    for (const double factor : {0.75, 1.33}) {
        INFO("noise times " << factor);
        REQUIRE(bench.of(bench.real, 4, factor).noise.source == diagnosis::NoiseSource::assumed);
        REQUIRE(bench.of(gap, 4, factor).noise.source == diagnosis::NoiseSource::assumed);
        records::ReadingTable odd = campaign::measured(bench.real, bench.table, 4, factor);
        for (records::Reading& row : odd.rows)
            if (row.value_mm) *row.value_mm += 0.002 * std::sin(row.time_s / 60.0);
        REQUIRE(diagnosis::diagnose(bench.setup, odd).noise.source ==
                diagnosis::NoiseSource::assumed);
        records::ReadingTable wild = campaign::measured(bench.real, bench.table, 4, factor);
        for (std::size_t k = 9; k < wild.rows.size(); k += 50)
            if (wild.rows[k].value_mm) *wild.rows[k].value_mm += 8e-3;
        REQUIRE(diagnosis::diagnose(bench.setup, wild).noise.source ==
                diagnosis::NoiseSource::assumed);
    }
    REQUIRE(bench.of(gap, 4).noise.source == diagnosis::NoiseSource::given);
}

TEST_CASE("the closed loop: the setup written predicts new positions", "[diagnosis]") {
    const Bench bench;
    const setup::Setup truth = campaign::with_effect(bench.real, "C.backlash: gap_rad=8e-5");
    const diagnosis::Diagnosis result = bench.of(truth, 5);
    records::ReadingTable fresh = campaign::empty_table(bench.setup);
    campaign::add_sphere_map(fresh, bench.setup, 30, 99);
    const records::ReadingTable real =
        emulator::predicted(truth, fresh, effects::active_models(truth));
    const records::ReadingTable simulated =
        emulator::predicted(result.setup, fresh, effects::active_models(result.setup));
    double sum = 0.0, rows = 0.0;
    for (std::size_t i = 0; i < fresh.rows.size(); ++i) {
        if (!real.rows[i].value_mm) continue;
        sum += std::pow(*real.rows[i].value_mm - *simulated.rows[i].value_mm, 2);
        rows += 1.0;
    }
    REQUIRE(1e3 * std::sqrt(sum / rows) < 0.6);
}

TEST_CASE("the same readings give the same diagnosis", "[diagnosis]") {
    const Bench bench;
    const setup::Setup truth = campaign::with_effect(bench.real, "C.backlash: gap_rad=8e-5");
    const diagnosis::Diagnosis a = bench.of(truth, 5), b = bench.of(truth, 5);
    REQUIRE(a.causes.front().heldout.low == b.causes.front().heldout.low);
    REQUIRE(a.causes.front().parameters.front().value == b.causes.front().parameters.front().value);
}

TEST_CASE("nothing free is a model too", "[diagnosis]") {
    setup::Setup setup = campaign::bc_setup();
    setup.model.modelled.clear();
    for (setup::Artefact& artefact : setup.artefacts) artefact.free_center = false;
    setup.ballbar->free_cup = setup.ballbar->free_length = false;
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 30, 5);
    CHECK(diagnosis::diagnose(setup, campaign::measured(setup, table, 4)).verdict ==
          diagnosis::Verdict::no_gap);
    const setup::Setup bent = campaign::with_effect(setup, "C.backlash=80urad");
    const diagnosis::Diagnosis d = diagnosis::diagnose(setup, campaign::measured(bent, table, 4));
    REQUIRE_FALSE(d.causes.empty());
    CHECK(d.causes.front().effect == "C.backlash");
}

TEST_CASE("too few readings give a message and no verdict", "[diagnosis]") {
    const Bench bench;
    records::ReadingTable few = campaign::measured(bench.real, bench.table, 1);
    few.rows.resize(4);
    REQUIRE_THROWS_AS(diagnosis::diagnose(bench.setup, few), InputError);
}

}  // namespace trunnion
