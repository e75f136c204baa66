// What an outside judge found on maps of spheres: few poses, and readings set aside along one
// direction.
#include <catch2/catch.hpp>

#include "tests/support/campaign.h"
#include "tests/support/diagnosed.h"
#include "tests/support/said.h"

namespace trunnion {
namespace {

records::ReadingTable map_of(const setup::Setup& setup, int poses, unsigned seed) {
    records::ReadingTable table = campaign::empty_table(setup);
    campaign::add_sphere_map(table, setup, poses, seed);
    return campaign::measured(campaign::real_machine(setup), table, seed + 1000);
}

/// Rows of every eighth pose along one axis, or along each in turn.
void spoil(records::ReadingTable& table, bool along_one) {
    int row = 0;
    for (records::Reading& r : table.rows) {
        if (r.device == records::Device::none) continue;
        const int pose = row / 3, along = row % 3;
        if (pose % 8 == 0 && along == (along_one ? 2 : pose / 8 % 3)) *r.value_mm += 0.04;
        ++row;
    }
}

}  // namespace

TEST_CASE("few poses leave much of the set-up open, which is no gap", "[diagnosis][judged]") {
    const setup::Setup setup = campaign::bc_setup();
    int loud = 0;
    for (unsigned seed = 1; seed <= 40; ++seed)
        if (diagnosed(setup, map_of(setup, 6, seed)).verdict != diagnosis::Verdict::no_gap) ++loud;
    CHECK(loud <= 1);
}

TEST_CASE("readings set aside along one direction are a gap", "[diagnosis][judged]") {
    const setup::Setup setup = campaign::bc_setup();
    const bool along_one = GENERATE(false, true);
    records::ReadingTable table = map_of(setup, 80, 3);
    spoil(table, along_one);
    const diagnosis::Diagnosis d = diagnosed(setup, table);
    INFO(said(d) << ", set aside " << d.outliers);
    CHECK((d.verdict == diagnosis::Verdict::no_gap) == !along_one);
}

}  // namespace trunnion
