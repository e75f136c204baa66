// G68.2-G68.4, G53.1, G53.6 and G69 as programs command them.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "table_bench.h"

namespace trunnion {

using bench::Bench;
using bench::TableBench;
using bench::xyz;

TEST_CASE("13 indexations of a BC machine, each reached from its Euler angles") {
    int reached = 0;
    std::vector<std::pair<double, double>> indexations{{0, 0}};
    for (const double tilt : {90.0, -90.0})
        for (double c = 0; c < 360; c += 60) indexations.emplace_back(tilt, c);
    for (const auto& [tilt, c] : indexations) {
        TableBench b;
        b.run(fmt::format("G54 G90 G0 B0 C0;G68.2 X0 Y0 Z0 I{} J{} K-90.;G53.1 P{}", c + 90.0, tilt,
                          tilt < 0 ? 2 : 1));
        const AxisPositions q = b.control.frames.axes;
        CHECK(std::abs(std::remainder(deg_from_rad(q[Axis::B]) - tilt, 360)) < 1e-9);
        CHECK(std::abs(std::remainder(deg_from_rad(q[Axis::C]) - c, 360)) < 1e-9);
        // Without P: whichever branch is nearer, the tool stands along the same direction.
        TableBench nearest;
        nearest.run(
            fmt::format("G54 G90 G0 B0 C0;G68.2 X0 Y0 Z0 I{} J{} K-90.;G53.1", c + 90.0, tilt));
        const Vector3 n = nearest.belief().tool_direction_W(nearest.control.frames.axes);
        reached += n.cross(b.belief().tool_direction_W(q)).norm() < 1e-12 &&
                   n.dot(b.belief().tool_direction_W(q)) > 0;
    }
    CHECK(reached == 13);
    CHECK(indexations.size() == 13);
}

TEST_CASE("both solutions of G53.1 stand in the notes") {
    TableBench b;
    b.run("G54 G90 G0;G68.2 X0 Y0 Z0 I120. J40. K-90.;G53.1");
    REQUIRE(b.control.mover.record().notes.size() == 1);
    CHECK(b.control.mover.record().notes[0].find(
              "B40.0000 C30.0000, other solution B-40.0000 C-150.0000") != std::string::npos);
}

TEST_CASE("arcs, G52, G91 and G31 count along the tilted plane") {
    TableBench b;
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.set_g54({30, -10, 15});
    b.run("G90 G17 G54 G0 B0 C0;G43 H1;G68.2 X5. Y6. Z7. I90. J35. K-90.;G53.1;X20. Y0 Z1.");
    const Pose plane{rotation_about(Vector3::UnitY(), rad_from_deg(35)), Vector3(5, 6, 7)};
    const auto tip = [&] { return Vector3(b.tip_W(b.control.frames.axes) - Vector3(30, -10, 15)); };
    CHECK((tip() - plane * Vector3(20, 0, 1)).norm() < 1e-9);
    b.run("G3 X0 Y20. I-20. J0 F400.");
    REQUIRE(b.last().arc);
    for (const double s : {0.3, 0.6}) {
        const Vector3 on = plane.inverse() * (b.tip_W(b.last().at(s)) - Vector3(30, -10, 15));
        CHECK((on - Vector3(20 * std::cos(s * pi / 2), 20 * std::sin(s * pi / 2), 1)).norm() <
              1e-9);
    }
    CHECK((tip() - plane * Vector3(0, 20, 1)).norm() < 1e-9);
    b.run("G91 G1 Z4.;G90 G52 X1. Z2.;G0 X0 Y0 Z0");
    CHECK((tip() - plane * Vector3(1, 0, 2)).norm() < 1e-9);
    b.run("G52 X0 Z0;G0 X0 Y0 Z50.");
    b.sink.trigger_at = 0.5;
    b.run("G31 Z0 F100.");
    CHECK(b.variable(5063) - b.variable(5083) == Approx(25.0));
    CHECK((tip() - plane * Vector3(0, 0, 25)).norm() < 1e-9);
    b.sink.trigger_at = -1;
    b.run("G49;G69;G0 X0 Y0 Z0 B0 C0");
    CHECK((xyz(b.last().to) - Vector3(30, -10, 15)).norm() < 1e-12);
    CHECK(b.control.frames.mode(b.control.modal.settings) == PositioningMode::dpp);
}

TEST_CASE("G68.2 inside G52, G68.4 on top, G69 restores") {
    TableBench b;
    b.run("G90 G54 G0 B0 C0;G52 X10.;G68.2 X5. Y0 Z0 I0 J0 K0;G0 X1. Y0 Z0");
    CHECK((xyz(b.last().to) - Vector3(16, 0, 0)).norm() < 1e-12);
    b.run("G52 X100.;G68.4 P1 X0 Y0 Z0 I0 J0 K90.;X0 Y0 Z0;Y3.");
    b.run("G69;X0 Y0 Z0");
    CHECK((xyz(b.last().to) - Vector3(10, 0, 0)).norm() < 1e-12);
    CHECK(b.control.modal.is(controller::ModalGroup::rotation, 690));
}

TEST_CASE("G68.3 takes the plane from the tool as it stands") {
    TableBench b;
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.run("G90 G54 G0 G43 H1 X10. Y20. Z100. B30. C40.;G68.3 R0");
    CHECK(std::abs(b.variable(5001)) + std::abs(b.variable(5002)) + std::abs(b.variable(5003)) <
          1e-9);
    const Vector3 before = b.tip_W(b.control.frames.axes);
    const Vector3 n = b.belief().tool_direction_W(b.control.frames.axes);
    const std::size_t moves = b.sink.moves.size();
    b.run("G53.1");
    CHECK(b.sink.moves.size() == moves);
    b.run("G0 Z7.");
    CHECK((b.tip_W(b.last().to) - before - 7 * n).norm() < 1e-9);
}

TEST_CASE("G53.6 keeps the tip on the work, G53.1 moves the rotaries only") {
    TableBench b;
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.run("G90 G54 G0 B0 C0 G43 H1 X10. Y20. Z30.;G68.2 X0 Y0 Z0 I90. J35. K-90.");
    const AxisPositions before = b.control.frames.axes;
    b.run("G53.6 H1");
    CHECK((b.tip_W(b.last().to) - b.tip_W(before)).norm() < 1e-9);
    CHECK(b.last().to[Axis::B] == Approx(rad_from_deg(35)));
    TableBench plain;
    plain.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    plain.run("G90 G54 G0 B0 C0 G43 H1 X10. Y20. Z30.;G68.2 X0 Y0 Z0 I90. J35. K-90.;G53.1");
    CHECK(xyz(plain.last().to) == xyz(before));
    CHECK(plain.last().to[Axis::B] == Approx(rad_from_deg(35)));
}

TEST_CASE("a tilted plane works on three axes too") {
    Bench b;
    b.stores.parameters.set(3401, 1);
    b.control.parameters_changed();
    b("G90 G54 G0 X0 Y0 Z0;G68.2 X1. Y0 Z0 I0 J90. K0;X0 Y5. Z0");
    CHECK((xyz(b.last().to) - Vector3(1, 0, 5)).norm() < 1e-12);
    CHECK(b.alarm("G53.1") == 5458);
    b("G69");
    CHECK(b.alarm("G43.4 H1") == 5420);
}

TEST_CASE("alarms of five-axis functions") {
    const auto alarm = [](const std::string& text) {
        TableBench b;
        return b.alarm("G90 G54 G0;" + text);
    };
    CHECK(alarm("G53.1") == 5458);
    CHECK(alarm("G53.6") == 5458);
    CHECK(alarm("G68.2 X0 Y0 Z0 I0 J10. K0;G53.1 P3") == 5458);
    CHECK(alarm("G68.2 X0 Y0 Z0") == 5457);
    CHECK(alarm("G68.2 X0 Y0 Z0 I0 J10. K0;G68.2 X0 Y0 Z0 I0 J10. K0") == 5456);
    CHECK(alarm("G68.4 X0 Y0 Z0 I0 J10. K0") == 5457);
    CHECK(alarm("G68.2 P2 Q1 X0 Y0 Z0;G0 X1.") == 5457);
    CHECK(alarm("G68.2 P2 Q1 X0 Y0 Z0;G68.2 P2 Q2 X1. Y0 Z0;G68.2 P2 Q3 X1. Y1. Z0;G0 X1.") == 0);
    CHECK(alarm("G43.4 H1;G55") == 5421);
    CHECK(alarm("G43.4 H1;G68.2 X0 Y0 Z0 I0 J10. K0") == 5421);
    CHECK(alarm("G43.4 H1;G1 X1. I1. F100.") == 5421);
    CHECK(alarm("G43.4 H1;G54.2 P1") == 5421);
    CHECK(alarm("G54.2 P1;G43.4 H1") == 5421);
    CHECK(alarm("G68.2 X0 Y0 Z0 I0 J10. K0;G43.4 H1;G69") == 5421);
    CHECK(alarm("G68.2 X0 Y0 Z0 I0 J10. K0;G43.4 H1;G49;G69") == 0);
    TableBench b;
    b.stores.parameters.set(19682, 9);
    b.control.parameters_changed();
    CHECK(b.alarm("G43.4 H1") == 5459);
    CHECK(b.alarm("G68.2 X0 Y0 Z0 I0 J10. K0") == 5459);
}

TEST_CASE("#5081 shows the tool length, not the swing of a head") {
    TableBench b;
    offsets::Parameters& p = b.stores.parameters;
    p.set(19680, 2);
    p.set(19709, 12.0);
    p.set(19711, 200.0);
    b.control.parameters_changed();
    b.run("G90 G54 G0 B0 C0;G68.2 X0 Y0 Z0 I90. J20. K-90.;G53.1;G43 H1 X1. Y2. Z3.");
    CHECK((b.tip_W(b.last().to) -
           rotation_about(Vector3::UnitY(), rad_from_deg(20)) * Vector3(1, 2, 3))
              .norm() < 1e-9);
    CHECK(b.variable(5081) == 0.0);
    CHECK(b.variable(5083) == 120.25);
    CHECK(b.variable(5043) == Approx(123.25));
}

TEST_CASE("a program that indexes often has 200 notes of it, no more") {
    TableBench b;
    b.run("G54 G90 G0");
    for (int k = 0; k < 210; ++k) {
        b.run(fmt::format("G69;G68.2 X0 Y0 Z0 I{}. J40. K-90.;G53.1", k));
        CHECK(b.control.mover.record().notes.size() ==
              static_cast<std::size_t>(std::min(k + 1, 200)));
    }
}

}  // namespace trunnion
