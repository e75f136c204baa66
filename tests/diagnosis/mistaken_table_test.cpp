// Tables whose columns are exchanged, turned or in another unit are no machine's.
#include "diagnosis/mistaken_table.h"

#include <catch2/catch.hpp>

#include "base/alarm.h"
#include "diagnosis/advice/measurements.h"
#include "diagnosis/table_slips.h"
#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

struct SlipBench {
    setup::Setup known, real;
    SlipBench() : known(campaign::bc_setup()), real(campaign::real_machine(known)) {}

    records::ReadingTable touched(std::uint64_t seed) const {
        for (const diagnosis::Measurement& m : diagnosis::ready_measurements(known, 0.0))
            if (m.name == "both_ways") return campaign::measured(real, m.table, seed);
        throw std::logic_error("no measurement");
    }
    records::ReadingTable found(std::uint64_t seed) const {
        records::ReadingTable table = campaign::empty_table(known);
        campaign::add_sphere_map(table, known, 60, seed);
        return campaign::measured(real, table, seed);
    }
};

void exchange_directions(records::ReadingTable& table, int a, int b) {
    for (records::Reading& row : table.rows) std::swap(row.direction_M(a), row.direction_M(b));
}

void require_mistaken(const diagnosis::Diagnosis& d, const std::string& words) {
    INFO(said(d));
    REQUIRE_FALSE(d.causes.empty());
    CHECK(d.verdict == diagnosis::Verdict::unexplained);
    CHECK(d.causes.front().effect == "unknown");
    CHECK_THAT(d.causes.front().what, Catch::Contains(words));
    for (const diagnosis::Cause& c : d.causes)
        if (c.effect != "unknown") {
            CHECK(c.probability <= 0.05);
            CHECK(c.rivals.front() == diagnosis::mistaken_readings);
        }
    CHECK(d.next.empty());
    CHECK_FALSE(d.writes_causes);
}

}  // namespace

TEST_CASE("exchanged or turned directions of found spheres are told, and nothing is claimed",
          "[diagnosis][mistaken]") {
    const SlipBench bench;
    int told = 0;
    for (const std::uint64_t seed : {3, 4, 5}) {
        records::ReadingTable table = bench.found(seed);
        CHECK(diagnosed(bench.known, table).notes.empty());
        exchange_directions(table, 0, 1);
        require_mistaken(diagnosed(bench.known, table), "dir_x and dir_y seem to be exchanged");
        exchange_directions(table, 0, 1);
        for (records::Reading& row : table.rows) row.direction_M.x() = -row.direction_M.x();
        // A turned sign may look like errors of the machine; then nothing is sure.
        const diagnosis::Diagnosis d = diagnosed(bench.known, table);
        INFO(seed << ": " << said(d));
        if (d.causes.front().effect == "unknown") {
            require_mistaken(d, "the sign of dir_x seems to be turned");
            ++told;
        }
        for (const diagnosis::Cause& c : d.causes)
            CHECK((c.effect == "unknown" || c.probability < 0.9));
    }
    CHECK(told >= 1);
}

TEST_CASE("exchanged directions beside a real effect are told as well", "[diagnosis][mistaken]") {
    SlipBench bench;
    bench.real = campaign::with_effect(bench.real, "C.backlash: gap_rad=6e-5");
    records::ReadingTable table = bench.found(5);
    CHECK(claims(diagnosed(bench.known, table), "C.backlash"));
    exchange_directions(table, 1, 2);
    require_mistaken(diagnosed(bench.known, table), "dir_y and dir_z seem to be exchanged");
}

TEST_CASE(
    "touches of a wrong table are refused with the reason, or told where large residuals are "
    "accepted",
    "[diagnosis][mistaken]") {
    SlipBench bench;
    records::ReadingTable table = bench.touched(6);
    std::string words;
    SECTION("exchanged directions") {
        exchange_directions(table, 0, 1);
        words = "dir_x and dir_y seem to be exchanged";
    }
    SECTION("exchanged positions") {
        for (records::Reading& row : table.rows)
            std::swap(row.commanded[Axis::X], row.commanded[Axis::Y]);
        words = "x_mm and y_mm seem to be exchanged";
    }
    SECTION("a turned axis") {
        for (records::Reading& row : table.rows) row.commanded[Axis::C] *= -1.0;
        words = "the sign of c_deg seems to be turned";
    }
    SECTION("inches") {
        for (records::Reading& row : table.rows)
            if (row.value_mm) *row.value_mm /= 25.4;
        words = "in inches";
    }
    try {
        diagnosed(bench.known, table);
        FAIL("it is not refused");
    } catch (const InputError& error) {
        CHECK_THAT(error.message, Catch::Contains(words));
    }
    bench.known.model.allow_large = true;
    const diagnosis::Diagnosis d = diagnosed(bench.known, table);
    if (words != "in inches") return require_mistaken(d, words);
    // A radius that is wrong by millimetres reads alike: neither is sure.
    INFO(said(d));
    for (const diagnosis::Cause& c : d.causes) CHECK(c.probability <= 0.5);
    CHECK(d.verdict != diagnosis::Verdict::explained);
    CHECK(std::any_of(d.notes.begin(), d.notes.end(), [&](const std::string& note) {
        return note.find(words) != std::string::npos;
    }));
}

TEST_CASE("a machine with a large effect is no mistaken table", "[diagnosis][mistaken]") {
    const SlipBench bench;
    for (const char* effect : {"X.scale: scale_ppm=400", "C.radial: EXC_cos2_mm=0.05",
                               "B.positioning: cos1_rad=2e-3", "ZX.squareness: angle_rad=1e-3"}) {
        const setup::Setup truth = campaign::with_effect(bench.real, effect);
        records::ReadingTable table = campaign::empty_table(bench.known);
        campaign::add_sphere_map(table, bench.known, 60, 8);
        const diagnosis::Diagnosis d = diagnosed(bench.known, campaign::measured(truth, table, 8));
        INFO(effect << ": " << said(d));
        for (const diagnosis::Cause& c : d.causes)
            CHECK(std::count(c.rivals.begin(), c.rivals.end(), diagnosis::mistaken_readings) == 0);
    }
}

}  // namespace trunnion
