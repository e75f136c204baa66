// Tables whose head does not say from which side the axes came: the sides are found beside the
// cause, and are none themselves.

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>

#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/laser_lines.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// Circles before B and C have moved, then turns of both and a map of the sphere; nothing tells
/// from which side any axis came.
records::ReadingTable without_sides(const setup::Setup& truth, int side_of_c, std::uint64_t seed) {
    records::ReadingTable table = campaign::empty_table(truth);
    campaign::add_ballbar(table, truth, 24);
    campaign::add_sphere_map(table, truth, 30, 5);
    table.side_before[index_of(Axis::C)] = static_cast<signed char>(side_of_c);
    table.side_before[index_of(Axis::B)] = 1;
    records::ReadingTable read = campaign::measured(truth, table, seed);
    read.side_before = {};
    return read;
}

}  // namespace

TEST_CASE("backlash is named, and the side that no row tells beside it", "[diagnosis][sides]") {
    const setup::Setup setup = campaign::bc_setup();
    diagnosis::DiagnosisOptions options;
    options.plan_next = false;
    const setup::Setup truth =
        campaign::with_effect(campaign::real_machine(setup), "C.backlash=60urad");
    for (const int side : {-1, 1}) {
        INFO(side);
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(setup, without_sides(truth, side, 3), options);
        REQUIRE_FALSE(d.causes.empty());
        CHECK(d.causes[0].effect == "C.backlash");
        CHECK(d.causes.size() == 1);
        CHECK(d.causes[0].parameters[0].value == Approx(6e-5).epsilon(0.1));
        CHECK(d.verdict != diagnosis::Verdict::unexplained);
        for (const diagnosis::Cause& c : d.causes) UNSCOPED_INFO(c.effect << ' ' << c.probability);
        for (const auto& found : d.sides) UNSCOPED_INFO(to_string(found));
        REQUIRE(d.sides.size() == 1);  // no cause asks for the side of B
        CHECK(d.sides[0].axis == "C");
        CHECK(d.sides[0].side == side);
        CHECK(d.sides[0].told());
        CHECK(d.sides[0].value() == Approx(side).margin(0.1));
    }
}

TEST_CASE("unknown sides make no gap", "[diagnosis][sides]") {
    const setup::Setup setup = campaign::bc_setup();
    for (std::uint64_t seed = 1; seed <= 1; ++seed) {
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(setup, without_sides(campaign::real_machine(setup), -1, seed));
        CHECK(d.verdict == diagnosis::Verdict::no_gap);
        CHECK(d.sides.empty());
    }
}

TEST_CASE("an axis that never reverses has no play", "[diagnosis][sides]") {
    // A raster with Y slowest. Its first line is 40 um off; or it is taken again on the way back,
    // with a play of 40 um.
    const setup::Setup setup = laser_lines::stage(
        "noise_um = { point = 2 }\n[[instrument]]\nname = \"T\"\nframe = \"W\"\nfree = "
        "[\"pose\"]\n");
    for (const bool reverses : {false, true}) {
        records::ReadingTable table = laser_lines::empty_table();
        table.side_before = {};
        table.optional_columns = {"instrument"};
        SeededNoise random(8);
        for (int pass = 0; pass < (reverses ? 2 : 1); ++pass) {
            // Beyond the last line, so that it is read from the other side.
            records::Reading beyond;
            beyond.index = static_cast<int>(table.rows.size());
            beyond.time_s = 10.0 * (beyond.index / 3);
            beyond.test = "raster";
            beyond.commanded[Axis::Y] = 400.0;
            if (pass > 0) table.rows.push_back(beyond);
            for (int line = 0; line < 8; ++line)
                for (int k = 0; k < 27; ++k) {
                    records::Reading row;
                    row.index = static_cast<int>(table.rows.size());
                    row.time_s = 10.0 * (row.index / 3);
                    row.commanded[Axis::Y] = 50.0 * (pass ? 7 - line : line);
                    row.commanded[Axis::X] = 50.0 * (line % 2 ? 4 - k / 3 : k / 3 - 4);
                    row.test = "raster";
                    row.device = records::Device::point;
                    row.feature = "R1";
                    row.instrument = "T";
                    row.direction_M = Vector3::Unit(k % 3);
                    const double told_mm = pass ? -0.02 : 0.02, step_mm = line == 0 ? 0.04 : 0.0;
                    row.value_mm = 2e-3 * random.normal();
                    if (k % 3 == 1) *row.value_mm += reverses ? told_mm : step_mm;
                    table.rows.push_back(row);
                }
        }
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, table);
        INFO(reverses << ": " << said(d));
        CHECK(claims(d, "Y.backlash") == reverses);
    }
}

TEST_CASE("a backlash that the simulation has: its side is found with the base",
          "[diagnosis][sides]") {
    setup::Setup setup = campaign::bc_setup();
    setup.model.modelled = {"location", "C.backlash"};
    const setup::Setup truth =
        campaign::with_effect(campaign::real_machine(setup), "C.backlash=60urad");
    const diagnosis::Diagnosis d = diagnosis::diagnose(setup, without_sides(truth, -1, 4));
    CHECK(d.verdict == diagnosis::Verdict::no_gap);
    REQUIRE(d.sides.size() == 1);
    CHECK(d.sides[0].side == -1);
}

namespace {

/// Points of a tracker in a grid of 3 x 3 places at two heights of Z, which alternate, twice. What
/// is read at the upper height is shifted.
records::ReadingTable two_heights(const Vector3& shift_mm, unsigned seed) {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> noise(0.0, 5e-3);
    records::ReadingTable table = laser_lines::empty_table();
    table.side_before.fill(0);
    for (int k = 0; k < 36; ++k)
        for (int d = 0; d < 3; ++d) {
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 20.0 * k;
            row.test = "P";
            row.device = records::Device::point;
            row.feature = "R1";
            row.commanded[Axis::X] = 400.0 * (k / 2 % 3 - 1);
            row.commanded[Axis::Y] = 400.0 * (k / 6 % 3 - 1);
            row.commanded[Axis::Z] = k % 2 ? 300.0 : -300.0;
            row.direction_M = Vector3::Unit(d);
            row.value_mm = (k % 2 ? shift_mm(d) : 0.0) + noise(engine);
            table.rows.push_back(row);
        }
    return table;
}

}  // namespace

TEST_CASE("at two heights, each reached from one side, a shift is a squareness and no play",
          "[diagnosis][sides]") {
    std::vector<std::string> notes;
    const setup::Setup setup = setup::parse_setup(
        "[machine]\nname = \"mill\"\nchain = \"w b X Y Z t\"\n"
        "[[instrument]]\nname = \"T\"\nframe = \"M\"\nfree = [\"pose\"]\n"
        "[[artefact]]\nname = \"R1\"\nkind = \"target\"\ntool_mm = [0, 0, -150]\n"
        "[model]\nmodelled = []\n",
        "mill.toml", notes);
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(setup, two_heights({0.06, -0.04, 0.0}, seed), {.plan_next = false});
        INFO(seed << ": " << said(d));
        for (const diagnosis::Cause& cause : d.causes) {
            const bool sideways =
                cause.effect == "Z.lateral_play" || cause.effect == "Z.straightness";
            CHECK_FALSE(sideways);
        }
        // Through one tool length the angles of Z do the same.
        for (const std::string name : {"ZX.squareness", "YZ.squareness"})
            CHECK(std::any_of(d.causes.begin(), d.causes.end(), [&](const auto& cause) {
                return cause.effect == name ||
                       std::count(cause.rivals.begin(), cause.rivals.end(), name) > 0;
            }));
    }
}

}  // namespace trunnion
