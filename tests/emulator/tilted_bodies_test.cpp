// Bodies tilted about three axes on a table that is indexed or turns during G31: the ball's centre
// at the skip position is its radius away from the face, edge or corner that it met. A tool on a
// tilted setter.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "emulator/run.h"
#include "interpreter/program_folders.h"

namespace trunnion {

namespace {

constexpr double exact = 1e-6;  // mm
constexpr double ball_mm = 2.75;
const Vector3 tip_S(0.021, -0.034, -150.2), centre_W(22, -13, 41), tilt_deg(17, -24, 38);

Matrix3 turn(double deg, const Vector3& axis) {
    return Eigen::AngleAxisd(rad_from_deg(deg), axis).toRotationMatrix();
}
Matrix3 body_in_W() {
    return turn(tilt_deg.z(), Vector3::UnitZ()) * turn(tilt_deg.y(), Vector3::UnitY()) *
           turn(tilt_deg.x(), Vector3::UnitX());
}
/// ISO 841: the table turns against the tool.
Matrix3 table(double b_deg, double c_deg) {
    return turn(-b_deg, Vector3::UnitY()) * turn(-c_deg, Vector3::UnitZ());
}

setup::Setup machine(const std::string& body) {
    std::vector<std::string> notes;
    return setup::parse_setup(
        fmt::format("[machine]\nchain = \"w C B b X Y Z t\"\n"
                    "axis.B = {{ direction = [0, -1, 0], point_mm = [0, 0, 0] }}\n"
                    "axis.C = {{ direction = [0, 0, -1], point_mm = [0, 0, 0] }}\n"
                    "[probe]\ntip_mm = [{}, {}, {}]\nball_diameter_mm = {}\n"
                    "repeatability_um = 0.0\n[[body]]\nname = \"b\"\ncenter_mm = [{}, {}, {}]\n"
                    "tilt_deg = [{}, {}, {}]\n{}",
                    tip_S.x(), tip_S.y(), tip_S.z(), 2.0 * ball_mm, centre_W.x(), centre_W.y(),
                    centre_W.z(), tilt_deg.x(), tilt_deg.y(), tilt_deg.z(), body),
        "t.toml", notes);
}

std::map<int, double> after(const setup::Setup& setup, const std::string& program) {
    interpreter::ProgramFolders none({});
    const auto text =
        std::make_shared<const std::string>("%\nO1\nG90G21G17G54G49G40\n" + program + "M30\n%\n");
    emulator::RunOptions options;
    for (int n = 101; n <= 105; ++n) options.wanted_variables.push_back(n);
    const emulator::RunLog log =
        emulator::run_program(setup, none, interpreter::ProgramText{"t.nc", *text, text}, options);
    if (log.result.alarm) FAIL_CHECK(log.result.alarm->text);
    return log.variables;
}

std::string words(const Vector3& gauge, double b_deg, double c_deg) {
    return fmt::format("X{:.6f}Y{:.6f}Z{:.6f}B{:.4f}C{:.4f}", gauge.x(), gauge.y(), gauge.z(),
                       b_deg, c_deg);
}

/// The table's words before and at the end of a G31.
struct Turn {
    double b0, c0, b1, c1;
};
constexpr Turn turns[] = {
    {0, 0, 0, 0}, {35, -70, 35, -70}, {-50, 160, -50, 160}, {20, 40, 27, 31}, {-30, 10, -33, 14}};

/// The ball goes from `from` to `to` (in the frame of the body, with the table at the words of
/// start and end); where its centre is at the skip, in that frame.
Vector3 met(const setup::Setup& setup, const Turn& t, const Vector3& from, const Vector3& to) {
    const auto gauge = [&](const Vector3& at_B, double b_deg, double c_deg) {
        return Vector3(table(b_deg, c_deg) * (centre_W + body_in_W() * at_B) - tip_S);
    };
    const auto v = after(setup, "G0Z400.\nG0" + words(gauge(from, t.b0, t.c0), t.b0, t.c0) +
                                    "\nG31" + words(gauge(to, t.b1, t.c1), t.b1, t.c1) +
                                    "F200.\n#101=#5061\n#102=#5062\n#103=#5063\n#104=#5064\n"
                                    "#105=#5065\n");
    const Vector3 ball_M = Vector3(v.at(101), v.at(102), v.at(103)) + tip_S;
    return body_in_W().transpose() * (table(v.at(104), v.at(105)).transpose() * ball_M - centre_W);
}

}  // namespace

TEST_CASE("faces, edge and corner of a tilted block on a table that stands or turns") {
    const setup::Setup s = machine("size_mm = [40, 30, 25]\n");
    for (const Turn& t : turns) {
        INFO("B" << t.b0 << " to B" << t.b1);
        const Vector3 top = met(s, t, {11, 4, 25}, {3, -2, -9});
        CHECK(std::abs(top.z() - ball_mm) < exact);
        CHECK(std::abs(top.x()) < 20.0);
        const Vector3 side = met(s, t, {45, 3, -7}, {-5, -4, -12});
        CHECK(std::abs(side.x() - 20.0 - ball_mm) < exact);
        const Vector3 edge = met(s, t, {38, 2, 17}, {2, -1, -18});
        CHECK(edge.x() > 20.0);
        CHECK(edge.z() > 0.0);
        CHECK(std::abs(std::hypot(edge.x() - 20.0, edge.z()) - ball_mm) < exact);
        const Vector3 corner = met(s, t, {32, 27, 12}, {8, 3, -12});
        CHECK((corner - Vector3(20, 15, 0)).minCoeff() > 0.0);
        CHECK(std::abs((corner - Vector3(20, 15, 0)).norm() - ball_mm) < exact);
    }
}

TEST_CASE("wall, floor and rim of a tilted pocket, bore and boss on a table that stands or turns") {
    const setup::Setup pocket = machine("kind = \"pocket\"\nsize_mm = [60, 50, 30]\n");
    const setup::Setup ring =
        machine("kind = \"ring\"\ndiameter_mm = 50.003\nheight_mm = 30\nwall_mm = 8\n");
    const setup::Setup boss = machine("kind = \"boss\"\ndiameter_mm = 30.01\nheight_mm = 30\n");
    const auto across = [](const Vector3& p) { return std::hypot(p.x(), p.y()); };
    for (const Turn& t : turns) {
        INFO("B" << t.b0 << " to B" << t.b1);
        CHECK(std::abs(met(pocket, t, {2, 1, -9}, {4, 31, -12}).y() - 25.0 + ball_mm) < exact);
        CHECK(std::abs(met(pocket, t, {2, 1, -9}, {1, -3, -36}).z() + 30.0 - ball_mm) < exact);
        CHECK(std::abs(across(met(ring, t, {2, 1, -9}, {18, 24, -14})) - 25.0015 + ball_mm) <
              exact);
        CHECK(std::abs(across(met(boss, t, {35, 6, -9}, {-4, 1, -14})) - 15.005 - ball_mm) < exact);
        const Vector3 rim = met(boss, t, {30, 2, 15}, {1, -1, -14});
        CHECK(std::abs(std::hypot(across(rim) - 15.005, rim.z()) - ball_mm) < exact);
    }
}

TEST_CASE("a tool on a tilted setter touches with its rim, and its side meets the disc's rim") {
    std::vector<std::string> notes;
    const setup::Setup s = setup::parse_setup(
        "[machine]\nchain = \"w b X Y Z t\"\n[tools]\n5 = { length_mm = 100.0, diameter_mm = 16.0 "
        "}\n[[body]]\nname = \"s\"\nkind = \"setter\"\ncenter_mm = [200, -50, 30]\n"
        "tilt_deg = [0, 2, 0]\ndiameter_mm = 40.0\nheight_mm = 8.0\n",
        "t.toml", notes);
    const double tilt = rad_from_deg(2.0);
    // 1 mm beside the middle; the tilt turns the disc's side of + X down, so the rim at - X leads.
    const auto down = after(s, "T5M6\nG0X201.Y-50.\nZ150.\nG31Z120.F100.\n#101=#5063\n");
    CHECK(std::abs(down.at(101) - (130.0 + (8.0 - 1.0) * std::tan(tilt))) < exact);
    const auto side = after(s, "T5M6\nG0X150.Y-50.\nZ127.\nG31X200.F100.\n#101=#5061\n");
    // The disc's side leans: at the tip's height Z27 it is farther out than at its upper rim.
    const double below = 20.0 * std::sin(tilt) + 3.0;
    const double reach = 20.0 * std::cos(tilt) + below * std::tan(tilt);
    CHECK(std::abs(side.at(101) - (200.0 - reach - 8.0)) < exact);
}

}  // namespace trunnion
