// What a probe finds in several tests: zeros that scatter are noise; what has a sign has one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <random>

#include "diagnosis/groups/candidate_groups.h"
#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {

TEST_CASE("zeros of tests that scatter in the machine frame are no gap", "[diagnosis][zeros]") {
    const setup::Setup setup = campaign::bc_setup();
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        records::ReadingTable table = campaign::empty_table(setup);
        campaign::add_sphere_map(table, setup, 120, seed);
        for (std::size_t i = 0; i < table.rows.size(); ++i)
            table.rows[i].test = "T" + std::to_string(6 * i / table.rows.size());
        table = campaign::measured(setup, table, seed + 20);
        std::mt19937_64 engine(seed + 40);
        std::normal_distribution<double> zero(0.0, 0.25e-3);
        std::map<std::string, Vector3> zeros;
        for (records::Reading& row : table.rows) {
            const auto [at, is_first] = zeros.try_emplace(row.test, Vector3::Zero());
            if (is_first) at->second = {zero(engine), zero(engine), zero(engine)};
            if (row.value_mm) *row.value_mm += at->second.dot(row.direction_M);
        }
        const diagnosis::Diagnosis d = diagnosed(setup, table);
        INFO(seed << ": " << said(d));
        CHECK(d.verdict == diagnosis::Verdict::no_gap);
    }
}

// A form of B.radial has the same columns: with this sign it is that.
TEST_CASE("no table rises under its weight", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 80, 3);
    for (const double sag_mm : {0.008, -0.008}) {
        const setup::Setup real = campaign::with_effect(
            setup, "gravity.sag: twist_rad=0, sag_mm=" + std::to_string(sag_mm));
        const diagnosis::Diagnosis d = diagnosed(setup, campaign::measured(real, table, 5));
        INFO(sag_mm << ": " << said(d));
        REQUIRE(!d.causes.empty());
        CHECK((d.causes.front().effect == "gravity.sag") == (sag_mm > 0.0));
    }
}

TEST_CASE("the offsets of a stylus may be wrong one by one", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    const effects::Catalogue catalogue = effects::make_catalogue(setup);
    const effects::Effect* runout = effects::find_effect(catalogue, "probe.runout");
    REQUIRE(runout);
    const auto forms = diagnosis::simpler_forms(*runout);
    REQUIRE(forms.size() == 2);
    for (const auto& takes : forms)
        CHECK(std::count_if(runout->parameters.begin(), runout->parameters.end(), takes) == 1);
}

}  // namespace trunnion
