// Short random paths against an oracle: the distance of two ways walked together, by sampled
// points.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "base/random.h"
#include "base/units.h"
#include "tests/regression/paths.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

constexpr double tolerance_mm = 0.25, step_mm = 0.02;

/// A line, or a half circle in XY to the left (+) or right (-) of the way.
struct Stroke {
    Vector3 to_mm;
    int half_circle = 0;
    bool rapid = false;
};
using Strokes = std::vector<Stroke>;

std::size_t draw(SeededNoise& noise, std::size_t below) {
    return static_cast<std::size_t>(noise.bits() % below);
}

/// On a small grid, so that places are met again, ways go back, and points repeat.
Strokes random_strokes(SeededNoise& noise, bool arcs) {
    Strokes strokes(2 + draw(noise, 7));
    for (Stroke& s : strokes) {
        s.to_mm = Vector3(double(draw(noise, 3)), double(draw(noise, 3)), 0.0);
        if (arcs && draw(noise, 4) == 0) s.half_circle = draw(noise, 2) == 0 ? 1 : -1;
    }
    strokes.front().to_mm.x() = 2.0;  // a path without a single move has a test of its own
    return strokes;
}

Pen drawn(const Strokes& strokes) {
    Pen pen;
    pen.at(0, 0, 0);
    Vector3 from = Vector3::Zero();
    for (const Stroke& s : strokes) {
        const Vector3 centre = 0.5 * (from + s.to_mm);
        if (s.half_circle != 0 && from != s.to_mm)
            pen.arc(s.to_mm.x(), s.to_mm.y(), 0, centre, -s.half_circle * pi);
        else if (s.rapid)
            pen.rapid(s.to_mm.x(), s.to_mm.y(), 0);
        else
            pen.cut(s.to_mm.x(), s.to_mm.y(), 0);
        from = s.to_mm;
    }
    return pen;
}

std::vector<Vector3> sampled(const Strokes& strokes) {
    std::vector<Vector3> points{Vector3::Zero()};
    for (const Stroke& s : strokes) {
        const Vector3 from = points.back(), way = s.to_mm - from;
        const double length = way.norm() * (s.half_circle != 0 ? pi / 2.0 : 1.0);
        const int count = 1 + static_cast<int>(length / step_mm);
        const Vector3 centre = 0.5 * (from + s.to_mm), arm = from - centre;
        for (int k = 1; k <= count; ++k) {
            const double part = static_cast<double>(k) / count, angle = -s.half_circle * pi * part;
            const Vector3 turned(arm.x() * std::cos(angle) - arm.y() * std::sin(angle),
                                 arm.x() * std::sin(angle) + arm.y() * std::cos(angle), 0.0);
            points.push_back(s.half_circle != 0 ? Vector3(centre + turned)
                                                : Vector3(from + part * way));
        }
        points.back() = s.to_mm;
    }
    return points;
}

/// The discrete Frechet distance: at most `step_mm` above that of the ways.
double oracle_mm(const Strokes& a, const Strokes& b) {
    const auto p = sampled(a), q = sampled(b);
    std::vector<double> row(q.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
        double corner = 0.0;
        for (std::size_t j = 0; j < q.size(); ++j) {
            const double here = (p[i] - q[j]).norm(), above = row[j];
            const double before = i == 0 && j == 0 ? 0.0
                                  : i == 0         ? row[j - 1]
                                  : j == 0         ? above
                                                   : std::min({above, corner, row[j - 1]});
            corner = above;
            row[j] = std::max(here, before);
        }
    }
    return row.back();
}

/// The same way in other pieces, and with one change. `doubles_back`: a way to and fro beyond the
/// tolerance; it is told even where waiting half way on the other path would stay within it.
Strokes edited(Strokes strokes, SeededNoise& noise, bool& doubles_back) {
    const std::size_t at = draw(noise, strokes.size());
    Stroke& s = strokes[at];
    const double by = tolerance_mm * (0.2 + 0.2 * static_cast<double>(draw(noise, 12)));
    switch (draw(noise, 6)) {
        case 0: s.to_mm.x() += by; break;
        case 1: s.to_mm.y() -= by; break;
        case 2: strokes.insert(strokes.begin() + static_cast<long>(at), s); break;
        case 3: strokes.erase(strokes.begin() + static_cast<long>(at)); break;
        case 4: s.half_circle = -s.half_circle; break;
        default: {
            doubles_back = by > tolerance_mm;
            const Stroke out{s.to_mm + Vector3(by, 0.0, 0.0), 0}, back{s.to_mm, 0};
            const auto behind = strokes.begin() + static_cast<long>(at) + 1;
            strokes.insert(behind, {out, back});
        }
    }
    Strokes pieces;
    Vector3 from = Vector3::Zero();
    for (const Stroke& stroke : strokes) {
        if (stroke.half_circle == 0 && draw(noise, 3) == 0)
            pieces.push_back({from + 0.3 * (stroke.to_mm - from), 0});
        pieces.push_back(stroke);
        from = stroke.to_mm;
    }
    return pieces;
}

}  // namespace

TEST_CASE("random paths are equal where the ways walked together stay within the tolerance",
          "[compare]") {
    const bool arcs = GENERATE(false, true);
    SeededNoise noise(arcs ? 71 : 70);
    regression::WalkOptions options;
    options.tolerances.position_mm = tolerance_mm;
    int equal = 0, other = 0;
    for (int n = 0; n < 1500; ++n) {
        bool doubles_back = false;
        const Strokes a = random_strokes(noise, arcs), b = edited(a, noise, doubles_back);
        const double apart_mm = oracle_mm(a, b);
        Pen pen_a = drawn(a), pen_b = drawn(b), again_a = drawn(a), again_b = drawn(b);
        const bool found = compare(pen_a, pen_b, options).clusters.empty();
        INFO("path " << n << " arcs " << arcs << ", " << apart_mm << " mm apart");
        // Arcs are compared to within a chord of them.
        const bool near = apart_mm < (arcs ? 0.75 : 0.95) * tolerance_mm;
        const bool far = apart_mm > 1.1 * tolerance_mm;
        if (near && !doubles_back) CHECK(found);
        if (far) CHECK_FALSE(found);
        if (near || far) CHECK(compare(again_b, again_a, options).clusters.empty() == found);
        equal += near ? 1 : 0;
        other += far ? 1 : 0;
    }
    CHECK(equal > 300);
    CHECK(other > 300);
}

namespace {

/// Some strokes as rapids, and one to three short ones of either kind somewhere, often at the end.
Strokes with_rapids(Strokes strokes, SeededNoise& noise) {
    for (Stroke& s : strokes) s.rapid = draw(noise, 3) == 0;
    return strokes;
}

Strokes with_short_strokes(Strokes strokes, SeededNoise& noise) {
    const std::size_t at = draw(noise, 2) == 0 ? strokes.size() : 1 + draw(noise, strokes.size());
    const Vector3 from = strokes[at - 1].to_mm;
    Strokes more(1 + draw(noise, 3));
    for (Stroke& s : more) {
        const double reach_mm = tolerance_mm * (draw(noise, 8) == 0 ? 1.6 : 0.6);
        s.to_mm = from + reach_mm * Vector3(noise.uniform() - 0.5, noise.uniform() - 0.5, 0.0);
        s.rapid = draw(noise, 2) == 0;
    }
    if (draw(noise, 2) == 0) more.back().to_mm = from;
    strokes.insert(strokes.begin() + static_cast<long>(at), more.begin(), more.end());
    return strokes;
}

}  // namespace

TEST_CASE("A against B says equal just where B against A does, rapids and short moves included",
          "[compare]") {
    const char* const seed = std::getenv("TRUNNION_PATH_SEED");
    SeededNoise noise(seed ? std::strtoull(seed, nullptr, 10) : 72);
    regression::WalkOptions options;
    options.tolerances.position_mm = tolerance_mm;
    int equal = 0, different = 0;
    for (int n = 0; n < 4000; ++n) {
        const bool arcs = draw(noise, 3) == 0;
        const Strokes a = with_rapids(random_strokes(noise, arcs), noise),
                      b = with_short_strokes(a, noise);
        Pen pen_a = drawn(a), pen_b = drawn(b), again_a = drawn(a), again_b = drawn(b);
        const bool found = compare(pen_a, pen_b, options).clusters.empty();
        const double apart_mm = oracle_mm(a, b);
        INFO("path " << n << ", " << apart_mm << " mm apart");
        CHECK(compare(again_b, again_a, options).clusters.empty() == found);
        if (apart_mm > 1.1 * tolerance_mm) CHECK_FALSE(found);
        Strokes other = b;  // a long way by the other kind of motion is told, beside short ones too
        Stroke& changed = other[draw(noise, other.size())];
        changed.rapid = !changed.rapid;
        const std::size_t k = static_cast<std::size_t>(&changed - other.data());
        const Vector3 from = k == 0 ? Vector3(Vector3::Zero()) : other[k - 1].to_mm;
        if (changed.half_circle == 0 && (changed.to_mm - from).norm() > 4.0 * tolerance_mm) {
            Pen flat_a = drawn(a), flat_b = drawn(other), flat_c = drawn(a), flat_d = drawn(other);
            CHECK_FALSE(compare(flat_a, flat_b, options).clusters.empty());
            CHECK_FALSE(compare(flat_d, flat_c, options).clusters.empty());
        }
        ++(found ? equal : different);
    }
    CHECK(equal > 300);
    CHECK(different > 100);
}

namespace {

/// The same way in pieces shorter than the tolerance, some of them by the other kind of motion.
Strokes chopped(const Strokes& strokes, SeededNoise& noise, double share_of_other) {
    Strokes pieces;
    Vector3 from = Vector3::Zero();
    for (const Stroke& s : strokes) {
        const Vector3 way = s.to_mm - from;
        const int count =
            1 + static_cast<int>(way.norm() / ((0.3 + 0.5 * noise.uniform()) * tolerance_mm));
        for (int k = 1; k <= count; ++k)
            pieces.push_back({from + static_cast<double>(k) / count * way, 0,
                              (noise.uniform() < share_of_other) != s.rapid});
        from = s.to_mm;
    }
    return pieces;
}

}  // namespace

TEST_CASE("a cut with short rapids in it is told from both sides or from none", "[compare]") {
    const double share = GENERATE(0.0, 0.05, 0.5);
    SeededNoise noise(73);
    regression::WalkOptions options;
    options.tolerances.position_mm = tolerance_mm;
    int equal = 0;
    for (int n = 0; n < 500; ++n) {
        const Strokes a = random_strokes(noise, false), b = chopped(a, noise, share);
        Pen pen_a = drawn(a), pen_b = drawn(b), again_a = drawn(a), again_b = drawn(b);
        const bool found = compare(pen_a, pen_b, options).clusters.empty();
        INFO("path " << n << ", share " << share);
        CHECK(compare(again_b, again_a, options).clusters.empty() == found);
        equal += found ? 1 : 0;
    }
    if (share == 0.0) CHECK(equal == 500);
    if (share == 0.5) CHECK(equal < 5);
    if (share == 0.05) CHECK(equal < 150);
}

TEST_CASE("a cut in which short rapids alternate with short cuts is told from both sides",
          "[compare]") {
    regression::WalkOptions options;
    options.tolerances.position_mm = tolerance_mm;
    for (const double piece_mm : {0.05, 0.1, 0.2}) {
        Pen cut, mixed, cut2, mixed2;
        for (Pen* pen : {&cut, &cut2}) {
            pen->at(0, 0, 0);
            for (int k = 2; k <= 80; k += 2) pen->cut(k * piece_mm, 0, 0);
        }
        for (Pen* pen : {&mixed, &mixed2}) {
            pen->at(0, 0, 0);
            for (int k = 1; k <= 80; ++k)
                k % 2 == 1 ? pen->cut(k * piece_mm, 0, 0) : pen->rapid(k * piece_mm, 0, 0);
        }
        INFO(piece_mm);
        CHECK_FALSE(compare(cut, mixed, options).clusters.empty());
        CHECK_FALSE(compare(mixed2, cut2, options).clusters.empty());
    }
}

TEST_CASE("paths without a single move", "[compare]") {
    Pen none, also_none, some;
    none.at(0, 0, 0);
    also_none.at(5, 0, 0);
    some.at(0, 0, 0).cut(1, 0, 0);
    CHECK(compare(none, also_none).clusters.empty());
    const regression::PathComparison r = compare(none, some);
    REQUIRE(r.clusters.size() == 1);
    CHECK(r.clusters[0].kind == regression::DifferenceKind::only_b);
    Pen none2, some2;
    none2.at(0, 0, 0);
    some2.at(0, 0, 0).cut(1, 0, 0);
    const regression::PathComparison s = compare(some2, none2);
    REQUIRE(s.clusters.size() == 1);
    CHECK(s.clusters[0].kind == regression::DifferenceKind::only_a);
}
