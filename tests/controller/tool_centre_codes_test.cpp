// G43.4, G43.5 and M128 as programs command them.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "table_bench.h"

namespace trunnion {

using bench::TableBench;
using bench::xyz;

TEST_CASE("rotary words far beyond 360 keep every digit") {
    TableBench b;
    b.set_pivot({3, 4, 5}, {0.1, 0.2, -40});
    b.run("G54 G90 G0 X10. Y0 Z0 B20. C-145318.181");
    CHECK(deg_from_rad(b.last().to[Axis::C]) == Approx(-145318.181).epsilon(1e-15));
    CHECK(b.variable(5025) == Approx(-145318.181).epsilon(1e-15));
    TableBench near;  // the same angle within one turn
    near.set_pivot({3, 4, 5}, {0.1, 0.2, -40});
    b.run("B0 C0;G43.4 H1 X0 Y0 Z0;X50. Y20. Z5. B20. C-145318.181");
    near.run("G54 G90 G0 B0 C0;G43.4 H1 X0 Y0 Z0;X50. Y20. Z5. B20. C121.819");
    CHECK((xyz(b.last().to) - xyz(near.last().to)).norm() < 1e-9);
}

TEST_CASE("the start-up block of G43.4 only adds the tool length") {
    TableBench b;
    b.set_pivot({0, 0, 40}, {0, 0, -20});
    b.run("G90 G54 G0 B0 C0;G43.4 H1 X10. Y0 Z5. B30.");
    CHECK((xyz(b.last().to) - Vector3(10, 0, 125.25)).norm() < 1e-12);
    CHECK(b.last().curve == nullptr);
    // Then the tip is led on the table, B from where the programming frame was fixed (B0).
    b.run("X10. Y0 Z5.");
    CHECK((b.tip_W(b.last().to) - Vector3(10, 0, 5)).norm() < 1e-9);
}

TEST_CASE("G43.4 with the table turned: the frame as it lies, or the frame at rotary zero") {
    for (const positioning::TcpFrame frame :
         {positioning::TcpFrame::start, positioning::TcpFrame::rotary_zero}) {
        TableBench b;
        b.control.config.tcp_frame = frame;
        b.set_pivot({0, 0, 40}, {0, 0, -20});
        b.run("G90 G54 G0 X0 Y0 Z100. B30. C45.;G43.4 H1 X10. Y0 Z5.;X10. Y0 Z6.");
        const AxisPositions q = b.last().to;
        if (frame == positioning::TcpFrame::start)  // program axes lie along the machine until the
                                                    // table turns
            CHECK((xyz(q) - Vector3(10, 0, 126.25)).norm() < 1e-9);
        else
            CHECK((b.tip_W(q) - Vector3(10, 0, 6)).norm() < 1e-9);
    }
}

TEST_CASE("WKP: X Y Z are the end point after the table has turned") {
    TableBench b;
    b.stores.parameters.set_bit(19696, 5, true);
    b.control.parameters_changed();
    b.set_pivot({0, 0, 40}, {0, 0, -20});
    b.run("G90 G54 G0 B0 C0;G43.4 H1 X10. Y0 Z5.;X10. Y3. Z6. B30. C60.");
    CHECK((xyz(b.last().to) - Vector3(10, 3, 126.25)).norm() < 1e-9);
    CHECK(b.last().curve != nullptr);
    CHECK(b.alarm("G43.5 H1") == 5459);
}

TEST_CASE("TCP: feed counts along the tip, G93, rotaries alone, axis speed") {
    TableBench b;
    b.control.mover.axes.limits.seconds_per_unit.fill(0.0);
    b.set_pivot({0, 0, 40}, {0, 0, -20});
    b.run("G90 G54 G0 B0 C0;G43.4 H1 X100. Y0 Z5.;G1 X130. Y40. B60. C90. F600.");
    CHECK(b.last().length_mm == Approx(50.0));
    CHECK(b.last().duration_s == Approx(5.0));
    CHECK(b.last().feed_mm_min == Approx(600.0));
    b.run("G93 X100. Y0 F12.");
    CHECK(b.last().duration_s == Approx(5.0));
    b.run("G94 G1 C0 F600.");  // the tip stands on the work: RFC = 0, as fast as the axes may
    CHECK(b.last().length_mm == Approx(0.0).margin(1e-9));
    CHECK(b.last().duration_s == 0.0);
    b.stores.parameters.set_bit(19696, 6, true);
    b.run("G1 C90. F600.");  // RFC = 1: F is deg/min
    CHECK(b.last().duration_s == Approx(9.0));
    b.control.mover.axes.limits.seconds_per_unit[index_of(Axis::C)] = 60.0 / rad_from_deg(90.0);
    b.run("G1 X101. C180. F60000.");
    CHECK(b.last().duration_s == Approx(60.0));
}

TEST_CASE("TCP: an arc with standing rotaries is an arc of the axes, with turning ones a curve") {
    TableBench b;
    b.set_pivot({0, 0, 40}, {0, 0, -20});
    b.run("G90 G54 G17 G0 B0 C0;G43.4 H1 X20. Y0 Z0;X20. Y0 B30. C40.;G2 X0 Y-20. R20. F500.");
    REQUIRE(b.last().arc);
    CHECK(b.last().curve == nullptr);
    for (const double s : {0.25, 0.5, 0.75}) {
        const Vector3 tip = b.tip_W(b.last().at(s));
        CHECK((tip - Vector3(20 * std::cos(s * pi / 2), -20 * std::sin(s * pi / 2), 0)).norm() <
              1e-9);
    }
    CHECK(b.last().length_mm == Approx(10 * pi));
    struct Check : motion::MotionSink {
        motion::MoveResult move(const motion::AxisMove& m) override {
            for (const double s : {0.25, 0.5, 0.75}) {
                const Vector3 tip = m.transform->tip_W(m.at(s), m.tool_vector_mm);
                worst_mm = std::max(worst_mm, std::abs(tip.norm() - 20.0));
                curve = m.curve != nullptr;
            }
            return {};
        }
        double worst_mm = 0.0;
        bool curve = false;
    } check;
    offsets::Stores stores = b.stores;
    controller::Control control(b.control.config, stores, check);
    const auto run = [&](const char* text) {
        controller::execute_block(control, bench::words_of(text));
    };
    for (const char* text : {"G90 G54 G17 G0 B0 C0", "G43.4 H1 X20. Y0 Z0"}) run(text);
    check.worst_mm = 0.0;
    run("G3 X0 Y20. I-20. J0 B-20. C75. F500.");
    CHECK(check.curve);
    CHECK(check.worst_mm < 1e-9);
}

TEST_CASE("G43.5: tool axis by vector, keep, singular, lean, limits") {
    TableBench b;
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.run("G90 G54 G0 B0 C0;G43.5 H1 X10. Y0 Z5.;G1 X10. Y5. Z5. I1. J0 K1. F500.");
    AxisPositions q = b.last().to;
    CHECK((b.tip_W(q) - Vector3(10, 5, 5)).norm() < 1e-9);
    CHECK((b.belief().tool_direction_W(q) - Vector3(1, 0, 1).normalized()).norm() < 1e-12);
    CHECK(q[Axis::B] == Approx(pi / 4));
    b.run("X20.");  // no vector: the tool stays
    CHECK(b.last().to[Axis::B] == q[Axis::B]);
    b.run("I0 J1. K1.");  // the vector alone: the tip stays
    CHECK(b.last().length_mm < 1e-9);
    CHECK((b.tip_W(b.last().to) - Vector3(20, 5, 5)).norm() < 1e-9);
    const double c = b.last().to[Axis::C];
    b.run("K1.");  // the singular direction: C stays where it is
    CHECK(b.last().to[Axis::B] == Approx(0.0).margin(1e-12));
    CHECK(b.last().to[Axis::C] == c);
    CHECK(b.alarm("X0 B10.") == 5421);
    CHECK(b.alarm("X0 I0 J0 K0") == 5421);
    b.run("G49;G0 B0 C0;G43.5 H1 Q10. X0 Y0 Z5.;G1 X10. K1.");
    CHECK(b.last().to[Axis::B] == Approx(rad_from_deg(10)));  // leans towards +X
    b.run("G49");
    b.control.mover.axes.limits.min[index_of(Axis::B)] = 0;
    b.stores.parameters.set(19741, 120);
    b.stores.parameters.set(19742, -1);
    b.control.parameters_changed();
    b.run("G0 B0 C170.;G43.5 H1 X0 Y0;G1 X1. I-1. J-.2 K1.");
    CHECK(b.last().to[Axis::B] > 0);
    CHECK(b.alarm("I0 J1. K-1.") == 5421);  // 135 deg: out of travel
}

TEST_CASE("G43.5 with vector words in its start-up block turns the tool after it") {
    TableBench b;
    b.run("G90 G54 G0 B0 C0;G43.5 H1 X10. Y0 Z5. I1. K1.");
    CHECK(b.last().to[Axis::B] == Approx(pi / 4));
    CHECK((b.tip_W(b.last().to) - Vector3(10, 0, 5)).norm() < 1e-9);
}

TEST_CASE("G31 under G43.4 latches the programmed frame") {
    TableBench b;
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.run("G90 G54 G0 B0 C0;G43.4 H1 X10. Y0 Z50.;B30. C20.");
    b.sink.trigger_at = 0.25;
    b.run("G31 X10. Y0 Z10. F100.");
    CHECK(b.variable(5003) == Approx(40.0));
    CHECK(b.variable(5063) - b.variable(5083) == Approx(40.0));
    CHECK((b.tip_W(b.control.frames.axes) - Vector3(10, 0, 40)).norm() < 1e-9);
}

TEST_CASE("TCP inside a tilted plane keeps the plane's coordinates") {
    TableBench b;
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.run("G90 G54 G0 B0 C0;G68.2 X5. Y6. Z7. I90. J35. K-90.;G53.1;G43.4 H1 X0 Y0 Z10.");
    const Pose plane{rotation_about(Vector3::UnitY(), rad_from_deg(35)), Vector3(5, 6, 7)};
    b.run("X3. Y4. Z5. B50. C10.");
    CHECK((b.tip_W(b.last().to) - plane * Vector3(3, 4, 5)).norm() < 1e-9);
    b.run("G49");
    const AxisPositions stood = b.control.frames.axes;
    b.run("G69");
    CHECK(b.control.frames.axes == stood);
}

TEST_CASE("Hurco: M128 and M129, M126 and M127") {
    TableBench b;
    b.control.config.dialect = interpreter::hurco_dialect();
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.run("G90 G54 G0 G43 H1 X10. Y0 Z50. B30. C40.;M128;X10. Y5. Z20.");
    CHECK((b.tip_W(b.last().to) - Vector3(10, 5, 20)).norm() < 1e-9);
    CHECK(b.last().mode == PositioningMode::rtcp);
    const AxisPositions stood = b.control.frames.axes;
    b.run("M129");
    CHECK(b.control.frames.axes == stood);
    b.run("X10. Y5. Z20. B0 C0");
    CHECK((xyz(b.last().to) - Vector3(10, 5, 140.25)).norm() < 1e-9);
    b.run("C350.;M126;C10.");
    CHECK(deg_from_rad(b.control.frames.axes[Axis::C]) == Approx(370));
    b.run("M127;C0");
    CHECK(b.control.frames.axes[Axis::C] == Approx(0).margin(1e-12));
    TableBench fanuc;
    fanuc.run("G90 G54 M128");
    CHECK_FALSE(fanuc.control.frames.tip.in_force);
}

TEST_CASE("axes may not swing beyond their stroke on the way of the tip") {
    TableBench b;
    b.control.mover.axes.limits.max[index_of(Axis::Y)] = 40.0;
    b.run("G90 G54 G0 B0 C0;G43.4 H1 X50. Y0 Z0");
    CHECK(b.alarm("C-180.") == 500);  // both ends have Y0, half-way it is at 50
    b.run("C180.");
}

}  // namespace trunnion
