// A probe that triggers later in some directions has two or three lobes.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "base/units.h"
#include "diagnosis/diagnosis.h"
#include "effects/settings.h"
#include "emulator/replay.h"
#include "tests/support/campaign.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

/// One sphere touched from 13 directions at 12 poses.
records::ReadingTable touches(const setup::Setup& setup) {
    records::ReadingTable table = campaign::empty_table(setup);
    const setup::Artefact& sphere = *setup.find_artefact("S1");
    const double reach_mm = 0.5 * (sphere.diameter_mm + setup.probe->ball_diameter_mm);
    for (int pose = 0; pose < 12; ++pose)
        for (int k = 0; k < 13; ++k) {
            const double azimuth = 2.0 * pi * k / 8.0, up = k < 8 ? 0.0 : k < 12 ? 0.7 : 0.5 * pi;
            const Vector3 outward(std::cos(up) * std::cos(azimuth),
                                  std::cos(up) * std::sin(azimuth), std::sin(up));
            records::Reading row;
            row.index = static_cast<int>(table.rows.size());
            row.time_s = 10.0 * row.index;
            row.test = "map";
            row.device = records::Device::touch;
            row.feature = "S1";
            row.feed_mm_min = 100.0;
            row.direction_M = -outward;
            row.commanded[campaign::tilting(setup)] = rad_from_deg(-60.0 + 30.0 * (pose % 5));
            row.commanded[Axis::C] = rad_from_deg(75.0 * pose);
            campaign::aim(row, setup, sphere.center_W_mm, setup.probe->tip_S_mm);
            for (int d = 0; d < 3; ++d)
                row.commanded[d == 0   ? Axis::X
                              : d == 1 ? Axis::Y
                                       : Axis::Z] += reach_mm * outward(d);
            table.rows.push_back(row);
        }
    return table;
}

}  // namespace

// Of two lobes X later and Y earlier was a play of both: four false causes of 0.93.
TEST_CASE("two lobes of a probe are its pretravel, and no play", "[diagnosis][lobes]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup real =
        campaign::with_effect(setup, "probe.pretravel: cos2_mm=0.003, sin2_mm=-0.004");
    for (const std::uint64_t seed : {1, 2}) {
        const diagnosis::Diagnosis d =
            diagnosis::diagnose(setup, campaign::measured(real, touches(setup), seed, 0.5));
        INFO(seed << ": " << said(d));
        CHECK(probability_of(d, "probe.pretravel") > 0.8);
        for (const diagnosis::Cause& c : d.causes)
            if (c.effect != "probe.pretravel") CHECK(c.probability < 0.5);
    }
}

}  // namespace trunnion
