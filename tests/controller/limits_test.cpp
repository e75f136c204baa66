// The edges of the control: options, codes of the machine builder, numbers that are none.
#include <catch2/catch.hpp>

#include "controller/alarms.h"
#include "controller/block_trial.h"
#include "controller/m_codes.h"
#include "controller/surface_speed.h"
#include "parts.h"

namespace trunnion {

using bench::Bench;

TEST_CASE("the title of an alarm: its own prefix, MC for #3000, else PS") {
    CHECK(controller::alarm_title(3001, "DOOR") == "MC3001 DOOR");
    CHECK(controller::alarm_title(4999, "DOOR") == "MC4999 DOOR");
    CHECK(controller::alarm_title(5000, "DOOR") == "PS5000 DOOR");
    CHECK(controller::alarm_title(2999, "DOOR") == "PS2999 DOOR");
    CHECK(controller::alarm_title(999999, "DOOR") == "PS999999 DOOR");
    CHECK(controller::alarm_title(10, "TEXT") == "PS0010 TEXT");
    CHECK(controller::find_alarm(999999) == nullptr);
    for (const bool detail : {false, true}) {
        try {
            detail ? controller::raise_alarm(999999, "(MORE)", 3)
                   : controller::raise_alarm(999999, 3);
            FAIL("no alarm");
        } catch (const Alarm& alarm) {
            CHECK(alarm.text == (detail ? "ALARM (MORE)" : "ALARM"));
            CHECK(alarm.where.column == 3);
        }
    }
}

TEST_CASE("G33 is an option, needs F and a turning spindle, and F is its lead") {
    CHECK(Bench().alarm("G33 Z-10. F2.") == 10);
    controller::ControlConfig config = bench::five_axes();
    config.threading = true;
    CHECK(Bench(config).alarm("S500 M3;G33 Z-10.") == 11);
    CHECK(Bench(config).alarm("S500;G33 Z-10. F2.") == 11);
    CHECK(Bench(config).alarm("S0 M3;G33 Z-10. F2.") == 11);
    Bench b(config);
    b("S500 M3;G33 Z-10. F2.");
    CHECK(b.last().feed_mm_min == 1000.0);
    CHECK(b.last().to[Axis::Z] == -10.0);
}

TEST_CASE("codes and variables of the machine builder are known and move nothing") {
    controller::ControlConfig config = bench::five_axes();
    config.builder.add_g_code(3330);
    config.builder.m_codes = {777};
    config.builder.m_codes_after = {778};
    config.builder.variables = {{70000, 70009}};
    Bench b(config);
    b("G333 X10.;G4 X0;M777;M778");
    CHECK(b.sink.moves.empty());
    const std::vector<std::string>& notes = b.control.mover.record().notes;
    REQUIRE(notes.size() == 1);
    CHECK_THAT(notes[0], Catch::StartsWith("G333 (a code of the machine builder)"));
    CHECK(b.alarm("G334") == 10);
    b("G333 G1 X10. F100.");
    CHECK(b.sink.moves.size() == 1);
    b("D3;G333 D5000");  // its own D
    CHECK(b.control.modal.number.radius == 3);
    controller::ControlVariables variables(b.control);
    for (const int number : {70000, 70009, 900000, 999999}) {
        variables.set(number, number, "");
        CHECK(variables.get(number) == number);
    }
    for (const int number : {69999, 70010, 899999, 1000000})
        CHECK_THROWS_AS(variables.set(number, 1.0, ""), Alarm);
}

TEST_CASE("M codes that the control knows: calls, its table, clamps, the builder's, no others") {
    controller::ControlConfig config = bench::five_axes();
    config.builder.m_codes = {777};
    for (const int code : {98, 99, 198, 0, 3, 30, 777}) {
        INFO(code);
        CHECK(controller::knows_m(code, config));
    }
    for (const int code : {97, 100, 197, 199, 776, 778}) {
        INFO(code);
        CHECK_FALSE(controller::knows_m(code, config));
    }
}

TEST_CASE("a word that is no position has eight digits, with a point and without") {
    Bench b;
    CHECK(b.alarm("G1 F99999999 X1.") == 0);
    CHECK(b.alarm("G1 F100000000 X1.") == 3);
    CHECK(b.alarm("G1 F100000000. X1.") == 3);
    CHECK(b.alarm("S100000000") == 3);
    Bench increments;  // a number without a point is a count of increments
    increments.stores.parameters.set(3401, 0);
    increments.control.parameters_changed();
    CHECK(increments.alarm("G1 F99999999 X1") == 0);
    CHECK(increments.alarm("G1 F100000000 X1") == 3);
    CHECK(increments.alarm("G0 X999999999") != 3);
    CHECK(increments.alarm("G0 X1000000000") == 3);
}

TEST_CASE("reading #3000 and #3006 is an alarm, writing them is not") {
    const controller::ControlConfig config = bench::five_axes();
    for (const int number : {3000, 3006}) {
        CHECK(controller::variable_alarm(number, true, config, {}) == 0);
        CHECK(controller::variable_alarm(number, false, config, {}) == 115);
    }
    CHECK(controller::variable_alarm(5021, true, config, {}) == 116);
    CHECK(controller::variable_alarm(5021, false, config, {}) == 0);
}

TEST_CASE("a control without a program has no sequence number and no program number") {
    Bench b;
    CHECK(b.variable(4114) == 0.0);
    CHECK(b.variable(4115) == 0.0);
}

TEST_CASE("a rollover axis by sign goes the way of the sign, also when it stands beyond") {
    controller::ControlConfig config = bench::five_axes();
    Bench b(config);
    b.stores.parameters.entry[1008].by_axis[5] = 3;  // ROAx, RABx
    b.control.parameters_changed();
    const auto goes_to = [&](const std::string& block) {
        b(block);
        return deg_from_rad(b.last().to[Axis::C]);
    };
    CHECK(goes_to("G0 C90.") == Approx(90.0));
    CHECK(goes_to("G0 C30.") == Approx(390.0));
    CHECK(goes_to("G0 C-20.") == Approx(380.0));
    CHECK(goes_to("G0 C-30.") == Approx(30.0));
}

TEST_CASE("G89 leaves by feed to the initial level, or rapid from R on, by the option") {
    for (const bool all_the_way : {true, false}) {
        controller::ControlConfig config = bench::five_axes();
        config.g89_feeds_to_initial = all_the_way;
        Bench b(config);
        b("G0 Z50.;G89 X10. Z-5. R2. P100 F100.");
        CHECK(b.last().to[Axis::Z] == 50.0);
        CHECK((b.last().kind == motion::MotionKind::linear) == all_the_way);
    }
}

TEST_CASE("G87 with P dwells in the hole") {
    Bench b;
    b("G0 Z5.;M3 S100;G87 X10. Z-5. R-10. Q1. P500 F100.");
    CHECK(b.sink.dwells == std::vector<double>{0.5});
}

TEST_CASE("limits and speeds of parameters 1320, 1321 and 1420 count only when they make sense") {
    offsets::Parameters parameters;
    parameters.entry[1320].by_axis = {{1, 10.0}, {2, -10.0}, {4, 90.0}};
    parameters.entry[1321].by_axis = {{1, -10.0}, {2, 10.0}};
    parameters.entry[1420].by_axis = {{1, 6000.0}, {2, 0.0}};
    std::vector<controller::ControlAxis> axes = bench::five_axes().axes;
    axes[1].max = 5.0;
    controller::take_strokes(axes, parameters);
    CHECK(axes[0].max == 10.0);
    CHECK(axes[0].min == -10.0);
    CHECK(axes[0].rapid_speed == 100.0);
    CHECK_FALSE(axes[1].max);
    CHECK_FALSE(axes[1].min);
    CHECK_FALSE(axes[1].rapid_speed);
    CHECK_FALSE(axes[2].max);
    CHECK(*axes[3].max == Approx(pi / 2));
    CHECK_FALSE(axes[3].min);
}

TEST_CASE("an axis without a rapid speed takes no time of its own") {
    controller::ControlConfig config = bench::five_axes();
    config.axes[0].rapid_speed = 0.0;
    Bench b(config);
    b("G0 X10.");
    CHECK(b.last().duration_s == 0.0);
}

TEST_CASE("axes stand in the order of 1020; one that it does not name, and an auxiliary, behind") {
    offsets::Parameters parameters;
    parameters.entry[1020].by_axis = {{1, 'Z'}, {2, 'X'}};
    std::vector<controller::ControlAxis> axes = bench::five_axes().axes;
    axes[1].auxiliary = true;
    controller::sort_axes(axes, parameters);
    std::string order;
    for (const controller::ControlAxis& axis : axes) order += letter_of(axis.axis);
    CHECK(order == "ZXBCY");
    CHECK_FALSE(controller::decode_settings({}, controller::ControlConfig{}).has_rotary_axis);
    controller::ControlConfig one;
    one.axes.emplace_back();
    one.axes[0].rotary = true;
    CHECK(controller::decode_settings({}, one).has_rotary_axis);
    one.axes[0].auxiliary = true;
    CHECK_FALSE(controller::decode_settings({}, one).has_rotary_axis);
}

TEST_CASE("surface speed: the turns in force between the limits, through the centre as well") {
    Bench b;
    b("G0 X50.;G92 S1000;G96 P1 S100 M3;G95 G1 X0. F0.1");
    // From X50 to the radius where 1000 rpm are reached the time of a turn grows with the radius.
    const double at_limit = 100.0 / (2.0 * pi);  // mm: 2 pi r rpm = 100,000 mm/min at 1000 rpm
    const double mean_min =
        (0.001 * at_limit + 0.5 * 0.001 / at_limit * (2500.0 - at_limit * at_limit)) / 50.0;
    CHECK(b.last().duration_s == Approx(60.0 * mean_min * 50.0 / 0.1));
    const double out_s = b.last().duration_s;
    b("G1 X-50.");
    CHECK(b.last().duration_s == Approx(out_s));
    b("G1 Z-10.");
    CHECK(b.last().duration_s == Approx(60.0 * 10.0 / 0.1 * 50.0 * 0.001 / at_limit));
}

TEST_CASE("surface speed: G96 without a speed leaves the spindle as it turns") {
    Bench b;
    b("S500 M3;G0 X50.;G96 P1;G0 X10.");
    CHECK(b.control.modal.spindle.rpm == 500.0);
}

TEST_CASE("surface speed: a turn of B alone shows F times the turns of its radius") {
    Bench b;
    b("G0 X50.;G96 P1 S100 M3;G95 G1 X20. F0.1;G1 B30.");
    CHECK(b.last().length_mm == 0.0);
    CHECK(b.last().feed_mm_min == Approx(0.1 * 100e3 / (2.0 * pi * 20.0)));
}

TEST_CASE("a whole number of more than nine digits is alarm 3") {
    controller::SortedWords words;
    words.present = controller::SortedWords::bit('Q');
    words.value['Q' - 'A'] = 999999999.0;
    CHECK(words.whole('Q') == 999999999);
    words.value['Q' - 'A'] = 1000000000.0;
    CHECK_THROWS_AS(words.whole('Q'), Alarm);
}

}  // namespace trunnion
