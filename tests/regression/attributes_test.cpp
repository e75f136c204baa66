// Feed, spindle, coolant and tool of cuts whose paths are equal.
#include <catch2/catch.hpp>

#include "tests/regression/paths.h"

using namespace trunnion;
using namespace trunnion::testing;
using regression::DifferenceKind;

namespace {

/// A straight cut of 60 mm in pieces, with what `change` makes of the piece from 20 to 40 mm.
template <typename Change>
Pen cut_with(int pieces, const Change& change) {
    Pen pen;
    pen.at(0, 0, 0);
    for (int k = 1; k <= pieces; ++k) {
        const double x = 60.0 * k / pieces;
        regression::Segment s = pen.segment(regression::SegmentKind::feed, x, 0, 0);
        if (x > 20.01 && x < 40.01) change(s);
        pen.add(s);
    }
    return pen;
}

template <typename Change>
regression::PathComparison compared(int pieces_a, int pieces_b, const Change& change) {
    Pen a = cut_with(pieces_a, [](regression::Segment&) {}), b = cut_with(pieces_b, change);
    return compare(a, b);
}

}  // namespace

TEST_CASE("a changed attribute is one difference with both values, in whatever pieces",
          "[compare]") {
    const int pieces = GENERATE(3, 6, 60, 7);
    INFO(pieces);
    const auto one = [&](DifferenceKind kind, const auto& change) {
        const regression::PathComparison r = compared(pieces == 7 ? 3 : pieces, pieces, change);
        REQUIRE(r.clusters.size() == 1);
        CHECK(r.clusters[0].kind == kind);
        return std::pair{r.clusters[0].first.value_a, r.clusters[0].first.value_b};
    };
    using Values = std::pair<double, double>;
    CHECK(one(DifferenceKind::feed, [](auto& s) { s.feed_mm_min = 600.0F; }) == Values{500, 600});
    CHECK(one(DifferenceKind::feed, [](auto& s) { s.feed_mm_min = 0.0F; }) == Values{500, 0});
    CHECK(one(DifferenceKind::spindle, [](auto& s) { s.spindle_rpm = 0.0F; }) == Values{8000, 0});
    CHECK(one(DifferenceKind::coolant, [](auto& s) { s.coolant = true; }) == Values{0, 1});
}

TEST_CASE("a second change to another value is a difference of its own", "[compare]") {
    // One side keeps its value, the other goes to two others, one behind the other.
    const auto cut = [](double first, double second, bool is_feed) {
        Pen pen;
        pen.at(0, 0, 0);
        for (int k = 1; k <= 6; ++k) {
            (is_feed ? pen.feed : pen.spindle) = k <= 3 ? first : second;
            pen.cut(10.0 * k, 0, 0);
        }
        return pen;
    };
    const bool is_feed = GENERATE(true, false), b_changes = GENERATE(true, false);
    INFO((is_feed ? "feed" : "spindle") << ", changed in " << (b_changes ? "B" : "A"));
    Pen keeps = cut(500, 500, is_feed), changes = cut(600, 800, is_feed);
    const regression::PathComparison r =
        b_changes ? compare(keeps, changes) : compare(changes, keeps);
    REQUIRE(r.clusters.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) {
        const auto& first = r.clusters[k].first;
        CHECK((b_changes ? first.value_b : first.value_a) == (k == 0 ? 600.0 : 800.0));
    }
}

TEST_CASE("two attributes that change at one place are two differences", "[compare]") {
    const regression::PathComparison r = compared(6, 6, [](auto& s) {
        s.spindle_rpm = 0.0F;
        s.coolant = true;
        s.feed_mm_min = 600.0F;
    });
    REQUIRE(r.clusters.size() == 3);
    CHECK(r.clusters[0].kind == DifferenceKind::spindle);
    CHECK(r.clusters[1].kind == DifferenceKind::coolant);
    CHECK(r.clusters[2].kind == DifferenceKind::feed);
}

TEST_CASE("feeds by time are compared over a stretch, not piece by piece", "[compare]") {
    const auto timed = [](double feed_mm_min) {
        return [feed_mm_min](regression::Segment& s) {
            s.timed = true;
            s.feed_mm_min = static_cast<float>(feed_mm_min);
        };
    };
    CHECK(compared(60, 60, timed(500.0)).clusters.empty());
    CHECK(compared(60, 60, timed(501.0)).clusters.empty());
    const regression::PathComparison r = compared(60, 60, timed(550.0));
    REQUIRE(r.clusters.size() == 1);
    CHECK(r.clusters[0].kind == DifferenceKind::feed);
    CHECK(r.clusters[0].first.value_b == Approx(550.0).epsilon(0.01));
    // Without a feed there is no time.
    CHECK_FALSE(compared(60, 60, timed(0.0)).clusters.empty());
}

TEST_CASE("feeds by time changed by one ratio, but for rounding, are one difference", "[compare]") {
    const auto cut = [](double first_mm_min, double second_mm_min) {
        Pen pen;
        pen.at(0, 0, 0);
        for (int k = 1; k <= 60; ++k) {
            regression::Segment s = pen.segment(regression::SegmentKind::feed, k, 0, 0);
            s.timed = k != 30;  // what is no feed by time ends a stretch
            if (s.timed) s.feed_mm_min = static_cast<float>(k < 30 ? first_mm_min : second_mm_min);
            pen.add(s);
        }
        return pen;
    };
    Pen a = cut(500.0, 300.0), b = cut(550.0, 331.5), c = cut(500.0, 300.0), d = cut(550.0, 300.0),
        e = cut(500.0, 300.0), f = cut(550.0, 390.0);
    CHECK(compare(a, b).clusters.size() == 1);
    CHECK(compare(c, d).clusters.size() == 1);
    CHECK(compare(e, f).clusters.size() == 2);
}

TEST_CASE("a tool that turns in place takes no time that could be compared", "[compare]") {
    const auto turning = [](double feed_mm_min) {
        Pen pen;
        pen.at(0, 0, 0).cut(10, 0, 0);
        regression::Segment s = pen.segment(regression::SegmentKind::feed, 10, 0, 0);
        s.end_orientation = {0.6, 0.0, 0.8};
        s.feed_mm_min = static_cast<float>(feed_mm_min);
        s.timed = s.turning = true;
        pen.add(s);
        pen.direction = Vector3(0.6, 0.0, 0.8);
        pen.cut(20, 0, 0);
        return pen;
    };
    Pen a = turning(500.0), b = turning(900.0);
    CHECK(compare(a, b).clusters.empty());
}

/// Cuts of which every second one takes another way in B.
std::pair<Pen, Pen> detours(int cuts) {
    std::pair<Pen, Pen> pens;
    for (Pen* pen : {&pens.first, &pens.second}) {
        pen->at(0, 0, 10);
        for (int k = 0; k < cuts; ++k) {
            const double x = 10.0 * k;
            pen->rapid(x, 0, 10).cut(x, 0, 0).cut(x + 3, 0, 0);
            if (pen == &pens.second && k % 2 == 1) pen->cut(x + 4, 0.5 + 0.01 * k, 0);
            pen->cut(x + 6, 0, 0).rapid(x + 6, 0, 10);
        }
    }
    return pens;
}

TEST_CASE("more changes than are shown are counted", "[compare]") {
    auto [a, b] = detours(80);
    const auto shown = [&](std::size_t most) {
        return regression::compare_paths(a.done(), b.done(), {}, most);
    };
    const regression::PathComparison all = shown(1000), five = shown(5);
    CHECK(all.clusters.size() == 40);
    CHECK(all.left_out == 0);
    CHECK(five.clusters.size() == 5);
    CHECK(five.left_out == 35);
    CHECK(five.totals.position_mm == all.totals.position_mm);
    // Of one tool at most fifty are told one by one.
    auto [many_a, many_b] = detours(160);
    const regression::PathComparison r = compare(many_a, many_b);
    REQUIRE(r.clusters.size() == 50);
    CHECK(r.clusters.back().count == 31);
}
