// G54.2, G43.4, G43.5, G68.2 and G53.1 as programs command them.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "block_bench.h"
#include "controller/rotary_transform.h"
#include "geometry/random.h"

namespace trunnion {

using bench::Bench;

namespace {

Vector3 xyz(const AxisPositions& q) {
    return {q[Axis::X], q[Axis::Y], q[Axis::Z]};
}

/// BC or AC table, axes turning left-handed, true geometry as chosen here.
struct TableBench : Bench {
    explicit TableBench(Axis tilt_axis = Axis::B) : Bench(axes(tilt_axis)), tilt(tilt_axis) {
        Parameters& p = stores.parameters;
        p.set(19680, 12);
        p.set(19681, 4);
        p.set(19682, tilt == Axis::A ? 1 : 2);
        p.set(19684, 1);
        p.set(19686, 5);
        p.set(19687, 3);
        p.set(19689, 1);
        p.set(19697, 3);
        p.set(3401, 1);
        stores.tools.tool[1].length_geometry_mm = 120.0;
        stores.tools.tool[1].length_wear_mm = 0.25;
        control.parameters_changed();
    }
    static ControlConfig axes(Axis tilt) {
        ControlConfig config = bench::five_axes();
        config.axes[3].axis = tilt;
        return config;
    }
    void set_pivot(const Vector3& point, const Vector3& offset) {
        for (int i = 0; i < 3; ++i) {
            stores.parameters.set(19700 + i, point[i]);
            stores.parameters.set(19703 + i, offset[i]);
        }
        control.parameters_changed();
    }
    void set_g54(const Vector3& zero) {
        stores.work.standard[0][Axis::X] = zero.x();
        stores.work.standard[0][Axis::Y] = zero.y();
        stores.work.standard[0][Axis::Z] = zero.z();
        control.read_work_offset();
    }
    const RotaryTransform& belief() const { return *control.five_axis.transform; }
    Vector3 tip_W(const AxisPositions& q) const { return belief().tip_W(q, {0, 0, 120.25}); }
    void run(const std::string& text) { (*this)(text); }

    Axis tilt;
};

std::string words(const char* format, const Vector3& v) {
    return fmt::format(fmt::runtime(format), v.x(), v.y(), v.z());
}
constexpr const char* xyz_words = " X{:.15e} Y{:.15e} Z{:.15e}";

Vector3 random_vector(SeededNoise& noise, double size) {
    return Vector3(noise.uniform() - 0.5, noise.uniform() - 0.5, noise.uniform() - 0.5) * size;
}

/// The four functions at one pose; each starts with the rotaries at zero and TCP and planes off.
struct FourFunctions {
    TableBench b;
    Vector3 pivot, work_zero;  ///< G55 and 19700-19702; G54

    FourFunctions(Axis tilt, const Vector3& pivot, const Vector3& work_zero)
        : b(tilt), pivot(pivot), work_zero(work_zero) {
        b.run("G90 G21 G17 G94 G40 G0");
        b.set_pivot(pivot, Vector3::Zero());
        set_g55(pivot);
        b.set_g54(work_zero);
        set_fixture(work_zero - pivot);
    }
    void set_g55(const Vector3& zero) {
        for (const std::size_t i : {0U, 1U, 2U})
            b.stores.work.standard[1].value[i] = zero[static_cast<int>(i)];
    }
    void set_fixture(const Vector3& offset) {
        for (const std::size_t i : {0U, 1U, 2U})
            b.stores.fixture.set[2].offset.value[i] = offset[static_cast<int>(i)];
    }
    std::string turn(double tilt_deg, double c_deg) const {
        return fmt::format(" {}{:.12f} C{:.12f}", letter_of(b.tilt), tilt_deg, c_deg);
    }
    AxisPositions angles(double tilt_deg, double c_deg) const {
        AxisPositions q;
        q[b.tilt] = rad_from_deg(tilt_deg);
        q[Axis::C] = rad_from_deg(c_deg);
        return q;
    }
    Matrix3 rotation(double tilt_deg, double c_deg) const {
        const Vector3 line = b.tilt == Axis::A ? Vector3::UnitX() : Vector3::UnitY();
        return rotation_about(line, -rad_from_deg(tilt_deg)) *
               rotation_about(Vector3::UnitZ(), -rad_from_deg(c_deg));
    }
    Vector3 where() const { return xyz(b.control.move.from); }

    /// `from_pivot`: the point as the program's author found it, from the pivot, table at zero.
    Vector3 dpp(const Vector3& from_pivot, double tilt_deg, double c_deg) {
        b.run("G55 G43 H1 G0" + words(xyz_words, rotation(tilt_deg, c_deg) * from_pivot) +
              turn(tilt_deg, c_deg));
        CHECK(b.control.move.mode == PositioningMode::dpp);
        return finish("G49");
    }
    Vector3 rtdfo(const Vector3& q, double tilt_deg, double c_deg) {
        b.run("G55 G54.2 P3;G43 H1 G0" + words(xyz_words, rotation(tilt_deg, c_deg) * q) +
              turn(tilt_deg, c_deg));
        CHECK(b.control.move.mode == PositioningMode::rtdfo);
        return finish("G49;G54.2 P0");
    }
    Vector3 rtcp(const Vector3& q, double tilt_deg, double c_deg) {
        b.run("G54 G0" + turn(0, 0) + ";G43.4 H1 X0. Y0. Z50.;" + words(xyz_words, q) +
              turn(tilt_deg, c_deg));
        CHECK(b.control.move.mode == PositioningMode::rtcp);
        return finish("G49");
    }
    Vector3 tw(const Vector3& q, double tilt_deg, double c_deg) {
        const double i = b.tilt == Axis::A ? c_deg : c_deg + 90, k = b.tilt == Axis::A ? 0 : -90;
        b.run("G54 G0" + turn(tilt_deg, c_deg) +
              fmt::format(";G68.2 X0 Y0 Z0 I{:.12f} J{:.12f} K{:.12f}", i, tilt_deg, k));
        const std::size_t moves = b.sink.moves.size();
        b.run("G53.1");
        CHECK(b.sink.moves.size() == moves);  // the rotaries were placed first: it only confirms
        b.run("G43 H1 G0" + words(xyz_words, rotation(tilt_deg, c_deg) * q));
        CHECK(b.control.move.mode == PositioningMode::tw);
        return finish("G49;G69");
    }
    Vector3 finish(const std::string& cancel) {
        const Vector3 reached = where();
        b.run(cancel);
        b.sink.moves.clear();
        return reached;
    }
};

}  // namespace

TEST_CASE("DPP, G54.2, G43.4 and G68.2 send the axes to one place: 10,000 poses on BC and AC") {
    SeededNoise noise(100);
    double worst_mm = 0.0;
    for (const Axis tilt : {Axis::B, Axis::A}) {
        const Vector3 pivot = random_vector(noise, 200), zero = random_vector(noise, 300);
        FourFunctions f(tilt, pivot, zero);
        for (int k = 0; k < 5000; ++k) {
            const Vector3 q = random_vector(noise, 200);
            const double t = 220 * (noise.uniform() - 0.5), c = 1000 * (noise.uniform() - 0.5);
            const Vector3 expected =
                pivot + f.rotation(t, c) * (zero - pivot + q) + Vector3(0, 0, 120.25);
            for (const Vector3& got :
                 {f.dpp(zero - pivot + q, t, c), f.rtdfo(q, t, c), f.rtcp(q, t, c), f.tw(q, t, c)})
                worst_mm = std::max(worst_mm, (got - expected).norm());
        }
    }
    CHECK(worst_mm < 1e-9);
}

TEST_CASE("stores that differ move the axes by minus the closed forms e_G and e_P") {
    SeededNoise noise(101);
    for (const Axis tilt : {Axis::B, Axis::A}) {
        const Vector3 pivot = random_vector(noise, 200), zero = random_vector(noise, 300);
        const Vector3 dg(0.15, -0.12, 0.16), dp(0.08, 0.06, -0.07), dd(-0.15, 0.11, 0.06);
        FourFunctions f(tilt, pivot, zero);
        f.b.set_pivot(pivot + dp, dd);
        f.set_g55(pivot + dg);
        f.set_fixture(zero - pivot - dg);  // the work zero was set at home
        for (int k = 0; k < 200; ++k) {
            const Vector3 q = random_vector(noise, 200);
            const double t = 220 * (noise.uniform() - 0.5), c = 720 * (noise.uniform() - 0.5);
            const Matrix3 R = f.rotation(t, c), RT = f.rotation(t, 0), I = Matrix3::Identity();
            const Vector3 told_true = pivot + R * (zero - pivot + q) + Vector3(0, 0, 120.25);
            const Vector3 e_G = (R - I) * dg;
            const Vector3 e_P = (R - I) * (dp + dd) - (RT - I) * dd;
            // DPP and G54.2 turn the point found at home about the pivot that G55 says.
            CHECK((f.dpp(zero - pivot - dg + q, t, c) - told_true + e_G).norm() < 1e-9);
            CHECK((f.rtdfo(q, t, c) - told_true + e_G).norm() < 1e-9);
            CHECK((f.rtcp(q, t, c) - told_true + e_P).norm() < 1e-9);
            CHECK((f.tw(q, t, c) - told_true + e_P).norm() < 1e-9);
        }
    }
}

TEST_CASE("equal sums: C arcs at B0 agree between the groups, B arcs do not") {
    const Vector3 pivot(10, 20, 30), zero(120, 0, 80), dp(0.1, -0.1, 0.1), dd(0.05, 0.1, -0.1);
    FourFunctions f(Axis::B, pivot, zero);
    f.b.set_pivot(pivot + dp, dd);
    f.set_g55(pivot + dp + dd);
    f.set_fixture(zero - pivot - dp - dd);
    const Vector3 q = Vector3::Zero();
    for (double c = 0; c < 360; c += 30) {
        CHECK((f.rtdfo(q, 0, c) - f.rtcp(q, 0, c)).norm() < 1e-9);
        const Vector3 at_40 = f.rtdfo(q, 40, c) - f.rtcp(q, 40, c);
        CHECK((at_40 - (f.rtdfo(q, 40, 0) - f.rtcp(q, 40, 0))).norm() < 1e-9);  // a constant
        CHECK(at_40.norm() > 0.05);
    }
}

TEST_CASE("wrong signs and reference angles show") {
    FourFunctions f(Axis::B, {10, 20, 30}, {120, 0, 80});
    const Vector3 right = f.rtdfo(Vector3::Zero(), 30, 40);
    f.b.stores.fixture.set[2].reference_angles[Axis::C] = 1.0;  // one degree
    CHECK((f.rtdfo(Vector3::Zero(), 30, 40) - right).norm() > 1.0);
    const Vector3 tcp = f.rtcp(Vector3::Zero(), 30, 40);
    f.b.stores.parameters.set(19689, 0);
    f.b.control.parameters_changed();
    CHECK((f.rtcp(Vector3::Zero(), 30, 40) - tcp).norm() > 10.0);
}

TEST_CASE("G43.4 and G68.2/G53.1 put the tip on the programmed point on every machine type") {
    SeededNoise noise(102);
    double worst_mm = 0.0, worst_pair_mm = 0.0, worst_rad = 0.0;
    const int units[] = {12, 2, 21};
    for (int k = 0; k < 600; ++k) {
        TableBench b;
        Parameters& p = b.stores.parameters;
        const int unit = units[k % 3];
        p.set(19680, unit);
        // First carries second: B carries C on a table, C carries B on a head, tool B and table C.
        p.set(19681, unit == 2 ? 5 : 4);
        p.set(19682, unit == 2 ? 3 : 2);
        p.set(19686, unit == 2 ? 4 : 5);
        p.set(19687, unit == 2 ? 2 : 3);
        p.set(19684, k / 3 % 2);
        p.set(19689, k / 6 % 2);
        if (k % 4 == 0) {  // a nutating B axis
            p.set(unit == 2 ? 19687 : 19682, 5);
            p.set(unit == 2 ? 19688 : 19683, 25.0 + 20.0 * noise.uniform());
        }
        for (int i = 19700; i <= 19714; ++i)
            if (i < 19706 || i > 19708) p.set(i, 300 * (noise.uniform() - 0.5));
        b.control.parameters_changed();
        const Vector3 zero = random_vector(noise, 200), q = random_vector(noise, 200);
        b.set_g54(zero);
        const double t = 160 * (noise.uniform() - 0.5), c = 300 * (noise.uniform() - 0.5);
        b.run("G90 G21 G54 G0 B0 C0;G43.4 H1 X0 Y0 Z0;" + words(xyz_words, q) +
              fmt::format(" B{:.12f} C{:.12f}", t, c));
        const AxisPositions by_tcp = b.control.move.from;
        worst_mm = std::max(worst_mm, (b.tip_W(by_tcp) - zero - q).norm());
        CHECK(std::abs(b.variable(5001) - q.x()) < 1e-9);
        const Vector3 n = b.belief().tool_direction_W(by_tcp);
        // The same tool axis by P3: +Z along n, X anywhere square to it.
        const Vector3 x = n.unitOrthogonal();
        Matrix3 frame;
        frame << x, n.cross(x), n;
        b.run("G49;G68.2 P3 Q1 X1. Y2. Z3. " + words("I{:.15e} J{:.15e} K{:.15e}", x) +
              ";G68.2 P3 Q2 " + words("I{:.15e} J{:.15e} K{:.15e}", n));
        b.run("G53.1;G43 H1 G0 " + words(xyz_words, frame.transpose() * (q - Vector3(1, 2, 3))));
        const AxisPositions by_plane = b.control.move.from;
        worst_mm = std::max(worst_mm, (b.tip_W(by_plane) - zero - q).norm());
        worst_rad = std::max(worst_rad, b.belief().tool_direction_W(by_plane).cross(n).norm());
        if (std::abs(by_plane[Axis::B] - by_tcp[Axis::B]) < 1e-9 &&
            std::abs(by_plane[Axis::C] - by_tcp[Axis::C]) < 1e-9)
            worst_pair_mm = std::max(worst_pair_mm, (xyz(by_plane) - xyz(by_tcp)).norm());
        else
            worst_pair_mm = 1e9;  // G53.1 must stay with the angles that already serve
    }
    CHECK(worst_mm < 1e-9);
    CHECK(worst_pair_mm < 1e-9);
    CHECK(worst_rad < 1e-12);
}

TEST_CASE("13 indexations of a BC machine, each reached from its Euler angles") {
    int reached = 0;
    std::vector<std::pair<double, double>> indexations{{0, 0}};
    for (const double tilt : {90.0, -90.0})
        for (double c = 0; c < 360; c += 60) indexations.emplace_back(tilt, c);
    for (const auto& [tilt, c] : indexations) {
        TableBench b;
        b.run(fmt::format("G54 G90 G0 B0 C0;G68.2 X0 Y0 Z0 I{} J{} K-90.;G53.1 P{}", c + 90.0, tilt,
                          tilt < 0 ? 2 : 1));
        const AxisPositions q = b.control.move.from;
        CHECK(std::abs(std::remainder(deg_from_rad(q[Axis::B]) - tilt, 360)) < 1e-9);
        CHECK(std::abs(std::remainder(deg_from_rad(q[Axis::C]) - c, 360)) < 1e-9);
        // Without P: whichever branch is nearer, the tool stands along the same direction.
        TableBench nearest;
        nearest.run(
            fmt::format("G54 G90 G0 B0 C0;G68.2 X0 Y0 Z0 I{} J{} K-90.;G53.1", c + 90.0, tilt));
        const Vector3 n = nearest.belief().tool_direction_W(nearest.control.move.from);
        reached += n.cross(b.belief().tool_direction_W(q)).norm() < 1e-12 &&
                   n.dot(b.belief().tool_direction_W(q)) > 0;
    }
    CHECK(reached == 13);
    CHECK(indexations.size() == 13);
}

TEST_CASE("both solutions of G53.1 stand in the notes") {
    TableBench b;
    b.run("G54 G90 G0;G68.2 X0 Y0 Z0 I120. J40. K-90.;G53.1");
    REQUIRE(b.control.result.notes.size() == 1);
    CHECK(b.control.result.notes[0].find(
              "B40.0000 C30.0000, other solution B-40.0000 C-150.0000") != std::string::npos);
}

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

TEST_CASE("G54.2: motion of both rotaries, cancel, change of set, with G43") {
    TableBench b;
    b.stores.fixture.set[0].offset[Axis::X] = 100;
    b.stores.fixture.set[1].offset[Axis::Y] = 50;
    b.stores.fixture.set[1].reference_angles[Axis::C] = 90;
    b.run("G90 G54 G0 X0 Y0 Z0 B0 C0;G54.2 P1");
    CHECK(b.control.move.from[Axis::X] == 0.0);  // the position shifts, nothing moves
    CHECK(b.variable(5001) == -100.0);
    b.run("G43 H1 X1. Y2. Z3. C90.");  // left-handed table: C90 carries +X to -Y
    CHECK((xyz(b.last().to) - Vector3(1, -98, 123.25)).norm() < 1e-12);
    b.run("B90.");  // the vector lies along Y: nothing changes; then C0 B90 carries it to +Z
    CHECK((xyz(b.last().to) - Vector3(1, -98, 123.25)).norm() < 1e-12);
    b.run("C0.");
    CHECK((xyz(b.last().to) - Vector3(1, 2, 223.25)).norm() < 1e-12);
    b.run("G54.2 P2;X0 Y0 Z0 B0 C0");  // set 2 measured at C90: at C0 it lies along -X
    CHECK((xyz(b.last().to) - Vector3(-50, 0, 120.25)).norm() < 1e-12);
    b.run("G54.2 P0;X0 Y0 Z0");
    CHECK((xyz(b.last().to) - Vector3(0, 0, 120.25)).norm() < 1e-12);
    CHECK(b.alarm("G54.2 P9") == 31);
    CHECK(b.alarm("G54.2") == 31);
    // Stores of the pivot do not matter to it.
    b.stores.parameters.set(19700, 77.0);
    b.control.parameters_changed();
    b.run("G54.2 P1;X0 Y0 Z0 B30. C40.");
    const Vector3 with_77 = xyz(b.last().to);
    b.stores.parameters.set(19700, 0.0);
    b.control.parameters_changed();
    b.run("X0 Y0 Z1.;Z0");
    CHECK(xyz(b.last().to) == with_77);
}

TEST_CASE("G54.2 as a shift: 7570#0 = 1 leaves the axes in a block that only turns") {
    TableBench b;
    b.stores.parameters.set(7570, 1);
    b.stores.fixture.set[0].offset[Axis::X] = 100;
    b.run("G90 G54 G0 X0 Y0 Z0;G54.2 P1;X0;C90.");
    CHECK((xyz(b.last().to) - Vector3(100, 0, 0)).norm() < 1e-12);
    b.run("X0 Y0");
    CHECK((xyz(b.last().to) - Vector3(0, -100, 0)).norm() < 1e-12);
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
    for (const TcpFrame frame : {TcpFrame::start, TcpFrame::rotary_zero}) {
        TableBench b;
        b.control.config.tcp_frame = frame;
        b.set_pivot({0, 0, 40}, {0, 0, -20});
        b.run("G90 G54 G0 X0 Y0 Z100. B30. C45.;G43.4 H1 X10. Y0 Z5.;X10. Y0 Z6.");
        const AxisPositions q = b.last().to;
        if (frame == TcpFrame::start)  // program axes lie along the machine until the table turns
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
    b.control.limits.seconds_per_unit.fill(0.0);
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
    b.control.limits.seconds_per_unit[index_of(Axis::C)] = 60.0 / rad_from_deg(90.0);
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
    struct Check : MotionSink {
        MoveResult move(const AxisMove& m) override {
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
    Stores stores = b.stores;
    ControlState control(b.control.config, stores, check);
    const auto run = [&](const char* text) { execute_block(control, bench::words_of(text)); };
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
    b.control.limits.min[index_of(Axis::B)] = 0;
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

TEST_CASE("arcs, G52, G91 and G31 count along the tilted plane") {
    TableBench b;
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.set_g54({30, -10, 15});
    b.run("G90 G17 G54 G0 B0 C0;G43 H1;G68.2 X5. Y6. Z7. I90. J35. K-90.;G53.1;X20. Y0 Z1.");
    const Pose plane{rotation_about(Vector3::UnitY(), rad_from_deg(35)), Vector3(5, 6, 7)};
    const auto tip = [&] { return Vector3(b.tip_W(b.control.move.from) - Vector3(30, -10, 15)); };
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
    CHECK(b.control.move.mode == PositioningMode::dpp);
}

TEST_CASE("G31 under G43.4 latches the programmed frame") {
    TableBench b;
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.run("G90 G54 G0 B0 C0;G43.4 H1 X10. Y0 Z50.;B30. C20.");
    b.sink.trigger_at = 0.25;
    b.run("G31 X10. Y0 Z10. F100.");
    CHECK(b.variable(5003) == Approx(40.0));
    CHECK(b.variable(5063) - b.variable(5083) == Approx(40.0));
    CHECK((b.tip_W(b.control.move.from) - Vector3(10, 0, 40)).norm() < 1e-9);
}

TEST_CASE("G68.2 inside G52, G68.4 on top, G69 restores") {
    TableBench b;
    b.run("G90 G54 G0 B0 C0;G52 X10.;G68.2 X5. Y0 Z0 I0 J0 K0;G0 X1. Y0 Z0");
    CHECK((xyz(b.last().to) - Vector3(16, 0, 0)).norm() < 1e-12);
    b.run("G52 X100.;G68.4 P1 X0 Y0 Z0 I0 J0 K90.;X0 Y0 Z0;Y3.");
    b.run("G69;X0 Y0 Z0");
    CHECK((xyz(b.last().to) - Vector3(10, 0, 0)).norm() < 1e-12);
    CHECK(b.control.modal.is(ModalGroup::rotation, 690));
}

TEST_CASE("G68.3 takes the plane from the tool as it stands") {
    TableBench b;
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.run("G90 G54 G0 G43 H1 X10. Y20. Z100. B30. C40.;G68.3 R0");
    CHECK(std::abs(b.variable(5001)) + std::abs(b.variable(5002)) + std::abs(b.variable(5003)) <
          1e-9);
    const Vector3 before = b.tip_W(b.control.move.from);
    const Vector3 n = b.belief().tool_direction_W(b.control.move.from);
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
    const AxisPositions before = b.control.move.from;
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

TEST_CASE("TCP inside a tilted plane keeps the plane's coordinates") {
    TableBench b;
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.run("G90 G54 G0 B0 C0;G68.2 X5. Y6. Z7. I90. J35. K-90.;G53.1;G43.4 H1 X0 Y0 Z10.");
    const Pose plane{rotation_about(Vector3::UnitY(), rad_from_deg(35)), Vector3(5, 6, 7)};
    b.run("X3. Y4. Z5. B50. C10.");
    CHECK((b.tip_W(b.last().to) - plane * Vector3(3, 4, 5)).norm() < 1e-9);
    b.run("G49");
    const AxisPositions stood = b.control.move.from;
    b.run("G69");
    CHECK(b.control.move.from == stood);
}

TEST_CASE("roll-over axes take the shorter way, or the way of the sign") {
    TableBench b;
    b.stores.parameters.entry[1008].by_axis[5] = 1;
    b.control.parameters_changed();
    const auto c_deg = [&] { return deg_from_rad(b.control.move.from[Axis::C]); };
    b.run("G90 G54 G0 C350.;C10.");
    CHECK(c_deg() == Approx(10).margin(1e-9));
    b.run("C350.");
    CHECK(c_deg() == Approx(-10).margin(1e-9));
    b.run("G91 C400.;G90 B300.");
    CHECK(c_deg() == Approx(390).margin(1e-9));
    CHECK(deg_from_rad(b.control.move.from[Axis::B]) == Approx(300));
    b.stores.parameters.entry[1008].by_axis[5] = 3;
    b.control.parameters_changed();
    b.run("C-20.");
    CHECK(c_deg() == Approx(380).margin(1e-9));
    b.run("C10.");
    CHECK(c_deg() == Approx(730).margin(1e-9));
}

TEST_CASE("Hurco: M128 and M129, M126 and M127") {
    TableBench b;
    b.control.config.dialect = hurco_dialect();
    b.set_pivot({1, 2, 40}, {0.5, 0.25, -20});
    b.run("G90 G54 G0 G43 H1 X10. Y0 Z50. B30. C40.;M128;X10. Y5. Z20.");
    CHECK((b.tip_W(b.last().to) - Vector3(10, 5, 20)).norm() < 1e-9);
    CHECK(b.last().mode == PositioningMode::rtcp);
    const AxisPositions stood = b.control.move.from;
    b.run("M129");
    CHECK(b.control.move.from == stood);
    b.run("X10. Y5. Z20. B0 C0");
    CHECK((xyz(b.last().to) - Vector3(10, 5, 140.25)).norm() < 1e-9);
    b.run("C350.;M126;C10.");
    CHECK(deg_from_rad(b.control.move.from[Axis::C]) == Approx(370));
    b.run("M127;C0");
    CHECK(b.control.move.from[Axis::C] == Approx(0).margin(1e-12));
    TableBench fanuc;
    fanuc.run("G90 G54 M128");
    CHECK_FALSE(fanuc.control.five_axis.tcp);
}

TEST_CASE("axes may not swing beyond their stroke on the way of the tip") {
    TableBench b;
    b.control.limits.max[index_of(Axis::Y)] = 40.0;
    b.run("G90 G54 G0 B0 C0;G43.4 H1 X50. Y0 Z0");
    CHECK(b.alarm("C-180.") == 500);  // both ends have Y0, half-way it is at 50
    b.run("C180.");
}

TEST_CASE("#5081 shows the tool length, not the swing of a head") {
    TableBench b;
    Parameters& p = b.stores.parameters;
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

}  // namespace trunnion
