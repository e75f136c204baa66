// A long log without numbers of blocks beside curves of many points.
#include "base/units.h"
#include "tests/choices/sampled_log.h"

namespace trunnion {

TEST_CASE("a long log without numbers beside long curves is compared coarsely, and says so") {
    std::string program = "N10 G21 G90 G17 G54\nN20 G1 X40. Y0. Z1. F600\n";
    log_bench::SampledLog log({0, 0, 0});
    constexpr double shift = 0.05;
    constexpr int circles = 40, parts = 110;
    log.to(0, {40 + shift, 0, 1}, 1.0);
    for (int k = 1; k <= circles; ++k) {
        const double radius = 20.0 + k / 4.0;
        program +=
            "G2 I-" + std::to_string(radius) + " J0.\nG1 Z" + std::to_string(1 - k - 1) + ".\n";
        for (int part = 1; part <= parts; ++part) {
            const double a = 2.0 * pi * part / parts;
            log.add(0, {40 + shift - radius + radius * std::cos(a), -radius * std::sin(a),
                        k == 1 ? 1.0 : 1.0 - k});
        }
        log.add(0, {40 + shift, 0, -1.0 * k});
    }
    program += "M30\n";
    log.log.blocks = records::BlockColumn::none;
    const auto gap =
        log_bench::gap_of(log_bench::mill_of("work_offsets.G54 = { X = 0.0 }\n"), log.log, program);
    CHECK(log_bench::has_note(gap, "rows without numbers of blocks beside a path of"));
    REQUIRE(!gap.causes.empty());
    CHECK(gap.causes[0].name == "G54");
    REQUIRE(gap.causes[0].numbers.size() == 1);
    CHECK(gap.causes[0].numbers[0].to == Approx(shift).margin(0.002));
}

}  // namespace trunnion
