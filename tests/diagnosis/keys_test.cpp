// Periods and decays: found beside everything else that is unknown, and not made of a few readings.
#include <catch2/catch.hpp>
#include <cmath>

#include "diagnosis/diagnosis.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

/// The map's poses with the tilting axis in steps of 45 degrees, passes of the ballbar beside it.
records::ReadingTable coarse_map_and_passes(const setup::Setup& setup, std::uint64_t seed) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 60, seed);
    const double step_rad = rad_from_deg(45.0);
    for (records::Reading& row : table.rows) {
        double& tilt = row.commanded[Axis::B];
        if (row.device == records::Device::sphere) tilt = step_rad * std::round(tilt / step_rad);
        campaign::aim(row, setup, setup.find_artefact(row.feature)->center_W_mm,
                      setup.probe->tip_S_mm);
    }
    campaign::add_ballbar(table, setup, 36);
    std::erase_if(table.rows, [](const records::Reading& row) {
        return row.test.starts_with("B_bar") && row.test != "B_bar_x_up";
    });
    return table;
}

}  // namespace

TEST_CASE("a ripple that poses in even steps see as positioning is found by what passes see",
          "[diagnosis]") {
    setup::Setup setup = campaign::bc_setup();
    setup.artefacts[2].center_W_mm = {20.0, 2.0, 45.0};  // a short lever: the poses weigh more
    for (const int periods : {28, 52, 60}) {
        const setup::Setup truth = campaign::with_effect(
            campaign::with_effect(campaign::real_machine(setup),
                                  "B.cyclic: cos_rad=-5e-5, sin_rad=5e-5, periods_per_turn=" +
                                      std::to_string(periods)),
            "servo.mismatch: tau_x_s=-4e-4, tau_z_s=-2e-4");
        const diagnosis::Diagnosis d = diagnosis::diagnose(
            setup, campaign::measured(truth, coarse_map_and_passes(setup, 3), 5));
        INFO(periods);
        REQUIRE(d.causes.size() == 2);
        for (const diagnosis::Cause& cause : d.causes) {
            INFO(cause.effect);
            CHECK((cause.effect == "B.cyclic" || cause.effect == "servo.mismatch"));
            for (const identification::FitParameter& p : cause.parameters)
                if (p.name == "periods_per_turn") CHECK(p.value == periods);
        }
        // What a wrong period leaves is not taken for noise either.
        CHECK(d.noise.ballbar.scale == Approx(1.0).margin(0.1));
    }
}

TEST_CASE("a few wild readings of a ballbar are no spike", "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_ballbar(table, setup, 30);
    int loud = 0;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        records::ReadingTable readings =
            campaign::measured(campaign::real_machine(setup), table, seed);
        SeededNoise random(seed);
        for (int k = 0; k < 14; ++k)
            *readings
                 .rows[static_cast<std::size_t>(random.uniform() *
                                                static_cast<double>(readings.rows.size()))]
                 .value_mm += (random.uniform() < 0.5 ? 1 : -1) * (2e-3 + 3e-3 * random.uniform());
        loud += diagnosis::diagnose(setup, readings).verdict == diagnosis::Verdict::no_gap ? 0 : 1;
    }
    CHECK(loud <= 1);
}

}  // namespace trunnion
