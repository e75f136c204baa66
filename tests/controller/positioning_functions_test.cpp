// DPP, G54.2, G43.4 and G68.2/G53.1 side by side: equal stores, equal axes.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "table_bench.h"

namespace trunnion {

using bench::random_vector;
using bench::TableBench;
using bench::words;
using bench::xyz;
using bench::xyz_words;

namespace {

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
    Vector3 where() const { return xyz(b.control.frames.axes); }

    /// `from_pivot`: the point as the program's author found it, from the pivot, table at zero.
    Vector3 dpp(const Vector3& from_pivot, double tilt_deg, double c_deg) {
        b.run("G55 G43 H1 G0" + words(xyz_words, rotation(tilt_deg, c_deg) * from_pivot) +
              turn(tilt_deg, c_deg));
        CHECK(b.control.frames.mode(b.control.modal.settings) == PositioningMode::dpp);
        return finish("G49");
    }
    Vector3 rtdfo(const Vector3& q, double tilt_deg, double c_deg) {
        b.run("G55 G54.2 P3;G43 H1 G0" + words(xyz_words, rotation(tilt_deg, c_deg) * q) +
              turn(tilt_deg, c_deg));
        CHECK(b.control.frames.mode(b.control.modal.settings) == PositioningMode::rtdfo);
        return finish("G49;G54.2 P0");
    }
    Vector3 rtcp(const Vector3& q, double tilt_deg, double c_deg) {
        b.run("G54 G0" + turn(0, 0) + ";G43.4 H1 X0. Y0. Z50.;" + words(xyz_words, q) +
              turn(tilt_deg, c_deg));
        CHECK(b.control.frames.mode(b.control.modal.settings) == PositioningMode::rtcp);
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
        CHECK(b.control.frames.mode(b.control.modal.settings) == PositioningMode::tw);
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
        offsets::Parameters& p = b.stores.parameters;
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
        const AxisPositions by_tcp = b.control.frames.axes;
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
        const AxisPositions by_plane = b.control.frames.axes;
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

}  // namespace trunnion
