// Readings that are left out before anything is explained: few, and not side by side.
#include "diagnosis/prepare/outliers.h"

#include <catch2/catch.hpp>

#include "tests/support/campaign.h"

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

}  // namespace trunnion
