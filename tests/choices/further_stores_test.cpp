// Stores and bits that only some programs use: fixture offsets, the angle of G68, G68.3.
#include "choices/offset_words.h"
#include "tests/choices/log_bench.h"

namespace trunnion {

using choices::ControlGap;
using choices::GapVerdict;
using log_bench::gap_of;
using log_bench::log_of;
using log_bench::setup_of;

namespace {

setup::Setup trunnion_with(const std::string& more) {
    return setup_of(
        "[machine]\nname = \"m\"\nchain = \"w C A b Y X Z t\"\n"
        "[machine.axis.A]\ndirection = [-1, 0, 0]\npoint_mm = [0, 0, "
        "0]\n[machine.axis.C]\ndirection = [0, 0, -1]\npoint_mm = [0, 0, 0]\n"
        "[control]\ndialect = \"fanuc\"\ntools.1 = { length_mm = 80, diameter_mm = 6 }\n" +
        more);
}

const std::string on_fixture = R"(N10 G90 G21 G17 G54
N20 G0 A0. C0.
N30 G43 H1 Z120.
N40 G54.2 P2
N50 G0 A-30. C40.
N60 X10. Y5.
N70 G1 Z20. F300.
N80 X20. Y-4.
N90 G0 A-60. C130.
N100 X-7. Y3.
N110 G1 Z15. F300.
N120 X4. Y12.
N130 G54.2 P0
N140 G0 Z150.
N150 M30
)";

const char* fixture =
    "[control.fixture_offsets]\nP2 = { X = 1.5, Y = -2, Z = %, reference = { C = 0 } }\n";

std::string with_z(const std::string& z) {
    std::string text = fixture;
    return text.replace(text.find('%'), 1, z);
}

std::string cause_of(const setup::Setup& there, const setup::Setup& here,
                     const std::string& program) {
    const ControlGap gap = gap_of(here, log_of(there, program), program);
    CHECK(gap.verdict == GapVerdict::explained);
    return gap.causes.size() == 1 ? gap.causes[0].name : std::string();
}

}  // namespace

TEST_CASE("a stale fixture offset of G54.2 is found") {
    const ControlGap gap = gap_of(trunnion_with(with_z("0.75")),
                                  log_of(trunnion_with(with_z("0.83")), on_fixture), on_fixture);
    CHECK(gap.verdict == GapVerdict::explained);
    REQUIRE(gap.causes.size() == 1);
    CHECK(gap.causes[0].name == "G54.2P2");
    REQUIRE(gap.causes[0].numbers.size() == 1);
    CHECK(gap.causes[0].numbers[0].to == Approx(0.83).margin(1e-4));
    CHECK(choices::fixture_offset_words({log_bench::program_of(on_fixture)}) == std::set<int>{2});
}

TEST_CASE("how G54.2 follows a rotary word is found") {
    CHECK(cause_of(trunnion_with(with_z("0.75") + "[control.parameters]\n7570 = \"00000001\"\n"),
                   trunnion_with(with_z("0.75")), on_fixture) == "7570#0=1");
}

TEST_CASE("the angle of a G68 without R is found") {
    const std::string program = R"(N10 G90 G21 G17 G54
N20 G0 X5. Y5. Z50.
N30 G68 X10. Y5.
N40 X30. Y8.
N50 G1 Z2. F300.
N60 X12.
N70 Y40.
N80 X3. Y20.
N90 G0 Z50.
N100 G69
N110 M30
)";
    CHECK(cause_of(trunnion_with("[control.parameters]\n5410 = 12.5\n"), trunnion_with(""),
                   program) == "5410");
}

}  // namespace trunnion
