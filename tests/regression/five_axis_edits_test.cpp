// Random edits and harmless rewrites of a five-axis program (G43.4, G68.2, G93, arcs in three
// planes), judged by a plain reader that shares nothing with the control.
#include <catch2/catch.hpp>

#include "tests/regression/five_axis_reader.h"
#include "tests/regression/programs.h"
#include "tests/regression/random_edit.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

const std::string original = R"(%
O5000
G21 G90 G17 G94 G40 G49 G80
G54
T1 M6
S8000 M3
G0 X0. Y0. Z300.
G0 B0. C0.
G43.4 H1
G0 X-20. Y0. Z30.
M8
G1 Z12. F400.
X-10. Z11. B12. C15. F900.
X0. Y4. Z10. B16. C40.
G93
X8. Y6. Z11. B14. C60. F60.
X15. Y3. Z12. B10. C80. F50.
G94
X20. Y0. Z13. F700.
G0 Z60.
G49
G0 X0. Y0. Z300.
B0. C0.
M9
G43 H1 Z80.
G0 X10. Y10.
M7
Z30.
G1 Z20. F300.
G18 G2 X18. Z28. I8. K0. F350.
G19 G3 Y18. Z36. J0. K8. F360.
G17 G3 X10. Y10. I0. J-8. F370.
G1 X0. F380.
G0 Z80.
G49
G0 Z300.
G68.2 X5. Y5. Z20. I30. J15. K10.
G53.1
G43 H1 Z60.
G0 X0. Y0.
Z10.
G1 Z5. F250.
X12. F640.
Y9.
S7000
X0. F650.
G0 Z60.
M9
M5
M30
%
)";

constexpr std::array<const char*, 24> blocks{
    "G0 Z55.", "G1 X12. F450.", "G93", "G94",   "M3",    "M4",  "M5",    "M8",
    "M9",      "G17",           "G18", "G19",   "F333.", "B5.", "C30.",  "G1",
    "G0",      "X7.",           "Z9.", "S5000", "Y-3.",  "G49", "G53.1", "G69"};
constexpr std::array<const char*, 16> codes{"G0",  "G1",  "G2",    "G3",  "G17",   "G18",
                                            "G19", "G43", "G43.4", "G49", "G53.1", "G69",
                                            "G93", "G94", "M4",    "M9"};
const EditChoices choices{blocks, codes, "XYZBCIJKFS"};

/// A table with B and C that cross at machine zero; everything that the control believes is true.
setup::Setup crossing_table() {
    std::vector<std::string> notes;
    setup::Setup setup = setup::parse_setup(R"([machine]
chain = "w C B b X Y Z t"
axis.B = { direction = [0, -1, 0], point_mm = [0, 0, 0], limits_deg = [-110, 110] }
axis.C = { direction = [0, 0, -1], point_mm = [0, 0, 0] }
axis.X = { direction = [1, 0, 0] }
axis.Y = { direction = [0, 1, 0] }
axis.Z = { direction = [0, 0, 1] }
[control.tools]
1 = { length_mm = 100.0 }
)",
                                            "crossing.toml", notes);
    return setup;
}

FiveAxisReader read(const std::string& program) {
    FiveAxisReader reader;
    reader.run(program);
    return reader;
}

bool same_values(const TableMove& p, const TableMove& q, double allowed) {
    if (p.rapid || q.rapid) return p.rapid == q.rapid;
    return p.by_time == q.by_time && std::abs(p.feed - q.feed) <= allowed * p.feed &&
           std::abs(p.spindle - q.spindle) <= allowed * std::abs(p.spindle) &&
           p.coolant == q.coolant && p.tool == q.tool;
}

/// Tips and axes at the same share of the way, worst of all: mm, rad.
std::array<double, 2> apart(const TableMove& p, const TableMove& q) {
    if (p.points.size() != q.points.size()) return {1e9, 1e9};
    std::array<double, 2> worst{};
    for (std::size_t k = 0; k < p.points.size(); ++k) {
        worst[0] = std::max(worst[0], (p.points[k].tip_mm - q.points[k].tip_mm).norm());
        worst[1] = std::max(worst[1], (p.points[k].axis - q.points[k].axis).norm());
    }
    return worst;
}

double distance(const Vector3& p, const Vector3& from, const Vector3& to) {
    const Vector3 way = to - from;
    const double length2 = way.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp((p - from).dot(way) / length2, 0.0, 1.0) : 0.0;
    return (from + t * way - p).norm();
}

constexpr double far_mm = 0.05, far_rad = 2e-3;

/// The point lies on none of the moves with the same values: not near, or with another axis.
bool off(const TablePoint& p, const TableMove& of, const std::vector<TableMove>& others) {
    for (const TableMove& o : others) {
        if (!same_values(of, o, 0.02)) continue;
        for (std::size_t n = 0; n < o.points.size(); ++n) {
            const Vector3& from = o.points[n > 0 ? n - 1 : 0].tip_mm;
            if (distance(p.tip_mm, from, o.points[n].tip_mm) < far_mm &&
                (p.axis - o.points[n].axis).norm() < 0.05)
                return false;
        }
    }
    return true;
}

/// Some point of a cut lies off all cuts of the other side that have the same values.
bool leaves(const std::vector<TableMove>& moves, const std::vector<TableMove>& others) {
    for (const TableMove& m : moves)
        for (const TablePoint& p : m.points)
            if (!m.rapid && off(p, m, others)) return true;
    return false;
}

enum class Opinion { same, changed, none };

Opinion opinion(const FiveAxisReader& a, const FiveAxisReader& b) {
    if (b.unsure) return Opinion::none;
    if (leaves(a.moves, b.moves) || leaves(b.moves, a.moves)) return Opinion::changed;
    if (a.moves.size() != b.moves.size()) return Opinion::none;
    bool same = true, turned = false;
    for (std::size_t k = 0; k < a.moves.size(); ++k) {
        const auto [mm, rad] = apart(a.moves[k], b.moves[k]);
        same = same && mm < 1e-3 && rad < 1e-4 && same_values(a.moves[k], b.moves[k], 0.004);
        // The tip stays on its way while the axis points elsewhere.
        turned = turned || (!a.moves[k].rapid && mm < far_mm && rad > far_rad);
    }
    return turned ? Opinion::changed : same ? Opinion::same : Opinion::none;
}

struct Counts {
    int changed = 0, same = 0, none = 0, false_equal = 0, false_different = 0;
};

Counts run_edits(std::uint64_t seed, int wanted) {
    const setup::Setup setup = crossing_table();
    const FiveAxisReader truth = read(original);
    REQUIRE_FALSE(truth.unsure);
    REQUIRE(truth.moves.size() > 25);
    SeededNoise noise(seed);
    Counts n;
    while (n.changed + n.same < wanted) {
        std::string what;
        const std::string b = edited(original, choices, noise, what);
        const Opinion o = opinion(truth, read(b));
        if (o == Opinion::none) {
            ++n.none;
            continue;
        }
        const regression::Comparison r = compare_texts(original, b, setup);
        // M codes that no cut meets differ by `functions`; the reader says nothing of them.
        const bool equal = r.equal || (o == Opinion::same && r.by == regression::Layer::functions);
        ++(o == Opinion::changed ? n.changed : n.same);
        INFO("seed " << seed << ", " << what << ": " << r.verdict);
        if (o == Opinion::changed && equal) {
            ++n.false_equal;
            CHECK_FALSE(r.equal);
        }
        if (o == Opinion::same && !equal) {
            ++n.false_different;
            WARN("seed " << seed << ", " << what << ": " << r.verdict);
        }
    }
    return n;
}

void say(const Counts& n) {
    WARN(n.changed + n.same << " edits of five axes judged: " << n.changed << " change machining, "
                            << n.false_equal << " of them called equal; " << n.same << " do not, "
                            << n.false_different << " of them called different; " << n.none
                            << " more not judged");
    CHECK(n.false_equal == 0);
    CHECK(n.changed > n.same / 4);
}

}  // namespace

TEST_CASE("150 random edits of five axes: none that changes machining is equal", "[compare]") {
    say(run_edits(20260711, 150));
}

TEST_CASE("2000 random edits of five axes: none that changes machining is equal",
          "[.assure][compare]") {
    say(run_edits(3, 2000));
}

TEST_CASE("rewrites of five axes that change nothing are equal", "[compare]") {
    const setup::Setup setup = crossing_table();
    const auto [what, with] = GENERATE(table<std::string, std::string>({
        // A block of G43.4 cut in two: tip and angles are linear along both.
        {"X-10. Z11. B12. C15. F900.", "X-15. Z11.5 B6. C7.5 F900.\nX-10. Z11. B12. C15."},
        // The plane turned about its own Z, its coordinates with it.
        {"I30. J15. K10.", "I30. J15. K10. (K)"},
        {"G68.2 X5. Y5. Z20. I30. J15. K10.\nG53.1\nG43 H1 Z60.\nG0 X0. Y0.\nZ10.\nG1 Z5. "
         "F250.\nX12. F640.\nY9.\nS7000\nX0. F650.",
         "G68.2 X5. Y5. Z20. I30. J15. K100.\nG53.1\nG43 H1 Z60.\nG0 X0. Y0.\nZ10.\nG1 Z5. "
         "F250.\nY-12. F640.\nX9.\nS7000\nY0. F650."},
        // Inverse time as the feed of the tip: lengths 8.3066 and 7.6811 mm.
        {"G93\nX8. Y6. Z11. B14. C60. F60.\nX15. Y3. Z12. B10. C80. F50.\nG94",
         "X8. Y6. Z11. B14. C60. F498.397\nX15. Y3. Z12. B10. C80. F384.057"},
        // An arc by its radius, its centre from the other side of the block, a full word order.
        {"G18 G2 X18. Z28. I8. K0. F350.", "G2 G18 F350. K0. I8. Z28. X18."},
        {"G17 G3 X10. Y10. I0. J-8. F370.", "G17 G3 X10. Y10. R8. F370."},
        {"X20. Y0. Z13. F700.", "X17.5 Y1.5 Z12.5 F700.\nX20. Y0. Z13. B10. C80."},
    }));
    const std::string b = replaced(original, what, with);
    const regression::Comparison r =
        compare_texts(original, b, setup, only(regression::Layer::path));
    INFO(with << ": " << r.verdict);
    CHECK(r.equal);
}

TEST_CASE("C written a full turn on is the same machining", "[compare]") {
    std::string b = original;
    for (const char* c : {"C0.\nG43.4", "C15.", "C40.", "C60.", "C80.", "C0.\nM9"}) {
        const std::string old = c;
        const std::size_t end = old.find('.');
        b = replaced(
            b, old, fmt::format("C{}{}", std::stoi(old.substr(1, end - 1)) + 360, old.substr(end)));
    }
    const regression::Comparison r =
        compare_texts(original, b, crossing_table(), only(regression::Layer::path));
    INFO(r.verdict);
    CHECK(r.equal);
}
