// G68.2 P0-P4 and G68.3: the frames their words define.
#include "positioning/tilted_plane.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "tests/support/alarm_of.h"

namespace trunnion {

namespace {

constexpr double deg = pi / 180.0;

positioning::PlaneWords angles(double i, double j, double k) {
    positioning::PlaneWords w;
    w.i = i;
    w.j = j;
    w.k = k;
    return w;
}

positioning::PlaneWords block(double p, double q) {
    positioning::PlaneWords w;
    w.p = p;
    w.q = q;
    return w;
}

positioning::PlaneWords point(double q, double x, double y, double z) {
    positioning::PlaneWords w = block(2, q);
    w.x = x;
    w.y = y;
    w.z = z;
    return w;
}

Pose complete(const positioning::PlaneWords& w) {
    return *positioning::PlaneDefinition().add(w);
}

}  // namespace

TEST_CASE("G68.2 P0 Euler angles about moved axes") {
    const Pose frame = complete(angles(30, 50, 70));
    const Matrix3 expected = rotation_about(Vector3::UnitZ(), 30 * deg) *
                             rotation_about(Vector3::UnitX(), 50 * deg) *
                             rotation_about(Vector3::UnitZ(), 70 * deg);
    CHECK((frame.rotation - expected).norm() < 1e-15);
    positioning::PlaneWords w = angles(30, 50, 70);
    w.q = 232;
    CHECK((complete(w).rotation - rotation_about(Vector3::UnitY(), 30 * deg) *
                                      rotation_about(Vector3::UnitZ(), 50 * deg) *
                                      rotation_about(Vector3::UnitY(), 70 * deg))
              .norm() < 1e-15);
    w = angles(0, 90, 0);
    w.x = 5;
    w.z = -2;
    w.r = 90;
    const Pose shifted = complete(w);
    CHECK(shifted.translation_mm == Vector3(5, 0, -2));
    CHECK((shifted.rotation.col(0) - Vector3::UnitZ()).norm() < 1e-15);
}

TEST_CASE("G68.2 P1 roll, pitch, yaw about the work frame's axes") {
    const Matrix3 x = rotation_about(Vector3::UnitX(), 10 * deg);
    const Matrix3 y = rotation_about(Vector3::UnitY(), 20 * deg);
    const Matrix3 z = rotation_about(Vector3::UnitZ(), 30 * deg);
    positioning::PlaneWords w = angles(10, 20, 30);
    w.p = 1;
    CHECK((complete(w).rotation - z * y * x).norm() < 1e-15);
    w.q = 312;  // about Z first, then X, then Y; I stays the angle about X
    CHECK((complete(w).rotation - y * x * z).norm() < 1e-15);
    for (const double twice : {313.0, 113.0, 133.0, 111.0, 112.0, 211.0, 412.0, 102.0}) {
        INFO(twice);
        w.q = twice;
        CHECK(alarm_of([&] { complete(w); }) == 5457);
    }
}

TEST_CASE("G68.2 P2 three points and P3 two vectors") {
    positioning::PlaneDefinition plane;
    positioning::PlaneWords shift = block(2, 0);
    shift.x = 1;
    shift.y = 2;
    shift.z = 3;
    shift.r = 90;
    CHECK_FALSE(plane.add(shift));
    CHECK(plane.pending());
    CHECK_FALSE(plane.add(point(1, 10, 0, 0)));
    CHECK_FALSE(plane.add(point(3, 10, 0, 7)));
    const auto frame = plane.add(point(2, 10, 5, 0));  // x = +Y, y = +Z, z = +X of the work
    REQUIRE(frame);
    CHECK_FALSE(plane.pending());
    CHECK((frame->translation_mm - Vector3(13, 1, 2)).norm() < 1e-14);
    CHECK((frame->rotation.col(0) - Vector3::UnitZ()).norm() < 1e-15);
    CHECK((frame->rotation.col(2) - Vector3::UnitX()).norm() < 1e-15);

    const auto vector = [](double q, double i, double j, double k) {
        positioning::PlaneWords w = angles(i, j, k);
        w.p = 3;
        w.q = q;
        return w;
    };
    positioning::PlaneWords origin = vector(1, 0, 2, 0);
    origin.x = 4;
    REQUIRE_FALSE(plane.add(origin));
    const auto made = plane.add(vector(2, 1, 0.05, 0));  // 2.9 deg off square: made square
    REQUIRE(made);
    CHECK(made->translation_mm == Vector3(4, 0, 0));
    CHECK((made->rotation.col(0) - Vector3::UnitY()).norm() < 1e-15);
    CHECK((made->rotation.col(2) - Vector3::UnitX()).norm() < 1e-15);
    CHECK(alarm_of([&] {
              positioning::PlaneDefinition crooked;
              crooked.add(origin);
              crooked.add(vector(2, 1, 0.09, 0));
          }) == 5457);
}

TEST_CASE("G68.2 P4 projection angles") {
    positioning::PlaneWords w = angles(30, 20, 0);
    w.p = 4;
    const Pose frame = complete(w);
    const Vector3 x = frame.rotation.col(0), z = frame.rotation.col(2);
    CHECK((x - Vector3(std::cos(30 * deg), 0, -std::sin(30 * deg))).norm() < 1e-15);
    CHECK(z.dot(Vector3(0, std::cos(20 * deg), std::sin(20 * deg))) == Approx(0).margin(1e-15));
    CHECK(frame.rotation.determinant() == Approx(1.0));
    CHECK((frame.rotation * frame.rotation.transpose()).isIdentity(1e-14));
}

TEST_CASE("G68.2 format errors are alarm 5457") {
    const auto alarm = [](const positioning::PlaneWords& w) {
        return alarm_of([&] { positioning::PlaneDefinition().add(w); });
    };
    CHECK(alarm(positioning::PlaneWords{}) == 5457);  // no angle at all
    CHECK(alarm(block(5, 1)) == 5457);
    CHECK(alarm(block(2.5, 1)) == 5457);
    positioning::PlaneWords w = block(2, 1);
    CHECK(alarm(w) == 5457);  // a point without X Y Z
    w.q.reset();
    CHECK(alarm(w) == 5457);
    CHECK(alarm(block(2, 4)) == 5457);
    CHECK(alarm(block(3, 1)) == 5457);  // no vector
    const auto points = [](Vector3 second, Vector3 third) {
        return alarm_of([&] {
            positioning::PlaneDefinition plane;
            plane.add(point(1, 1, 1, 1));
            plane.add(point(2, second.x(), second.y(), second.z()));
            plane.add(point(3, third.x(), third.y(), third.z()));
        });
    };
    CHECK(points({2, 2, 2}, {3, 3, 3}) == 5457);
    CHECK(points({1, 1, 1}, {3, 3, 4}) == 5457);
    CHECK(points({2, 2, 2}, {3, 3, 4}) == 0);
    CHECK(alarm_of([] {
              positioning::PlaneDefinition plane;
              plane.add(point(1, 0, 0, 0));
              plane.add(point(1, 0, 0, 0));
          }) == 5457);
    CHECK(alarm_of([] {
              positioning::PlaneDefinition plane;
              plane.add(point(1, 0, 0, 0));
              plane.add(angles(0, 0, 0));
          }) == 5457);
}

TEST_CASE("a format error tells the address and what is wrong") {
    const auto fault = [](std::vector<positioning::PlaneWords> blocks) {
        try {
            positioning::PlaneDefinition plane;
            for (const positioning::PlaneWords& w : blocks) plane.add(w);
        } catch (const positioning::PlaneFormatError& error) {
            CHECK(error.text == positioning::plane_format_error_text);
            return std::string(1, error.letter == 0 ? '-' : error.letter) + " " +
                   error.what_is_wrong;
        }
        return std::string();
    };
    positioning::PlaneWords no_q = block(2, 1);
    no_q.q.reset();
    CHECK(fault({positioning::PlaneWords{}}) == "- I, J and K are missing");
    CHECK(fault({block(5, 1)}) == "P P is 0 to 4");
    CHECK(fault({block(2.5, 1)}) == "P P is a whole number");
    CHECK(fault({block(2, 1)}) == "- a point needs X, Y and Z");
    CHECK(fault({no_q}) == "- Q is missing");
    CHECK(fault({block(2, 4)}) == "Q Q of P2 is 0 to 3");
    CHECK(fault({block(3, 0)}) == "Q Q of P3 is 1 or 2");
    CHECK(fault({block(3, 1)}) == "I I J K is no direction");
    CHECK(fault({point(1, 0, 0, 0), point(1, 0, 0, 0)}) == "Q this Q was there before");
    CHECK(fault({point(1, 0, 0, 0), angles(0, 0, 0)}) == "P P is not that of the block before");
    CHECK(fault({point(1, 1, 1, 1), point(2, 2, 2, 2), point(3, 3, 3, 3)}) ==
          "- the three points are on one line");
    for (const auto& [second, third] : {std::pair{1.0, 3.0}, {3.0, 1.0}})
        CHECK(fault({point(1, 1, 1, 1), point(2, second, 1, 1), point(3, 1, 1, third)}) ==
              "- two of the three points are one");
}

TEST_CASE("G68.3: Z along the tool, X square to the vertical") {
    const Vector3 tool = Vector3(1, 2, 3).normalized();
    const Pose frame = positioning::plane_of_tool(tool, {7, 8, 9}, 0, {});
    CHECK((frame.rotation.col(2) - tool).norm() < 1e-15);
    CHECK((frame.rotation.col(0) - Vector3::UnitZ().cross(tool).normalized()).norm() < 1e-15);
    CHECK(frame.translation_mm == Vector3(7, 8, 9));
    CHECK(frame.rotation.determinant() == Approx(1.0));
    CHECK(positioning::plane_of_tool(Vector3::UnitZ(), {}, 0, {}).rotation.isIdentity(1e-15));
    const Matrix3 turned = positioning::plane_of_tool(Vector3::UnitZ(), {}, 30, {}).rotation;
    CHECK((turned - rotation_about(Vector3::UnitZ(), 30 * deg)).norm() < 1e-15);
}

TEST_CASE("G68.3 along a vertical that is inclined itself gives a square frame") {
    for (const Vector3& along : {Vector3(0.5, 0, std::sqrt(0.75)), Vector3(0.95, 0.2, 0.3)}) {
        positioning::VerticalAxis vertical;
        vertical.direction_P = along.normalized();
        const Matrix3 frame =
            positioning::plane_of_tool(vertical.direction_P, {}, 0, vertical).rotation;
        CHECK((frame.col(2) - vertical.direction_P).norm() < 1e-15);
        CHECK((frame * frame.transpose()).isIdentity(1e-14));
        CHECK(frame.determinant() == Approx(1.0));
    }
}

TEST_CASE("words of a plane that say no plane") {
    const auto letter_of_error = [](const positioning::PlaneWords& w) {
        try {
            positioning::PlaneDefinition().add(w);
        } catch (const positioning::PlaneFormatError& error) {
            return error.letter == 0 ? '0' : error.letter;
        }
        return '-';
    };
    positioning::PlaneWords w = angles(10, 20, 30);
    w.p = 1.5;
    CHECK(letter_of_error(w) == 'P');
    w.p = 1000.0;
    CHECK(letter_of_error(w) == 'P');
    w = angles(10, 20, 30);
    w.p = 1.0;
    w.q = 123.5;
    CHECK(letter_of_error(w) == 'Q');
    w = angles(90, 90, 0);
    w.p = 4.0;
    CHECK(letter_of_error(w) == 'I');
    CHECK(letter_of_error({}) == '0');
    for (const auto angle :
         {&positioning::PlaneWords::i, &positioning::PlaneWords::j, &positioning::PlaneWords::k}) {
        w = {};
        w.*angle = 0.0;
        CHECK(letter_of_error(w) == '-');
    }
}

TEST_CASE("each point of a plane needs all of its coordinates, and the blocks come in any order") {
    for (const auto missing :
         {&positioning::PlaneWords::x, &positioning::PlaneWords::y, &positioning::PlaneWords::z}) {
        positioning::PlaneDefinition definition;
        definition.add(block(2, 0));
        definition.add(point(1, 0, 0, 0));
        definition.add(point(2, 1, 0, 0));
        positioning::PlaneWords third = point(3, 0, 1, 0);
        (third.*missing).reset();
        CHECK_THROWS_AS(definition.add(third), positioning::PlaneFormatError);
    }
    for (const auto& [first, second] : {std::pair{1.0, 2.0}, {2.0, 1.0}}) {
        positioning::PlaneDefinition definition;
        const auto vector = [](double q) {
            positioning::PlaneWords v = block(3, q);
            (q == 1.0 ? v.i : v.k) = 1.0;
            return v;
        };
        CHECK_FALSE(definition.add(vector(first)));
        const auto frame = definition.add(vector(second));
        REQUIRE(frame);
        CHECK((frame->rotation - Matrix3::Identity()).norm() < 1e-12);
    }
}

}  // namespace trunnion
