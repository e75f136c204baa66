// The same part by four positioning functions, on two machines, and with two states of the stores.
#include "tests/regression/same_part.h"

#include <catch2/catch.hpp>

#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

setup::Setup machine_of(const PartOnTable& part) {
    std::vector<std::string> notes;
    setup::Setup setup =
        setup::load_setup(std::string(TRUNNION_SOURCE_DIR) + "/machines/" +
                              (part.tilt == 'B' ? "bc_table.toml" : "ac_trunnion.toml"),
                          notes);
    setup.stores.tools.tool[1].length_geometry_mm = 120.0;
    for (int k = 0; k < 3; ++k) {
        setup.stores.parameters.set(19700 + k, part.pivot_mm[k]);
        setup.stores.parameters.set(19703 + k, 0.0);
    }
    return setup;
}

regression::Comparison compare_on(const std::string& a, const setup::Setup& setup_a,
                                  const std::string& b, const setup::Setup& setup_b) {
    return regression::compare_programs(text_of("a.nc", a), setup_a, text_of("b.nc", b), setup_b,
                                        {});
}

}  // namespace

TEST_CASE("the same part by own kinematics, G43.4, G68.2 and G54.2 is equal, all pairs, BC and AC",
          "[compare]") {
    PartOnTable part;
    part.tilt = GENERATE('B', 'A');
    const setup::Setup setup = machine_of(part);
    for (const Post p : {Post::dpp, Post::tcp, Post::plane, Post::fixture})
        for (const Post q : {Post::dpp, Post::tcp, Post::plane, Post::fixture}) {
            const std::string a = part.program(p), b = part.program(q);
            const regression::Comparison r = compare_texts(a, b, setup);
            INFO(part.tilt << "C, " << post_names[static_cast<std::size_t>(p)] << " and "
                           << post_names[static_cast<std::size_t>(q)] << ": " << r.verdict);
            CHECK(r.equal);
            CHECK(r.by == (p == q ? regression::Layer::text : regression::Layer::path));
            CHECK(r.position_mm < 0.002);
            CHECK(r.direction_deg < 1e-5);
            // Four sections, in each 3 lines and a half circle of radius 5.
            if (p != q)
                CHECK(r.tools.at(0).cut_a_mm == Approx(4 * (3 + 20 + 20 + 5 * pi)).epsilon(1e-4));
            // One cut moved within the tolerance (the arc's chords take 0.0008) or beyond it.
            PartOnTable moved = part;
            moved.shift_mm = Vector3(0, 0, 0.004);
            CHECK(compare_texts(a, moved.program(q), setup).equal);
            moved.shift_mm = Vector3(0, 0, 0.02);
            const regression::Comparison differs = compare_texts(a, moved.program(q), setup);
            CHECK_FALSE(differs.equal);
            CHECK(differs.position_mm == Approx(0.02).margin(0.002));
            CHECK(differs.differences.front().a.line >=
                  line_with(a, part.tilt + std::string("90.")));
        }
}

TEST_CASE("the same part posted for a BC and for an AC machine is equal across both setups",
          "[compare]") {
    PartOnTable bc, ac;
    ac.tilt = 'A';
    const setup::Setup setup_bc = machine_of(bc), setup_ac = machine_of(ac);
    for (const Post p : {Post::dpp, Post::tcp, Post::plane, Post::fixture}) {
        const regression::Comparison r =
            compare_on(bc.program(p), setup_bc, ac.program(p), setup_ac);
        INFO(post_names[static_cast<std::size_t>(p)] << ": " << r.verdict);
        CHECK(r.equal);
        CHECK(r.by == regression::Layer::path);
        // Different posts on different machines too.
        CHECK(compare_on(bc.program(p), setup_bc, ac.program(Post::tcp), setup_ac).equal);
        // C of the wrong machine: 90 degrees off.
        PartOnTable wrong = ac;
        wrong.turn_c_deg = -90.0;
        // (G53.1 turns the rotaries to the plane itself, whatever stood there before.)
        CHECK(compare_on(bc.program(p), setup_bc, wrong.program(p), setup_ac).equal ==
              (p == Post::plane));
        // The program of the other machine does not run: there is no such axis.
        const regression::Comparison other =
            compare_on(bc.program(p), setup_bc, ac.program(p), setup_bc);
        CHECK(other.status == regression::CompareStatus::alarm);
        CHECK_FALSE(other.equal);
        // A full turn of C is the same machining.
        PartOnTable turned = ac;
        turned.turn_c_deg = 360.0;
        CHECK(compare_on(bc.program(p), setup_bc, turned.program(p), setup_ac).equal);
    }
}

TEST_CASE("what a part loses when nobody updates P1970x is the closed form", "[compare]") {
    // Closed form of docs/notation.md: |(R - I) (dp + dd) - (R1 - I) dd|, R1 the tilting axis
    // alone.
    PartOnTable part;
    part.tilt = GENERATE('B', 'A');
    const Vector3 dp = GENERATE(values<Vector3>({{0.08, 0, 0}, {0.05, -0.03, 0.07}, {0, 0, 0}}));
    const Vector3 dd = GENERATE(values<Vector3>({{0, 0, 0}, {-0.02, 0.04, 0.03}}));
    const setup::Setup now = machine_of(part);
    setup::Setup stale = now;
    for (int k = 0; k < 3; ++k) {
        stale.stores.parameters.set(19700 + k, part.pivot_mm[k] + dp[k]);
        stale.stores.parameters.set(19703 + k, dd[k]);
    }
    std::vector<double> expected;
    for (const auto& [tilt, c] : PartOnTable::orientations()) {
        const Matrix3 R = part.table_rotation(tilt, c);
        const Matrix3 R1 =
            R * Eigen::AngleAxisd(rad_from_deg(part.c_deg(c)), Vector3::UnitZ()).toRotationMatrix();
        const Vector3 lost =
            (R - Matrix3::Identity()) * (dp + dd) - (R1 - Matrix3::Identity()) * dd;
        if (lost.norm() > 0.005) expected.push_back(lost.norm());
    }
    for (const Post p : {Post::tcp, Post::plane}) {
        const std::string program = part.program(p);
        const regression::Comparison r = compare_on(program, now, program, stale);
        INFO(part.tilt << "C " << post_names[static_cast<std::size_t>(p)] << ", dp "
                       << dp.transpose() << ", dd " << dd.transpose() << ": " << r.verdict);
        CHECK(r.equal == expected.empty());
        std::vector<double> moved;
        for (const regression::Difference& d : r.differences) {
            CHECK(d.kind == regression::DifferenceKind::moved);
            moved.push_back(d.position_mm);
            CHECK(d.a.line == d.b.line);
        }
        REQUIRE(moved.size() == expected.size());
        for (std::size_t k = 0; k < expected.size(); ++k)
            CHECK(moved[k] == Approx(expected[k]).margin(1e-6));
    }
    // The functions that keep the pivot in G54 lose nothing by stale pivot parameters.
    for (const Post p : {Post::dpp, Post::fixture})
        CHECK(compare_on(part.program(p), now, part.program(p), stale).equal);
}

TEST_CASE("a tool length that nobody updated moves the part along the tool", "[compare]") {
    PartOnTable part;
    const setup::Setup now = machine_of(part);
    setup::Setup stale = now;
    stale.stores.tools.tool[1].length_geometry_mm += 0.05;
    const std::string program = part.program(Post::tcp);
    const regression::Comparison r = compare_on(program, now, program, stale);
    REQUIRE_FALSE(r.equal);
    CHECK(r.position_mm == Approx(0.05).margin(1e-6));
}

TEST_CASE("five axes at once: G43.4 in long blocks equals own kinematics in short ones",
          "[compare]") {
    PartOnTable part;
    part.tilt = GENERATE('B', 'A');
    const setup::Setup setup = machine_of(part);
    const double length = Vector3(30, -12, 0).norm();
    const auto program = [&](bool own, double step, double z) {
        const Vector3 g54 = own ? part.pivot_mm : part.zero_W_mm;
        std::string s = fmt::format(
            "%\nO1\nG90 G21 G17 G94\nG10 L2 P1 X{:.6f} Y{:.6f} Z{:.6f}\nG54\nT1 M6\nS500 M3\n{}\n"
            "G0 {}0. C{:.4f}\n",
            g54.x(), g54.y(), g54.z(), own ? "G43 H1" : "", part.tilt, part.c_deg(0));
        if (!own) s += fmt::format("G0 C0.\nG43.4 H1\n");
        for (double t = 0.0; t <= 1.0 + 1e-9; t += step) {
            const double tilt = 60.0 * t, c = 90.0 * t;
            const Vector3 p(10 + 30 * t, 5 - 12 * t, z);
            const Vector3 w =
                own ? Vector3(part.table_rotation(tilt, c) * (part.zero_W_mm + p - part.pivot_mm))
                    : p;
            // A post with own kinematics gives the time of each block, so the tip keeps its feed.
            const std::string feed =
                own ? fmt::format("G93 G1 F{:.4f}", 500.0 / (length * step)) : "G1 F500.";
            s +=
                fmt::format("{} X{:.6f} Y{:.6f} Z{:.6f} {}{:.6f} C{:.6f}\n", t == 0.0 ? "G0" : feed,
                            w.x(), w.y(), w.z(), part.tilt, tilt, part.c_deg(c));
        }
        return s + "M30\n%\n";
    };
    const regression::Comparison r =
        compare_texts(program(true, 0.002, 4), program(false, 0.5, 4), setup);
    INFO(r.verdict);
    CHECK(r.equal);
    CHECK_FALSE(compare_texts(program(true, 0.002, 4), program(false, 0.5, 4.02), setup).equal);
    // Long blocks without tool centre point control do not hold the tip.
    CHECK_FALSE(compare_texts(program(true, 0.5, 4), program(false, 0.5, 4), setup).equal);
}
