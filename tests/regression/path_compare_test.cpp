#include "regression/path_compare.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>

#include "base/random.h"
#include "base/units.h"
#include "tests/regression/paths.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

/// A part of `passes` rectangles, one below the other, with retracts between.
void part(Pen& pen, int passes, double clearance_mm = 10.0) {
    pen.at(0, 0, 100);
    for (int k = 0; k < passes; ++k) {
        const double z = -0.5 * (k + 1);
        pen.rapid(1.0 * k, 0, clearance_mm).rapid(1.0 * k, 0, 2).cut(1.0 * k, 0, z);
        pen.cut(50, 0, z).cut(50, 30, z).cut(0, 30, z).cut(0, 0, z);
        pen.rapid(0, 0, clearance_mm);
    }
}

}  // namespace

TEST_CASE("a path equals itself", "[compare]") {
    Pen a, b;
    part(a, 20);
    part(b, 20);
    const regression::PathComparison r = compare(a, b);
    CHECK(r.clusters.empty());
    CHECK(r.totals.compared == 160);
    CHECK(r.totals.position_mm == 0.0);
}

TEST_CASE("cutting a line into pieces changes nothing", "[compare]") {
    SeededNoise noise(1);
    Pen a, b;
    a.at(0, 0, 0);
    b.at(0, 0, 0);
    for (int k = 1; k <= 50; ++k) {
        const double x = k * 7.0, y = k % 2 == 0 ? 0.0 : 5.0;
        const double x0 = x - 7.0, y0 = 5.0 - y;
        const double y_from = k == 1 ? 0.0 : y0;
        a.cut(x, y, 0);
        double s = 0.0;
        while ((s += 0.4 * noise.uniform()) < 1.0)
            b.cut(x0 + s * 7.0, y_from + s * (y - y_from), 0);
        b.cut(x, y, 0);
    }
    const regression::PathComparison r = compare(a, b);
    CHECK(r.clusters.empty());
    CHECK(r.totals.position_mm < 1e-9);
}

TEST_CASE("0.9 of the tolerance is equal and 1.1 differs, at corners, flanks, reversals, arcs",
          "[compare]") {
    const double tolerance = GENERATE(0.001, 0.005, 0.1);
    regression::WalkOptions options;
    options.tolerances.position_mm = tolerance;
    const double part_of = GENERATE(0.9, 1.1);
    const double d = part_of * tolerance;
    const bool equal = part_of < 1.0;
    Pen a, b;
    SECTION("a corner moved along, with other segmentation") {
        a.at(0, 0, 0).cut(10, 0, 0).cut(10, 10, 0);
        b.at(0, 0, 0).cut(4, 0, 0).cut(10 + d, 0, 0).cut(10 + d, 3, 0).cut(10, 10, 0);
    }
    SECTION("a flank moved") {
        a.at(0, 0, 0).cut(10, 0, 0).cut(20, 0, 0);
        b.at(0, 0, 0).cut(10, d, 0).cut(20, 0, 0);
    }
    SECTION("a peck that goes deeper") {
        a.at(0, 0, 1).cut(0, 0, -5).rapid(0, 0, 1).cut(0, 0, -8).rapid(0, 0, 1);
        b.at(0, 0, 1).cut(0, 0, -2).cut(0, 0, -5 - d).rapid(0, 0, 1).cut(0, 0, -8).rapid(0, 0, 1);
    }
    SECTION("the radius of an arc") {
        a.at(10, 0, 0).arc(-10, 0, 0, {0, 0, 0}, pi).cut(0, 0, 0);
        const double h =
            (100.0 - (10 + d) * (10 + d)) / (2 * (10 + d));  // same ends, apex d higher
        const double radius = std::hypot(10.0, h);
        const double sweep = 2.0 * std::atan2(10.0, h);
        b.at(10, 0, 0).arc(-10, 0, 0, {0, -h, 0}, sweep).cut(0, 0, 0);
        REQUIRE(radius - h == Approx(10 + d).epsilon(1e-12));
    }
    SECTION("an arc against its chords") {
        a.at(10, 0, 0).arc(-10, 0, 0, {0, 0, 0}, pi);
        const int n = static_cast<int>(std::ceil(pi / (2 * std::acos(1 - d / 10.0))));
        b.at(10, 0, 0);
        for (int k = 1; k <= n; ++k) b.cut(10 * std::cos(k * pi / n), 10 * std::sin(k * pi / n), 0);
        const double sagitta = 10.0 * (1 - std::cos(pi / n / 2));
        if (!equal && sagitta <= tolerance) return;  // a whole number of chords fell on equal
        CHECK(compare(a, b, options).clusters.empty() == equal);
        return;
    }
    CHECK(compare(a, b, options).clusters.empty() == equal);
}

TEST_CASE("a corner matched too early is left again for one that both paths can go on from",
          "[compare]") {
    // Tolerance 0.005: the first ends lie near each other, but B goes back behind them, which is
    // near the start of A only.
    const double back_mm = GENERATE(-0.004, -0.006);
    const bool goes_on = GENERATE(true, false);
    INFO(back_mm << (goes_on ? ", goes on" : ", ends there"));
    Pen a, b, other_a, other_b;
    for (Pen* pen : {&a, &other_a}) pen->at(0, 0, 0).cut(0.004, 0, 0).cut(10, 0, 0);
    for (Pen* pen : {&b, &other_b})
        pen->at(0, 0, 0).cut(0.002, 0, 0).cut(back_mm, 0, 0).cut(10, 0, 0);
    for (Pen* pen : {&a, &b, &other_a, &other_b})
        if (goes_on) pen->cut(20, 0, 0).cut(30, 0, 0);
    CHECK(compare(a, b).clusters.empty() == (back_mm > -0.005));
    CHECK(compare(other_b, other_a).clusters.empty() == (back_mm > -0.005));
}

TEST_CASE("where one path has ended, short segments of another kind belong to its end",
          "[compare]") {
    const double end_mm = GENERATE(20.003, 20.006);
    Pen a, b;
    for (Pen* pen : {&a, &b}) pen->at(0, 0, 0).cut(10, 0, 0).rapid(20, 0, 0);
    a.cut(20.001, 0, 0).cut(20.002, 0, 0).cut(end_mm, 0, 0);
    CHECK(compare(a, b).clusters.empty() == (end_mm < 20.005));
}

TEST_CASE("0.9 of the direction tolerance is equal and 1.1 differs", "[compare]") {
    const double part_of = GENERATE(0.9, 1.1);
    const double turn = part_of * regression::Tolerances{}.direction_rad;
    Pen a, b;
    a.at(0, 0, 0).cut(10, 0, 0).cut(20, 0, 0);
    b.at(0, 0, 0);
    b.direction = Vector3(std::sin(turn), 0, std::cos(turn));
    b.cut(10, 0, 0);
    b.direction = Vector3::UnitZ();
    b.cut(20, 0, 0);
    CHECK(compare(a, b).clusters.empty() == (part_of < 1.0));
}

TEST_CASE("a clearance changed once in 3000 lines is found at its line", "[compare]") {
    Pen a, b;
    a.at(0, 0, 100);
    b.at(0, 0, 100);
    for (int k = 0; k < 430; ++k)
        for (Pen* pen : {&a, &b}) {
            const double clearance = pen == &b && k == 300 ? 9.906 : 10.0;
            pen->rapid(k, 0, 2).cut(k, 0, -1).cut(k, 30, -1).cut(k + 0.5, 30, -1);
            pen->cut(k + 0.5, 0, -1);
            pen->rapid(k + 0.5, 0, clearance).rapid(k + 1, 0, clearance);
        }
    const regression::PathComparison r = compare(a, b);
    REQUIRE(r.clusters.size() == 1);
    CHECK(r.clusters[0].kind == regression::DifferenceKind::moved);
    CHECK(r.clusters[0].first.shift_mm.z() == Approx(-0.094));
    regression::SegmentWindow segments_a(a.record.segments()), segments_b(b.record.segments());
    CHECK(segments_a[r.clusters[0].first.a.first].line == 300 * 7 + 1 + 6);
    CHECK(segments_b[r.clusters[0].first.b.first].line == 300 * 7 + 1 + 6);
    CHECK(r.totals.position_mm == Approx(0.094));
}

TEST_CASE("passes removed, inserted, reordered are named as such and the rest is equal",
          "[compare]") {
    const auto pass = [](Pen& pen, double x) {
        pen.rapid(x, 0, 10).cut(x, 0, -1).cut(x, 30, -1).rapid(x, 30, 10);
    };
    const auto path = [&](Pen& pen, const std::vector<double>& xs) {
        pen.at(0, 0, 100);
        for (const double x : xs) pass(pen, x);
    };
    Pen a, b;
    path(a, {0, 5, 10, 15, 20});
    SECTION("missing") {
        path(b, {0, 5, 15, 20});
        const regression::PathComparison r = compare(a, b);
        REQUIRE(r.clusters.size() == 1);
        CHECK(r.clusters[0].kind == regression::DifferenceKind::only_a);
        CHECK(r.clusters[0].cut_a_mm == Approx(41));
        CHECK(r.tools.at(0).only_a == 1);
        CHECK(r.tools.at(0).equal == 5);  // the last is the retract behind the last cut
    }
    SECTION("inserted") {
        path(b, {0, 5, 10, 12, 15, 20});
        const regression::PathComparison r = compare(a, b);
        REQUIRE(r.clusters.size() == 1);
        CHECK(r.clusters[0].kind == regression::DifferenceKind::only_b);
    }
    SECTION("reordered") {
        path(b, {0, 10, 15, 5, 20});
        const regression::PathComparison r = compare(a, b);
        REQUIRE(r.clusters.size() == 1);
        CHECK(r.clusters[0].kind == regression::DifferenceKind::reordered);
        CHECK(r.tools.at(0).reordered == 1);
        CHECK(r.tools.at(0).equal == 5);
    }
}

TEST_CASE("two passes in place of two others of other lengths are one difference", "[compare]") {
    const auto pass = [](Pen& pen, double x, double y) {
        pen.rapid(x, 0, 10).cut(x, 0, -1).cut(x, y, -1).rapid(x, y, 10);
    };
    Pen a, b;
    for (Pen* pen : {&a, &b}) {
        pen->at(0, 0, 100);
        pass(*pen, -10, 30);
        pass(*pen, 0, pen == &a ? 100 : 50);
        pen == &a ? pass(a, 5, 20) : pass(b, 0, 100.5);
        pass(*pen, 40, 30);
    }
    const regression::PathComparison r = compare(a, b);
    REQUIRE(r.clusters.size() == 1);
    CHECK(r.clusters[0].kind == regression::DifferenceKind::path);
}

TEST_CASE("behind a moved cut the rapids are compared, and only what the move does not explain",
          "[compare]") {
    // Two cuts; the first one ends at x_mm, the travel between them is at over_mm, and behind the
    // last one at away_mm.
    const auto two_cuts = [](double x_mm, double over_mm, double away_mm) {
        Pen pen;
        pen.at(0, 0, 50).rapid(0, 0, 2).cut(0, 0, 0).cut(x_mm, 0, 0);
        pen.rapid(x_mm, 0, over_mm).rapid(100, 0, over_mm).rapid(100, 0, 2);
        pen.cut(100, 0, 0).cut(100 + x_mm, 0, 0).rapid(100 + x_mm, 0, 50).rapid(away_mm, 40, 50);
        return pen;
    };
    const auto compared = [&](double x_mm, double over_mm, double away_mm) {
        Pen a = two_cuts(10.0, 50.0, 150.0), b = two_cuts(x_mm, over_mm, away_mm);
        return compare(a, b);
    };
    const auto moved = compared(10.06, 50.0, 150.0);
    REQUIRE(moved.clusters.size() == 1);
    CHECK(moved.clusters[0].kind == regression::DifferenceKind::moved);
    CHECK(moved.totals.position_mm == Approx(0.06));
    const auto low = compared(10.06, 3.0, 150.0);
    REQUIRE(low.clusters.size() == 2);
    CHECK(low.clusters[1].kind == regression::DifferenceKind::path);
    CHECK(low.clusters[1].position_mm == Approx(47.0).margin(0.1));
    CHECK(low.totals.position_mm == Approx(47.0).margin(0.1));
    const auto far = compared(10.06, 50.0, 160.0);
    REQUIRE(far.clusters.size() == 2);
    CHECK(far.clusters[1].position_mm == Approx(10.0).margin(0.5));
    CHECK(far.clusters[1].first.a.last == 11);
    CHECK(far.clusters[1].first.a.first == 10);
    CHECK(far.tools.front().changed == 1);
}

TEST_CASE("an arc the other way round has the same ends and differs", "[compare]") {
    Pen a, b;
    a.at(10, 0, 0).arc(-10, 0, 0, {0, 0, 0}, pi).cut(-20, 0, 0);
    b.at(10, 0, 0).arc(-10, 0, 0, {0, 0, 0}, -pi).cut(-20, 0, 0);
    const regression::PathComparison r = compare(a, b);
    REQUIRE(r.clusters.size() == 1);
    CHECK(r.clusters[0].kind == regression::DifferenceKind::path);
    CHECK(r.clusters[0].position_mm == Approx(std::sqrt(200.0)).epsilon(0.01));
    CHECK(r.clusters[0].first.a.last - r.clusters[0].first.a.first == 1);
}

TEST_CASE("a full circle is not nothing, nor two turns one", "[compare]") {
    Pen a, b, c;
    a.at(10, 0, 0).arc(10, 0, 0, {0, 0, 0}, 2 * pi).cut(20, 0, 0);
    b.at(10, 0, 0).cut(20, 0, 0);
    c.at(10, 0, 0).arc(10, 0, 0, {0, 0, 0}, 4 * pi).cut(20, 0, 0);
    CHECK_FALSE(compare(a, b).clusters.empty());
    Pen a2;
    a2.at(10, 0, 0).arc(10, 0, 0, {0, 0, 0}, 2 * pi).cut(20, 0, 0);
    CHECK_FALSE(compare(a2, c).clusters.empty());
}

TEST_CASE("a feed changed by one percent is one difference", "[compare]") {
    Pen a, b;
    part(a, 5);
    b.feed = 505.0;
    part(b, 5);
    const regression::PathComparison r = compare(a, b);
    REQUIRE(r.clusters.size() == 1);
    CHECK(r.clusters[0].kind == regression::DifferenceKind::feed);
    CHECK(r.clusters[0].first.value_b == Approx(505));
    CHECK(r.clusters[0].count == 5);
}

TEST_CASE("a rapid that became a feed differs", "[compare]") {
    Pen a, b;
    a.at(0, 0, 10).rapid(5, 0, 10).rapid(5, 0, 2).cut(5, 0, -1).cut(9, 0, -1).rapid(9, 0, 10);
    b.at(0, 0, 10).rapid(5, 0, 10).cut(5, 0, 2).cut(5, 0, -1).cut(9, 0, -1).rapid(9, 0, 10);
    CHECK_FALSE(compare(a, b).clusters.empty());
}

TEST_CASE("a whole tool moved is one cluster with its shift", "[compare]") {
    Pen a, b;
    a.at(0, 0, 100);
    b.at(0, 0, 100);
    for (Pen* pen : {&a, &b}) {
        const double dz = pen == &b ? -0.05 : 0.0;
        for (int k = 0; k < 40; ++k) {
            pen->tool = k < 20 ? 1 : 2;
            const double z = k < 20 ? 0.0 : dz;
            pen->rapid(k, 0, 10).cut(k, 0, -1 + z).cut(k, 30, -1 + z).cut(k + 0.5, 30, -1 + z);
            pen->rapid(k + 0.5, 30, 10);
        }
    }
    const regression::PathComparison r = compare(a, b);
    REQUIRE(r.clusters.size() == 1);
    CHECK(r.clusters[0].kind == regression::DifferenceKind::moved);
    CHECK(r.clusters[0].tool == 2);
    CHECK(r.clusters[0].first.shift_mm.z() == Approx(-0.05));
    CHECK(r.tools.at(0).moved == 0);
    CHECK(r.tools.at(1).moved == 20);
}

TEST_CASE("a stretch inserted into a long cut is found and the rest is equal", "[compare]") {
    SeededNoise noise(7);
    Pen a, b;
    a.at(0, 0, 0);
    b.at(0, 0, 0);
    for (int k = 0; k < 20000; ++k) {
        const double x = 0.3 * k, y = noise.uniform();
        a.cut(x, y, 0);
        if (k == 9000)
            for (int n = 0; n < 3000; ++n) b.cut(x + noise.uniform(), 5 + noise.uniform(), 3);
        b.cut(x, y, 0);
    }
    const regression::PathComparison r = compare(a, b);
    REQUIRE(r.clusters.size() == 1);
    CHECK(r.clusters[0].first.a.last - r.clusters[0].first.a.first <= 1);
    CHECK(r.clusters[0].first.b.last - r.clusters[0].first.b.first <= 3001);
}

TEST_CASE("a million segments each side take seconds", "[compare]") {
    Pen a, b;
    for (Pen* pen : {&a, &b}) {
        SeededNoise noise(3);
        pen->at(0, 0, 0);
        for (int k = 0; k < 200000; ++k) {
            const double x = noise.uniform() * 100, y = noise.uniform() * 100;
            pen->rapid(x, y, 10).cut(x, y, -1);
            if (pen == &b && k % 2 == 0) pen->cut(x + 0.5, y + 1, -1);
            pen->cut(x + 1, y + 2, -1).cut(x + 1, y, -1).rapid(x + 1, y, 10);
        }
        pen->done();
    }
    const auto start = std::chrono::steady_clock::now();
    const regression::PathComparison r = regression::compare_paths(a.record, b.record, {});
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    CHECK(r.clusters.empty());
    CHECK(took.count() < 5.0);
    WARN("1,000,000 and 1,100,000 segments compared in " << took.count() << " s");
}
