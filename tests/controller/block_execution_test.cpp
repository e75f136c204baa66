#include <catch2/catch.hpp>

#include "block_bench.h"

namespace trunnion {

using bench::Bench;

TEST_CASE("a plain program moves the axes where it says") {
    Bench b;
    b("G21 G90 G17 G94 G40 G80;G54;G0 X10. Y-5. Z20.;G1 X11.5 F600.;B90. C-30.");
    REQUIRE(b.sink.moves.size() == 3);
    CHECK(b.sink.moves[0].kind == motion::MotionKind::rapid);
    CHECK(b.sink.moves[0].to[Axis::X] == 10.0);
    CHECK(b.sink.moves[0].feed_mm_min == 0.0);
    CHECK(b.sink.moves[1].kind == motion::MotionKind::linear);
    CHECK(b.sink.moves[1].to[Axis::X] == 11.5);
    CHECK(b.sink.moves[1].feed_mm_min == Approx(600.0));
    CHECK(b.sink.moves[1].duration_s == Approx(0.15));
    CHECK(b.last().to[Axis::B] == Approx(pi / 2));
    CHECK(b.variable(5001) == 11.5);
    CHECK(b.variable(5005) == -30.0);
}

TEST_CASE("incremental words add up and inch words are inches") {
    Bench b;
    b("G91 G0 X1.;X1. Y2.;G20 X1.");
    CHECK(b.variable(5021) * 25.4 == Approx(27.4));
    CHECK(b.last().to[Axis::X] == Approx(27.4));
    b("G21");
    CHECK(b.variable(5001) == Approx(27.4));
}

TEST_CASE("work offsets, G52, G92 and G53 shift what they should") {
    Bench b;
    b("G10 L2 P1 X100. Y10.;G10 L2 P0 Z5.;G54 G90 G0 X0. Y0. Z0.");
    CHECK(b.last().to[Axis::X] == 100.0);
    CHECK(b.last().to[Axis::Z] == 5.0);
    b("G52 X1.;X0.");
    CHECK(b.last().to[Axis::X] == 101.0);
    b("G52 X0.;G92 X50.;X50. Y1.");
    CHECK(b.last().to[Axis::X] == 101.0);
    b("G55 X50.");
    CHECK(b.last().to[Axis::X] == 1.0);  // G92 shifts G55 as well
    b("G53 X-3.");
    CHECK(b.last().to[Axis::X] == -3.0);
    CHECK(b.variable(5001) == Approx(46.0));
    b("G92.1 X0.");
    CHECK(b.variable(5001) == -3.0);
    b("G54.1 P7 G0 X2.");
    CHECK(b.last().to[Axis::X] == 2.0);
    CHECK(b.variable(4014) == Approx(54.1));
    CHECK(b.variable(4130) == 7.0);
}

TEST_CASE("arcs by centre and radius") {
    Bench b;
    b("G0 X10. Y0.;G3 X0. Y10. I-10. J0. F100.");
    CHECK(b.last().arc->centre_mm.isApprox(Vector3::Zero()));
    CHECK(b.last().arc->sweep_rad == Approx(pi / 2));
    CHECK(b.last().length_mm == Approx(10 * pi / 2));
    CHECK(b.last().at(0.5)[Axis::X] == Approx(10 * std::cos(pi / 4)));
    b("G2 I0. J-10.");
    CHECK(b.last().arc->sweep_rad == Approx(-2 * pi));
    b("G2 X10. Y0. R10.");
    CHECK(b.last().arc->centre_mm.norm() == Approx(0.0).margin(1e-12));
    b("G2 X0. Y10. R-10. Z3.");
    CHECK(b.last().arc->sweep_rad == Approx(-1.5 * pi));
    CHECK(b.last().to[Axis::Z] == 3.0);
    b("G18 G3 X10. Z13. I10.");
    CHECK(b.last().arc->normal == Vector3::UnitY());
    CHECK(b.alarm("G17 G2 X1. Y1. R0.5") == 20);
}

TEST_CASE("tool length moves the gauge point and is shown in 5043 and 5083") {
    Bench b;
    b("G10 L10 P1 R100.;G10 L11 P1 R0.5;G0 G43 H1 Z10.");
    CHECK(b.last().to[Axis::Z] == 110.5);
    CHECK(b.variable(5003) == 10.0);
    CHECK(b.variable(5043) == 110.5);
    CHECK(b.variable(5083) == 100.5);
    b("G49");
    CHECK(b.last().to[Axis::Z] == 10.0);
    b("G43;G91 G28 Z0.;G49");
    CHECK(b.last().to[Axis::Z] == 0.0);  // G49 at the reference position moves nothing
}

TEST_CASE("G31 latches the skip position or the end point") {
    Bench b;
    b("G10 L2 P1 X100.;G54 G0 X0.");
    b.sink.trigger_at = 0.25;
    b("G31 X8. F100.");
    CHECK(b.variable(5061) == Approx(2.0));
    CHECK(b.variable(5001) == Approx(2.0));
    b.sink.trigger_at = -1.0;
    b("G31 X8.");
    CHECK(b.variable(5061) == 8.0);
}

TEST_CASE("what the control does not know is an alarm with its column") {
    Bench b;
    try {
        b("G0 X1. G197.");
        FAIL("no alarm");
    } catch (const Alarm& alarm) {
        CHECK(alarm.number == 10);
        CHECK(alarm.text == "IMPROPER G-CODE");
        CHECK(alarm.where.column == 8);
    }
    CHECK(b.alarm("G0 A5.") == 9);
    CHECK(b.alarm("G1 X7.") == 11);
    b("M77;M77");
    CHECK(b.control.mover.record().notes.size() == 1);
    CHECK_THROWS_AS(controller::ControlVariables(b.control).set(3000, 5, "PROBE OPEN"), Alarm);
}

TEST_CASE("the last of two codes of one group counts, or alarms by 3403 bit 6") {
    Bench b;
    b("G90 G91 G0 X1.;X1.");
    CHECK(b.variable(5001) == 2.0);
    b.stores.parameters.set_bit(3403, 6, true);
    b.control.parameters_changed();
    CHECK(b.alarm("G90 G91 X1.") == 5074);
}

TEST_CASE("stroke limits stop the move before it starts") {
    controller::ControlConfig config = bench::five_axes();
    config.axes[0].max = 50.0;
    config.axes[0].min = -50.0;
    Bench b(config);
    CHECK(b.alarm("G0 X50.") == 0);
    CHECK(b.alarm("G0 X50.1") == 500);
    CHECK(b.alarm("G0 X-50.1") == 501);
    CHECK(b.variable(5021) == 50.0);
}

TEST_CASE("the first number without a point is noted, whichever word of its block it is") {
    for (const char* block : {"G0 X1. Y100", "G0 X100 Y1.", "G0 Y100", "G0 X0 C90"}) {
        Bench b;
        b(block);
        INFO(block);
        CHECK(b.control.mover.record().cautions.notes().size() == 1);
        b("Z50");
        CHECK(b.control.mover.record().cautions.notes().size() == 1);
    }
    Bench b;
    b("G0 X0 Y0.;X1. Z-3.5");  // 0 is 0 in every unit
    CHECK(b.control.mover.record().cautions.notes().empty());
}

}  // namespace trunnion
