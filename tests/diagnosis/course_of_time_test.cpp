// A course of time that is no drift of the catalogue: poses follow each other in time, and what
// they have of it must not become errors of the axes. Nor the other way round.
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "base/random.h"
#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"
#include "tests/support/laser_lines.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// A fast warming that a slow cooling takes back and overshoots, of the tool, mm.
Vector3 course_mm(double time_s, double height_mm) {
    const double fast = 1.0 - std::exp(-time_s / 200.0);
    const double slow = 1.0 - std::exp(-std::pow(time_s / 800.0, 2.0));
    return height_mm * (fast - 1.25 * slow) * Vector3(0.3, 1.0, 0.7);
}

records::ReadingTable warmed(const setup::Setup& setup, double height_mm, std::uint64_t seed) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 80, seed);
    table = campaign::measured(campaign::real_machine(setup), table, seed);
    for (records::Reading& row : table.rows)
        if (row.device == records::Device::sphere)
            *row.value_mm += course_mm(row.time_s, height_mm).dot(row.direction_M);
    return table;
}

}  // namespace

TEST_CASE("a course of time is no error of the axes", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    for (const double height_mm : {0.02, 0.06, 0.2})
        for (const std::uint64_t seed : {1, 2, 3, 4}) {
            const diagnosis::Diagnosis d =
                diagnosis::diagnose(setup, warmed(setup, height_mm, seed));
            INFO(height_mm << " mm, seed " << seed << ": " << said(d));
            CHECK(d.verdict != diagnosis::Verdict::no_gap);
            for (const diagnosis::Cause& cause : d.causes)
                if (cause.effect != "unknown" && cause.effect != "thermal.drift")
                    CHECK(cause.probability.value() < 0.5);
        }
}

namespace {

/// Spheres at A in slow steps to and fro, C through a turn at each, read in X, Y and Z, 20 s each.
records::ReadingTable slow_poses(const setup::Setup& setup) {
    std::vector<std::pair<double, double>> poses;
    for (int c = 0; c <= 360; c += 30) poses.emplace_back(0, c);
    for (const int a : {-30, -60, -90, -60, -30, 30, 60, 30, 0})
        for (const int c : {0, 60, 120, 180, 240, 300, 240, 120, 0}) poses.emplace_back(a, c);
    records::ReadingTable table = campaign::empty_table(setup);
    for (std::size_t k = 0; k < poses.size(); ++k)
        for (int d = 0; d < 3; ++d) {
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 20.0 * static_cast<double>(k);
            row.test = "map";
            row.device = records::Device::sphere;
            row.feature = "S1";
            row.direction_M = Vector3::Unit(d);
            row.commanded[Axis::A] = rad_from_deg(poses[k].first);
            row.commanded[Axis::C] = rad_from_deg(poses[k].second);
            campaign::aim(row, setup, setup.artefacts[0].center_W_mm, setup.probe->tip_S_mm);
            table.rows.push_back(row);
        }
    return table;
}

}  // namespace

// A follows the time: steps of a random walk look like the bearing of A.
TEST_CASE("a random walk of the spindle is no error of the axes", "[diagnosis][walk]") {
    const setup::Setup setup = campaign::ac_setup();
    for (const unsigned seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
        records::ReadingTable table = slow_poses(setup);
        SeededNoise random(seed);
        double walk_mm = 0.0;
        for (std::size_t k = 0; k < table.rows.size(); ++k) {
            if (k % 3 == 0) walk_mm += 0.6e-3 * random.normal();
            records::Reading& row = table.rows[k];
            row.value_mm = -walk_mm * row.direction_M.z() + 0.5e-3 * random.normal();
        }
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, table);
        INFO(seed << ": " << said(d));
        for (const diagnosis::Cause& cause : d.causes) {
            const bool of_time = cause.effect == "unknown" || cause.effect == "thermal.drift" ||
                                 cause.effect == "artefact.moved";
            if (!of_time) CHECK(cause.probability < 0.9);
        }
    }
}

// The other way round: an error of A that is read in the same slow order remains one.
TEST_CASE("an error of an axis that is read slowly is no course of time", "[diagnosis][walk]") {
    const setup::Setup setup = campaign::ac_setup();
    const setup::Setup real = campaign::with_effect(
        setup, "A.radial: EYA_cos2_mm=0.004, EZA_sin2_mm=0.003, EYA_sin1_mm=0.004");
    for (const unsigned seed : {1, 2}) {
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(setup, campaign::measured(real, slow_poses(setup), seed));
        INFO(seed << ": " << said(d));
        CHECK(probability_of(d, "A.radial") > 0.8);
    }
}

namespace {

/// An angle of an axis along its travel (-1..1), rad: slope, bow and a wave.
struct AngleForm {
    double slope, bow, wave, phase;
    double at(double part) const {
        return 1e-6 * (slope * part + bow * part * part + wave * std::sin(6.0 * part + phase));
    }
};

/// Autocollimator tests of X and Z on a machine of two slides, four angles, five runs each way.
records::ReadingTable two_slides(unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal(0.0, 1.0);
    records::ReadingTable table = laser_lines::empty_table();
    table.axes = {Axis::Z, Axis::X};
    const std::tuple<const char*, Axis, Vector3, double> tests[] = {
        {"Z about X", Axis::Z, Vector3::UnitX(), 45.0},
        {"Z about Y", Axis::Z, Vector3::UnitY(), 30.0},
        {"X about Y", Axis::X, Vector3::UnitY(), 18.0},
        {"X about Z", Axis::X, Vector3::UnitZ(), 10.0}};
    for (const auto& [test, axis, direction, size] : tests) {
        const AngleForm form{size * (1.0 + 0.3 * normal(engine)), 0.1 * size * normal(engine),
                             size * (seed % 2 ? 0.0 : 0.04), 3.0 * normal(engine)};
        for (int pass = 0; pass < 10; ++pass)
            for (int k = 0; k < 31; ++k) {
                const int place = pass % 2 ? 30 - k : k;
                records::Reading row;
                row.index = static_cast<int>(table.rows.size());
                row.time_s = 8.0 * row.index;
                row.commanded[axis] = (axis == Axis::Z ? 19.5 : 9.0) * place;
                row.test = test;
                row.device = records::Device::angle;
                row.feature = "R1";
                row.angular = true;
                row.direction_M = direction;
                row.value_mm = form.at(place / 15.0 - 1.0) + 1e-6 * normal(engine);
                table.rows.push_back(row);
            }
    }
    return table;
}

}  // namespace

TEST_CASE("the angles of two axes are no product of their positions", "[diagnosis]") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"lathe\"\nchain = \"w b Z X t\"\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -100]\n"
        "[model]\nmodelled = []\n",
        "lathe.toml", notes);
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(setup, two_slides(seed), {.plan_next = false});
        INFO(seed << ": " << said(d));
        CHECK(d.explained > 0.95);
        for (const char* name : {"Z.angular", "X.angular"})
            CHECK(std::any_of(d.causes.begin(), d.causes.end(), [&](const auto& cause) {
                return cause.effect == name && cause.probability >= 0.8;
            }));
    }
}

}  // namespace trunnion
