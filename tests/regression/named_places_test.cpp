// Where a difference is said to be: pictures behind a jump, tails behind long insertions, blocks
// that only one side has.
#include <catch2/catch.hpp>

#include "base/random.h"
#include "base/units.h"
#include "regression/chords.h"
#include "regression/closeup.h"
#include "tests/regression/paths.h"
#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

TEST_CASE("a state that a subprogram sets has its place there, and beside the same move in B",
          "[compare]") {
    const std::string with =
        "O1\nG90 G21 G94 G54\nT1 M6\nS5000 M3\nG0 X0. Y0. Z50.\nG1 Z-1. F200.\nX10.\nG0 Z50.\n"
        "M98 P2\nG0 X20.\nY5.\nZ5.\nG1 Z-1.\nX30.\nX31.\nX32.\nG0 Z50.\nM30\nO2\nS6000\nM99\n";
    const std::string without = replaced(with, "S6000\n", "#1=1\n");
    const regression::Comparison lost = compare_texts(with, without, bc_table());
    REQUIRE(lost.differences.size() == 1);
    CHECK(lost.differences[0].cause == "S6000 is missing in B, S5000 stays in force");
    CHECK(lost.differences[0].a.line == line_with(with, "S6000"));
    CHECK(lost.differences[0].b.line == line_with(without, "G0 X20."));
    const regression::Comparison added = compare_texts(without, with, bc_table());
    REQUIRE(added.differences.size() == 1);
    CHECK(added.differences[0].a.line == line_with(without, "G0 X20."));
    CHECK(added.differences[0].b.line == line_with(with, "S6000"));
}

TEST_CASE("a short tail is equal behind thousands of inserted segments", "[compare]") {
    SeededNoise noise(11);
    Pen a, b;
    a.at(0, 0, 0);
    b.at(0, 0, 0);
    for (int k = 0; k < 300; ++k) {
        const double x = 0.3 * k, y = noise.uniform();
        a.cut(x, y, 0);
        if (k == 200)
            for (int n = 0; n < 3000; ++n) b.cut(x + noise.uniform(), 5 + noise.uniform(), 3);
        b.cut(x, y, 0);
    }
    for (const bool swapped : {false, true}) {
        const regression::PathComparison r = swapped ? compare(b, a) : compare(a, b);
        REQUIRE(r.clusters.size() == 1);
        const regression::PathRegion& first = r.clusters[0].first;
        CHECK(std::min(first.a.last - first.a.first, first.b.last - first.b.first) <= 1);
    }
}

TEST_CASE("a picture shows what is cut behind a jump of the tip", "[compare]") {
    Pen a, b;
    for (Pen* pen : {&a, &b}) {
        pen->at(0, 0, 0).cut(10, 0, 0);
        pen->add(pen->segment(regression::SegmentKind::jump, 10, 0, -50));
        pen->cut(20, pen == &b ? 1 : 0, -50).cut(30, 0, -50);
    }
    const auto closeup =
        regression::closeup_of(a.done(), {1, 5}, b.done(), {1, 5}, regression::Tolerances{});
    REQUIRE(closeup);
    CHECK(closeup->apart_mm() == Approx(1.0).margin(0.01));
    CHECK(closeup->place_mm[0] == Approx(20.0));
    CHECK(closeup->place_mm[2] == Approx(-50.0));
    CHECK(closeup->a.back()[0] == Approx(30.0));
}

TEST_CASE("a block that only one side has is the cause of the path without it", "[compare]") {
    const std::string with =
        "O1\nG90 G21 G94 G54\nT1 M6\nS5000 M3\nG0 X0. Y0. Z50.\nG1 Z-1. F200.\nX10.\nG0 Z50.\n"
        "M30\n";
    const std::string without = replaced(with, "G0 X0. Y0. Z50.\n", "");
    const regression::Comparison lost = compare_texts(with, without, bc_table());
    REQUIRE_FALSE(lost.differences.empty());
    CHECK(lost.differences[0].cause == "block 'G0 X0. Y0. Z50.' is missing in B");
    const regression::Comparison added = compare_texts(without, with, bc_table());
    REQUIRE_FALSE(added.differences.empty());
    CHECK(added.differences[0].cause == "block 'G0 X0. Y0. Z50.' is only in B");
}

TEST_CASE("the middle of a helix is half way up and inside of its arc", "[compare]") {
    Pen pen;
    pen.at(10, 0, 20).arc(0, 10, 26, Vector3(0, 0, 20), 0.5 * pi);
    const auto& record = pen.done();
    regression::SegmentWindow path(record.segments());
    const Vector3 middle = regression::centroid(path[0].end(), path[1]);
    CHECK(middle.x() == Approx(20.0 / pi));
    CHECK(middle.y() == Approx(20.0 / pi));
    CHECK(middle.z() == Approx(23.0));
}

TEST_CASE("a block with too many changes to be said is not named by a later one", "[compare]") {
    const std::string a =
        "O1\nG90 G21 G94 G54\nT1 M6\nS5000 M3\nG0 X0. Y0. Z50.\nG1 Z-1. F200.\n"
        "X10. Y2. Z-3. F300.\nY10.\nM8\nX0.\nG0 Z50.\nM30\n";
    const std::string b =
        replaced(replaced(a, "X10. Y2. Z-3. F300.", "X11. Y3. Z-4. F310."), "M8", "M7");
    const regression::Comparison r = compare_texts(a, b, bc_table());
    REQUIRE_FALSE(r.differences.empty());
    CHECK(r.differences[0].kind == regression::DifferenceKind::path);
    CHECK(r.differences[0].cause == "");
}

TEST_CASE("a pass that one side has more often is named by its own block", "[compare]") {
    const std::string two =
        "O1\nG90 G21 G94 G54\nT1 M6\nS5000 M3\nG0 X0. Y0. Z50.\nG1 Z-1. F200.\nX10.\nG0 Z50.\n"
        "G0 X0. Y30.\nG91 G81 X10. Z-12. R-40. F100. K2\nG80\nG90 G0 X0. Y0.\nM30\n";
    const std::string three =
        replaced(replaced(replaced(two, "F200.", "F210."), "G0 X0. Y30.", "M8\nM9\nG0 X0. Y30."),
                 "K2", "K3");
    const auto said = [](const regression::Comparison& r, const std::string& cause) {
        return std::any_of(r.differences.begin(), r.differences.end(),
                           [&](const regression::Difference& d) { return d.cause == cause; });
    };
    CHECK(said(compare_texts(two, three, bc_table()), "K3 instead of K2"));
    CHECK(said(compare_texts(three, two, bc_table()), "K2 instead of K3"));
}

TEST_CASE("a detour that only one side makes is drawn once, as first and as worst place",
          "[compare]") {
    const std::string straight =
        "O1\nG90 G21 G94 G54\nT1 M6\nS5000 M3\nG0 X0. Y0. Z50.\nG1 Z-1. F200.\nX10.\nX20.\nY30.\n"
        "G0 Z50.\nM30\n";
    const std::string detour = replaced(straight, "X10.\n", "X10.\nY5.\nY0.\n");
    for (const regression::Comparison& r : {compare_texts(straight, detour, bc_table()),
                                            compare_texts(detour, straight, bc_table())}) {
        REQUIRE(r.picture.closeups.size() == 1);
        CHECK(r.picture.closeups[0].first);
        CHECK(r.picture.closeups[0].worst);
        CHECK(r.picture.closeups[0].apart_mm() == Approx(5.0));
    }
}
