// Which readings share the error of a pose: one visit, not the same place taken again.
#include <catch2/catch.hpp>

#include "diagnosis/noise.h"
#include "tests/support/campaign.h"

namespace trunnion {
namespace {

struct Visits {
    setup::Setup setup = campaign::bc_setup();
    records::ReadingTable table = campaign::empty_table(setup);

    /// Nine touches in nine directions with the table at C, two seconds apart.
    void nine_touches(double c_rad, double begin_s) {
        for (int k = 0; k < 9; ++k) {
            records::Reading row;
            row.test = "map";
            row.feature = "S1";
            row.device = records::Device::touch;
            row.commanded[Axis::C] = c_rad;
            row.time_s = begin_s + 2.0 * k;
            const double turn = 2.0 * pi * k / 9.0;
            row.direction_M = Vector3(std::cos(turn), std::sin(turn), 0.0);
            row.value_mm = 0.0;
            table.rows.push_back(row);
        }
    }
    void turn_to(double c_rad, double time_s) {
        records::Reading row;
        row.test = "map";
        row.commanded[Axis::C] = c_rad;
        row.time_s = time_s;
        table.rows.push_back(row);
    }
    std::vector<std::size_t> sizes() const {
        const emulator::Replay replay(setup, table);
        std::vector<std::size_t> list;
        for (const diagnosis::NoiseBlock& b : diagnosis::noise_blocks(replay, table))
            list.push_back(b.rows.size());
        return list;
    }
};

}  // namespace

TEST_CASE("a pose that is left and taken again is another visit", "[diagnosis]") {
    Visits v;
    v.turn_to(0.9, 0.0);
    v.nine_touches(1.0, 10.0);
    v.turn_to(1.1, 30.0);
    v.nine_touches(1.0, 40.0);
    CHECK(v.sizes() == std::vector<std::size_t>{9, 9});
}

TEST_CASE("a sphere measured again after a pause is another visit", "[diagnosis]") {
    Visits v;
    for (int k = 0; k < 7; ++k) v.nine_touches(0.0, 600.0 * k);
    CHECK(v.sizes() == std::vector<std::size_t>(7, 9));
}

TEST_CASE("touches of one visit stay together", "[diagnosis]") {
    Visits v;
    v.nine_touches(1.0, 0.0);
    v.nine_touches(1.0, 19.0);  // each direction twice, without a pause
    CHECK(v.sizes() == std::vector<std::size_t>{18});
    Visits rounded;  // a program's rounding of an angle is no motion
    rounded.nine_touches(1.0, 0.0);
    for (std::size_t k = 1; k < 9; ++k) rounded.table.rows[k].commanded[Axis::C] += 1e-12;
    CHECK(rounded.sizes() == std::vector<std::size_t>{9});
}

}  // namespace trunnion
