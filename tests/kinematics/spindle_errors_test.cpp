// Errors of the spindle after ISO 230-7 against closed forms.
#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "kinematics/forward.h"

using namespace trunnion;

namespace {

kinematics::Machine mill() {
    kinematics::Machine machine;
    machine.chain = kinematics::parse_chain("w Y X b Z t");
    kinematics::AxisErrors& spindle = machine.errors.spindle;
    spindle.motion[0] = {0.002, 0.0, 0.0, {{1.0, 0.010, 0.004}}, {}, {}};  // EXS
    spindle.motion[1] = {0.0, 0.0, 0.0, {{1.0, -0.004, 0.010}}, {}, {}};   // EYS
    spindle.motion[2] = {0.003, 0.0, 0.0, {{2.0, 0.001, 0.0}}, {}, {}};    // EZS
    spindle.motion[3] = {0.0, 0.0, 0.0, {{1.0, 2e-5, 0.0}}, {}, {}};       // EAS
    spindle.motion[4] = {1e-5, 0.0, 0.0, {{1.0, 0.0, 2e-5}}, {}, {}};      // EBS
    return machine;
}

}  // namespace

TEST_CASE("error motions of the spindle move the tip by its angle") {
    const kinematics::Machine machine = mill();
    const kinematics::ForwardModel model(machine);
    const double length_mm = 150.0;
    for (const double angle : {0.0, 0.7, pi, 4.0}) {
        const double c = std::cos(angle), s = std::sin(angle);
        const double ea = 2e-5 * c, eb = 1e-5 + 2e-5 * s;
        // A tilt about + X takes the tip, which hangs down, towards + Y; about + Y towards - X.
        const Vector3 closed(0.002 + 0.010 * c + 0.004 * s - length_mm * eb,
                             -0.004 * c + 0.010 * s + length_mm * ea,
                             0.003 + 0.001 * std::cos(2.0 * angle) +
                                 0.5 * length_mm * (ea * ea + eb * eb) - length_mm);
        const Vector3 tip = machine.tip_W({}, Vector3(0, 0, -length_mm), angle);
        CHECK((tip - closed).norm() < 1e-9);
        CHECK(model.tip_W({}, Vector3(0, 0, -length_mm), angle) == tip);
    }
}

TEST_CASE("of a turning spindle the constants remain") {
    const kinematics::Machine machine = mill();
    const Vector3 tip(0, 0, -150);
    const Vector3 turning = machine.tip_W({}, tip, std::nullopt);
    CHECK((turning - Vector3(0.002 - 150.0 * 1e-5, 0, -149.997)).norm() < 1e-7);
    Vector3 mean = Vector3::Zero();
    for (int i = 0; i < 36; ++i) mean += machine.tip_W({}, tip, i * pi / 18.0) / 36.0;
    CHECK((turning - mean).norm() < 1e-7);  // second order of the tilts
}

TEST_CASE("the location of the spindle's axis carries its motions") {
    kinematics::Machine machine = mill();
    machine.errors.spindle.location = {0.01, 0.02, 0.03, 0.001, 0.0, 0.0};
    const Vector3 tip(0, 0, -150);
    kinematics::Machine motion = mill();
    const Vector3 moved = motion.tip_W({}, tip, 0.7);
    const Vector3 closed = rotation_about(Vector3::UnitX(), 0.001) * moved + Vector3(.01, .02, .03);
    CHECK((machine.tip_W({}, tip, 0.7) - closed).norm() < 1e-12);
}

TEST_CASE("names of the spindle's errors") {
    for (const char* name : {"EXS", "EYS", "EZS", "EAS", "EBS", "EX0S", "EY0S", "EA0S", "EB0S"}) {
        INFO(name);
        const auto parsed = kinematics::parse_spindle_error_name(name);
        REQUIRE(parsed);
        CHECK(to_string(*parsed) == name);
    }
    for (const char* name : {"ECS", "EC0S", "EXX", "EX1S", "XS", "EQS", "EX0SS"})
        CHECK_FALSE(kinematics::parse_spindle_error_name(name));
}
