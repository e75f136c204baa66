// Short random paths against an oracle: the distance of two ways walked together, by sampled
// points.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

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
