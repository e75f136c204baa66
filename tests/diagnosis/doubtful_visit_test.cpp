// One visit of a pose whose readings are wrong, and a structure that drifts where heads turn the
// tool: neither becomes a false cause.
#include <algorithm>
#include <catch2/catch.hpp>

#include "diagnosis/rules/rules.h"
#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/measured_machines.h"
#include "tests/support/said.h"

namespace trunnion {

TEST_CASE("a first visit that is wrong makes no cause certain, and is a rival of what is claimed",
          "[diagnosis][spoiled]") {
    const setup::Setup setup = campaign::bc_setup();
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        records::ReadingTable table = campaign::empty_table(setup);
        campaign::add_sphere_map(table, setup, 12, 5);
        table = campaign::measured(setup, table, seed);
        int spoiled = 0;
        for (records::Reading& row : table.rows)
            if (row.device == records::Device::sphere && spoiled < 3)
                *row.value_mm += 1e-3 * (spoiled++ % 2 ? -14.0 : 17.0);
        const diagnosis::Diagnosis d = diagnosed(setup, table);
        INFO(seed << ": " << said(d));
        REQUIRE(spoiled == 3);
        for (const diagnosis::Cause& cause : d.causes) {
            if (!cause.known) continue;
            CHECK(cause.probability < diagnosis::rules::sure);
            const bool named =
                std::count(cause.rivals.begin(), cause.rivals.end(), "reading.spoiled") > 0;
            CHECK((named || cause.probability < diagnosis::rules::claimed));
        }
    }
}

TEST_CASE("a structure that drifts under turning heads is named", "[diagnosis]") {
    std::vector<std::string> notes;
    const setup::Setup setup =
        measured::setup_of(measured::file_text("machines/head_head.toml") +
                           "\n[[artefact]]\nname = \"R1\"\nkind = \"target\"\n"
                           "tool_mm = [0, 0, -150]\n");
    records::ReadingTable table = campaign::empty_table(setup);
    table.axes = {Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::C};
    for (int k = 0; k < 150; ++k) {
        records::Reading row;
        row.index = k;
        row.time_s = 40.0 * (k / 3);
        row.test = "T";
        row.device = records::Device::point;
        row.feature = "R1";
        row.direction_M = Vector3::Unit(k % 3);
        const int pose = k / 3 * 7 % 50;  // shuffled, so that time is no position
        row.commanded[Axis::A] = 0.12 * (pose % 7 - 3);
        row.commanded[Axis::C] = 0.5 * (pose % 11 - 5);
        row.commanded[Axis::X] = 40.0 * (pose % 5 - 2);
        table.rows.push_back(row);
    }
    const setup::Setup warm =
        campaign::with_effect(setup, "thermal.drift: structure_mm=[0.02, -0.015, 0.03], tau_s=700");
    const diagnosis::Diagnosis d = diagnosed(setup, campaign::measured(warm, table, 3));
    INFO(said(d));
    REQUIRE_FALSE(d.causes.empty());
    CHECK(d.causes.front().effect == "thermal.drift");
    CHECK(d.causes.front().probability > 0.9);
    CHECK(d.causes.size() == 1);
}

}  // namespace trunnion
