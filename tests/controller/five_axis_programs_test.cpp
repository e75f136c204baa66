// Cycles, cutter compensation and probing inside a tilted plane: the plane is only a frame.
#include <catch2/catch.hpp>

#include "block_bench.h"
#include "tests/support/table_parameters.h"

namespace trunnion {

using bench::Bench;

namespace {

/// The same moves flat and in a plane tilted by 35 deg on a BC table, as tips in the plane's frame.
std::vector<Vector3> tips(bool tilted, const std::string& body, int* alarm) {
    Bench b;
    offsets::Parameters& p = b.stores.parameters;
    testing::set_two_table_axes(p, 2);
    p.set(19700, 12.0);
    p.set(19702, -45.0);
    p.set(19705, -30.0);
    p.set(3401, 1);
    b.control.parameters_changed();
    b.stores.tools.tool[1].length_geometry_mm = 80.0;
    b.stores.tools.tool[2].radius_geometry_mm = 5.0;
    b("G90 G21 G17 G54 G0 X0 Y0 Z0 B0 C0");
    Pose plane;
    if (tilted) {
        b("G68.2 X5. Y6. Z7. I100. J35. K-90.;G53.1");
        plane.rotation = rotation_about(Vector3::UnitZ(), rad_from_deg(10)) *
                         rotation_about(Vector3::UnitY(), rad_from_deg(35));
        plane.translation_mm = {5, 6, 7};
    }
    b("G43 H1 X0 Y0 Z50.");
    b.sink.moves.clear();
    *alarm = b.alarm(body);
    std::vector<Vector3> out;
    for (const motion::AxisMove& m : b.sink.moves)
        for (const double s : {0.5, 1.0})
            out.push_back(plane.inverse() *
                          b.control.frames.believed.transform->tip_W(m.at(s), m.tool_vector_mm));
    return out;
}

void check_same(const std::string& body) {
    INFO(body);
    int flat_alarm = 0, tilted_alarm = 0;
    const auto flat = tips(false, body, &flat_alarm), tilted = tips(true, body, &tilted_alarm);
    CHECK(flat_alarm == 0);
    CHECK(tilted_alarm == 0);
    REQUIRE(flat.size() == tilted.size());
    CHECK(flat.size() >= 4);
    for (std::size_t i = 0; i < flat.size(); ++i) CHECK((flat[i] - tilted[i]).norm() < 1e-9);
}

}  // namespace

TEST_CASE("canned cycles drill along the plane's normal") {
    check_same("G99 G83 X10. Y5. Z-20. R2. Q6. F200.;X20.;G98 Y15.;G80");
    check_same("G98 G81 X1. Y2. Z-5. R3. F100.;G91 X5.;G90 G80 X0 Y0");
    check_same("G76 X10. Y5. Z-20. R2. Q0.5 P100 F200.;G80;G0 X0");
}

TEST_CASE("cutter compensation works in the plane") {
    check_same(
        "G0 X-20. Y-20. Z-2.;G41 D2 G1 X0 Y0 F300.;X40.;Y30.;G3 X30. Y40. R10.;G1 X0;Y0;G40 X-20. "
        "Y-20.");
    check_same(
        "G0 X-20. Y-20.;G42 D2 G1 X0 Y0 F300.;Y40.;X40. Y50.;G2 X60. Y30. R20.;G1 Y0;X0;G40 G0 "
        "X-20. "
        "Y-20.");
}

TEST_CASE("arcs, helices and polar words work in the plane") {
    check_same("G1 X20. Y0 F500.;G3 X0 Y20. Z40. I-20. J0;G2 I5. J0;G18 G2 X10. Z50. R30.;G17");
    check_same("G16 G1 X30. Y45. F500.;Y90.;G15;X10. Y10.;G2 X20. Y20. R10.;X0 Y0");
}

}  // namespace trunnion
