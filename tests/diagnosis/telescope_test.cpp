// A telescope against stars: both readings of a star turn with it, and nobody states their noise.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "geometry/pose.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

setup::Setup mount(const std::string& errors = "", const std::string& tool_mm = "[0, 0, 0]") {
    std::vector<std::string> notes;
    return setup::parse_setup(
        "[machine]\nname = \"mount\"\nchain = \"w b C A t\"\n"
        "[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "[machine.axis.A]\ndirection = [1, 0, 0]\npoint_mm = [0, 0, 0]\n"
        "[[artefact]]\nname = \"Star\"\nkind = \"target\"\ntool_mm = " +
            tool_mm + "\n[model]\nmodelled = []\n" + errors,
        "s.toml", notes);
}

/// Stars in the order of their azimuths: the rotation about A, and across A and the line of sight,
/// as `import pointing` writes them.
records::ReadingTable sky(int count) {
    records::ReadingTable table;
    table.path = "sky.csv";
    table.axes = {Axis::A, Axis::C};
    std::mt19937 random(11);
    std::uniform_real_distribution<double> even(0.0, 1.0);
    std::vector<double> azimuths;
    for (int k = 0; k < count; ++k) azimuths.push_back(2.0 * pi * even(random));
    std::sort(azimuths.begin(), azimuths.end());
    for (int k = 0; k < 2 * count; ++k) {
        const double azimuth = azimuths[static_cast<std::size_t>(k / 2)];
        const Vector3 about = rotation_about(-Vector3::UnitZ(), azimuth) * Vector3::UnitX();
        records::Reading row;
        row.index = k;
        row.time_s = 60.0 * (k / 2);
        row.test = k % 2 == 0 ? "A" : "across_A";
        row.device = records::Device::angle;
        row.feature = "Star";
        row.commanded[Axis::C] = azimuth;
        row.commanded[Axis::A] =
            k % 2 == 0 ? 0.3 + 1.0 * even(random) : table.rows.back().commanded[Axis::A];
        const Vector3 sight = rotation_about(about, row.commanded[Axis::A]) *
                              Vector3((-Vector3::UnitZ()).cross(about));
        row.direction_M = k % 2 == 0 ? about : Vector3(sight.cross(about).normalized());
        table.rows.push_back(row);
    }
    return table;
}

constexpr double sigma_rad = 150e-6;

records::ReadingTable read_by(const setup::Setup& real, int stars, unsigned seed) {
    records::ReadingTable table =
        emulator::predicted(real, sky(stars), effects::active_models(real));
    std::mt19937 random(seed);
    std::normal_distribution<double> normal(0.0, sigma_rad);
    for (records::Reading& row : table.rows) *row.value_mm += normal(random);
    return table;
}

}  // namespace

// Seen from the bed no two stars are read in one direction, seen from the telescope all are. With
// the usual noise of an angle (2 urad) a lean was called an exchange of columns.
TEST_CASE("a telescope of unknown noise leans", "[diagnosis]") {
    const setup::Setup real = mount("[machine.errors]\nEA0C_rad = 6e-4\nEB0C_rad = -2e-4\n");
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const diagnosis::Diagnosis d = diagnosis::diagnose(mount(), read_by(real, 46, seed));
        INFO(seed << " " << said(d));
        CHECK(d.noise_um * 1e-3 == Approx(sigma_rad).epsilon(0.2));
        CHECK(d.verdict == diagnosis::Verdict::explained);
        CHECK(probability_of(d, "location") > 0.9);
        CHECK(d.writes_causes);
        for (const std::string& note : d.notes) CHECK_THAT(note, !Catch::Contains("exchanged"));
    }
}

// Readings of a simulation have no noise that neighbours could tell.
TEST_CASE("a telescope that is simulated without noise leans", "[diagnosis]") {
    const setup::Setup real = mount("[machine.errors]\nEA0C_rad = 6e-4\nEB0C_rad = -2e-4\n");
    const records::ReadingTable table =
        emulator::predicted(real, sky(46), effects::active_models(real));
    const diagnosis::Diagnosis d = diagnosis::diagnose(mount(), table);
    INFO(said(d));
    CHECK(d.verdict == diagnosis::Verdict::explained);
    CHECK(probability_of(d, "location") > 0.9);
    for (const std::string& note : d.notes) CHECK_THAT(note, !Catch::Contains("exchanged"));
}

TEST_CASE("a telescope of unknown noise and no error has no gap", "[diagnosis]") {
    int silent = 0;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        const diagnosis::Diagnosis d = diagnosis::diagnose(mount(), read_by(mount(), 60, seed));
        INFO(seed << " " << said(d));
        silent += d.verdict == diagnosis::Verdict::no_gap ? 1 : 0;
        for (const diagnosis::Cause& c : d.causes) CHECK(c.probability.value() <= 0.5);
    }
    CHECK(silent >= 3);
}

// Stars tell the line of sight, not the axis: what goes with the elevation may be the tube or the
// air as well as the encoder.
TEST_CASE("a line of sight that bends is a rival of the axis that carries it", "[diagnosis]") {
    for (const bool of_axis : {false, true}) {
        records::ReadingTable table = read_by(mount(), 80, 3);
        for (records::Reading& row : table.rows) {
            row.angular = true;
            if (row.test != "A") continue;
            const double a = row.commanded[Axis::A];
            *row.value_mm += of_axis ? 2e-3 * std::cos(3.0 * a + 0.4)
                                     : 3e-3 / std::tan(a) * 0.3 + 2e-3 * std::cos(a);
        }
        const diagnosis::Diagnosis d = diagnosis::diagnose(mount(), table);
        INFO(of_axis << " " << said(d));
        const auto at = std::find_if(d.causes.begin(), d.causes.end(),
                                     [](const auto& c) { return c.effect == "A.positioning"; });
        REQUIRE(at != d.causes.end());
        const auto rival = [&](const char* name) {
            return std::count(at->rivals.begin(), at->rivals.end(), name) > 0;
        };
        CHECK(rival("air.refraction") == !of_axis);
        CHECK((at->probability <= 0.5) == !of_axis);
        if (!of_axis) CHECK(rival("chain.flexure"));
        CHECK((at->what.find("refraction") != std::string::npos) == !of_axis);
    }
}

namespace {

/// A fork whose polar axis leans, and stars above 20 degrees that the air lifts (`lift_rad` times
/// the cotangent of their elevation).
struct Equatorial {
    double lean_rad;
    setup::Setup setup() const {
        std::vector<std::string> notes;
        return setup::parse_setup(
            fmt::format("[machine]\nname = \"mount\"\nchain = \"w b C A t\"\n"
                        "[machine.axis.C]\ndirection = [0, {}, {}]\npoint_mm = [0, 0, 0]\n"
                        "[machine.axis.A]\ndirection = [1, 0, 0]\npoint_mm = [0, 0, 0]\n"
                        "[[artefact]]\nname = \"Star\"\nkind = \"target\"\n"
                        "tool_mm = [0, 0, 0]\n[model]\nmodelled = []\n",
                        std::sin(lean_rad), -std::cos(lean_rad)),
            "s.toml", notes);
    }
    records::ReadingTable stars(double lift_rad, unsigned seed) const {
        records::ReadingTable table = sky(160);
        std::mt19937 random(seed);
        std::normal_distribution<double> normal(0.0, 40e-6);
        const Matrix3 lean = rotation_about(Vector3::UnitX(), lean_rad);
        std::vector<records::Reading> seen;
        for (std::size_t k = 0; k + 1 < table.rows.size(); k += 2) {
            records::Reading pair[] = {table.rows[k], table.rows[k + 1]};
            for (records::Reading& row : pair) row.direction_M = lean * row.direction_M;
            const Vector3 sight = pair[1].direction_M.cross(pair[0].direction_M);
            const Vector3 up = sight.z() > 0.0 ? sight : Vector3(-sight);
            if (up.z() < std::sin(0.35) || up.z() > std::sin(1.45)) continue;
            const double cotangent = std::hypot(up.x(), up.y()) / up.z();
            const Vector3 turn = lift_rad * cotangent * up.cross(Vector3::UnitZ()).normalized();
            for (records::Reading& row : pair) {
                row.angular = true;
                row.value_mm = turn.dot(row.direction_M) + normal(random);
                seen.push_back(row);
            }
        }
        table.rows = std::move(seen);
        return table;
    }
};

}  // namespace

// The vertical is known on any mount.
TEST_CASE("on an equatorial mount the air is a rival of a droop", "[diagnosis]") {
    const Equatorial mount{0.73};
    int droops = 0;
    for (const unsigned seed : {1, 2, 3}) {
        const records::ReadingTable table = mount.stars(270e-6, seed);
        REQUIRE(table.rows.size() > 60);
        const diagnosis::Diagnosis d = diagnosis::diagnose(mount.setup(), table);
        INFO(seed << " " << said(d));
        for (const diagnosis::Cause& c : d.causes) {
            if (c.effect != "chain.flexure") continue;
            ++droops;
            CHECK(c.probability <= 0.5);
            CHECK(std::count(c.rivals.begin(), c.rivals.end(), "air.refraction") == 1);
        }
    }
    CHECK(droops > 0);
}

// A mirror on an arm, read by an autocollimator: no air bends what it shows.
TEST_CASE("an arm that no star is seen by has no refraction", "[diagnosis]") {
    const setup::Setup arm = mount("", "[0, 0, -100]");
    records::ReadingTable table = read_by(arm, 80, 3);
    for (records::Reading& row : table.rows) {
        row.angular = true;
        if (row.test == "A") *row.value_mm += 2e-3 * std::cos(row.commanded[Axis::A]);
    }
    const diagnosis::Diagnosis d = diagnosis::diagnose(arm, table);
    INFO(said(d));
    CHECK(d.verdict != diagnosis::Verdict::no_gap);
    for (const diagnosis::Cause& cause : d.causes)
        CHECK(std::count(cause.rivals.begin(), cause.rivals.end(), "air.refraction") == 0);
}

// A driver of time follows what is wrong at the ends of a run: the readings are set aside all the
// same.
TEST_CASE("the first and the last star of a run are wrong ones", "[diagnosis]") {
    const setup::Setup real = mount("[machine.errors]\nEA0C_rad = 3e-4\nEB0C_rad = -6e-4\n");
    records::ReadingTable table = read_by(real, 49, 5);
    *table.rows[0].value_mm += 15.0 * sigma_rad;
    *table.rows[1].value_mm -= 28.0 * sigma_rad;
    *table.rows[97].value_mm += 12.0 * sigma_rad;
    const diagnosis::Diagnosis d = diagnosis::diagnose(mount(), table);
    INFO(said(d));
    CHECK(d.outliers == 3);
    CHECK(probability_of(d, "location") > 0.9);
    CHECK(d.writes_causes);
}

// The droop is 50 times what is usual, and an error of A does the same: one of the two is there, so
// it is written.
// Beside the set-up alone they are no further off than the others: the lean hides them.
TEST_CASE("three wrong stars of 32 are found beside a lean", "[diagnosis]") {
    const setup::Setup real = mount("[machine.errors]\nEA0C_rad = 1.2e-3\nEB0C_rad = -6e-4\n");
    for (unsigned seed = 1; seed <= 3; ++seed) {
        records::ReadingTable table = read_by(real, 32, seed);
        const records::ReadingTable right = table;
        std::mt19937 random(seed + 50);
        std::normal_distribution<double> normal(0.0, 0.3);
        for (const std::size_t star : {8U, 17U, 24U})
            for (const std::size_t row : {2 * star, 2 * star + 1})
                *table.rows[row].value_mm +=
                    (star == 17U ? -1.0 : 1.0) * (1.8e-3 + 1e-3 * normal(random));
        const diagnosis::Diagnosis d = diagnosis::diagnose(mount(), table);
        INFO(seed << " " << said(d));
        CHECK(d.outliers == 6);
        CHECK(d.noise_um * 1e-3 == Approx(sigma_rad).epsilon(0.3));
        REQUIRE(!d.causes.empty());
        CHECK(d.causes.front().effect == "location");
        CHECK(d.causes.front().probability > 0.8);
        CHECK(d.explained > 0.8);
        // Without wrong ones none is set aside.
        CHECK(diagnosis::diagnose(mount(), right).outliers == 0);
    }
}

TEST_CASE("a large droop that has a rival is written", "[diagnosis]") {
    const setup::Setup real = mount("[effects]\n\"chain.flexure\" = { droop_rad = 2.5e-3 }\n");
    const diagnosis::Diagnosis d = diagnosis::diagnose(mount(), read_by(real, 60, 3));
    INFO(said(d));
    CHECK(probability_of(d, "chain.flexure") + probability_of(d, "A.positioning") > 0.3);
    CHECK(d.writes_causes);
}

namespace {

/// Stars whose rows state 0.3 to 8 times `sigma_rad` / 5; `added_rad` scatters besides.
records::ReadingTable read_with_sigmas(const setup::Setup& real, double added_rad, unsigned seed) {
    records::ReadingTable table = emulator::predicted(real, sky(70), effects::active_models(real));
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (records::Reading& row : table.rows) {
        row.sigma_mm = 0.2 * sigma_rad * std::clamp(std::exp(normal(random)), 0.3, 8.0);
        *row.value_mm += std::hypot(*row.sigma_mm, added_rad) * normal(random);
    }
    return table;
}

}  // namespace

// The sigma of a row is that of the fit of a beam: the rows of the smallest ones ruled, and what
// they scatter was explained by tables that were not there.
TEST_CASE("noise that adds to what rows state is found", "[diagnosis]") {
    const setup::Setup real = mount("[machine.errors]\nEA0C_rad = 3e-4\nEB0C_rad = -2e-4\n");
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(mount(), read_with_sigmas(real, 0.5 * sigma_rad, seed));
        INFO(seed << " " << said(d));
        REQUIRE(d.added.size() == 1);
        CHECK(d.added.front().added_um * 1e-3 == Approx(0.5 * sigma_rad).epsilon(0.3));
        CHECK(d.noise.source == diagnosis::NoiseSource::assumed);
        CHECK(d.verdict == diagnosis::Verdict::explained);
        CHECK(probability_of(d, "location") > 0.9);
        for (const diagnosis::Cause& c : d.causes)
            CHECK((c.effect == "location" || c.probability < 0.9));
    }
}

TEST_CASE("rows that state their noise rightly are believed", "[diagnosis]") {
    const setup::Setup real = mount("[machine.errors]\nEA0C_rad = 3e-4\nEB0C_rad = -2e-4\n");
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(mount(), read_with_sigmas(real, 0.0, seed));
        INFO(seed << " " << said(d));
        CHECK(d.added.empty());
        CHECK(probability_of(d, "location") > 0.9);
    }
}

}  // namespace trunnion
