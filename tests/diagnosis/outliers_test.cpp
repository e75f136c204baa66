// Readings that are left out before anything is explained: few, and not side by side.
#include "diagnosis/prepare/outliers.h"

#include <catch2/catch.hpp>

#include "tests/support/campaign.h"
#include "tests/support/said.h"

namespace trunnion {

TEST_CASE("scattered wild readings are left out, neighbouring ones are what the machine does",
          "[diagnosis]") {
    const setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, 150, 5);
    const records::ReadingTable clean = campaign::measured(campaign::real_machine(setup), table, 3);
    std::vector<std::size_t> device;
    for (std::size_t i = 0; i < clean.rows.size(); ++i)
        if (clean.rows[i].device != records::Device::none) device.push_back(i);
    const auto left_out = [&](const std::vector<std::size_t>& wild) {
        records::ReadingTable readings = clean;
        for (const std::size_t k : wild) *readings.rows[device[k]].value_mm += 0.02;
        const diagnosis::Prepared prepared = diagnosis::prepare(setup, readings);
        return diagnosis::lone_probe_readings(prepared,
                                              std::vector<bool>(prepared.replay.size(), true));
    };
    const std::vector<std::size_t> scattered{7, 101, 160, 272, 404};
    CHECK(left_out({}).empty());
    CHECK(left_out(scattered) == scattered);
    CHECK(left_out({199, 202, 205, 208, 211}).empty());  // five poses, one after the other
    std::vector<std::size_t> many;
    for (std::size_t k = 3; k < 450; k += 22) many.push_back(k);
    CHECK(left_out(many).empty());  // more than 4 of 100
}

// What explains the others says nothing of those that were left out.
TEST_CASE("many readings set aside are named beside causes that explain the others",
          "[diagnosis][aside]") {
    const setup::Setup setup = campaign::bc_setup();
    const setup::Setup real = campaign::with_effect(setup, "C.backlash: gap_rad=0.0002");
    for (const int every : {0, 12}) {  // none, and one component of one pose in four
        records::ReadingTable table = campaign::empty_table(setup);
        campaign::add_sphere_map(table, setup, 60, 7);
        table = campaign::measured(real, table, 7);
        int device_rows = 0;
        for (records::Reading& row : table.rows)
            if (row.device == records::Device::sphere && every > 0 && device_rows++ % every == 0)
                *row.value_mm += 0.2;
        const diagnosis::Diagnosis d = diagnosis::diagnose(setup, table);
        INFO(every << ": " << said(d) << ", set aside " << d.outliers);
        CHECK(probability_of(d, "C.backlash") > 0.8);
        CHECK((d.outliers > 0) == (every > 0));
        CHECK((probability_of(d, "unknown") > 0.5) == (every > 0));
    }
}

}  // namespace trunnion
