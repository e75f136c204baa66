// Random single edits of every kind, judged by the plain reader: nothing that changes motion, feed,
// spindle, coolant, dwell or tool is called equal.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "base/random.h"
#include "tests/regression/plain_interpreter.h"
#include "tests/regression/programs.h"
#include "tests/regression/random_edit.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

const std::string base = R"(%
O1000
G21 G90 G17 G94 G40 G80
G54
T1 M6
S8000 M3
G0 X0. Y0.
G43 H1 Z20.
M8
G0 X5. Y5.
Z2.
G4 P300
G1 Z-1. F300.
X45. F800.
Y25.
G3 X35. Y35. I-10. J0.
G1 X5.
Y5.
G0 Z10.
X60. Y10.
Z1.
G1 Z-2. F250.
G2 X60. Y10. I8. J0.
G91 G1 X4. Y3.
X-2. Y6.
G90 G1 X70. Y40. Z-1.
G0 Z20.
M9
M5
T2
M1
M6
S3000 M3
G55
G43 H2 Z20.
M7
G0 X10. Y10.
G98 G82 X10. Y10. Z-6. R2. P400 F120.
X20.
X30. Y15.
G80
G54
G0 X0. Y50.
G20
G1 Z-.1 F8.
G21
G2 X10. Y60. I10. J0. F500.
G1 X40.
G2 X50. Y50. I0. J-10.
G1 Y30. F650.
M0
S3500
M4
G1 Y20. F650.
G0 Z30.
M9
M5
M30
%
)";

constexpr std::array<double, 3> g55_mm{4.0, -3.0, 1.0};

constexpr std::array<const char*, 28> blocks{
    "G0 Z15.", "G1 X12. F450.", "G4 P700", "M3",  "M4",  "M5",  "M8",  "M9",  "M7",  "M0",
    "M1",      "S5000",         "F333.",   "G90", "G91", "G20", "G21", "G54", "G55", "G80",
    "G98",     "G99",           "T3",      "M6",  "G0",  "G1",  "X7.", "Z-3."};
constexpr std::array<const char*, 18> codes{"G0",  "G1",  "G2",  "G3",  "G20", "G21",
                                            "G54", "G55", "G80", "G81", "G82", "G90",
                                            "G91", "G98", "G99", "M3",  "M5",  "M9"};

const EditChoices choices{blocks, codes, "XYZIJFSTHPR"};

struct Judged {
    bool sure = true, stopped = false;
    std::vector<PlainMove> moves;
    std::vector<PlainFunction> functions;
};

Judged judged(const std::string& program, const setup::Setup& setup) {
    const offsets::OffsetVector& g54 = setup.stores.work.standard[0];
    PlainInterpreter reader({g54[Axis::X], g54[Axis::Y], g54[Axis::Z]}, {{1, 100.0}, {2, 80.0}},
                            g55_mm);
    reader.run(program);
    return {!reader.unsure, reader.stopped, std::move(reader.moves), std::move(reader.functions)};
}

/// Length along moves of one kind and one set of values, and where points of it lie.
double far_apart(const PlainMove& p, const PlainMove& q) {
    if (p.tips_mm.size() != q.tips_mm.size()) return 1e9;
    double worst = 0.0;
    for (std::size_t k = 0; k < p.tips_mm.size(); ++k)
        for (std::size_t d = 0; d < 3; ++d)
            worst = std::max(worst, std::abs(p.tips_mm[k][d] - q.tips_mm[k][d]));
    return worst;
}

/// Feed and speed within `allowed` of each other, the rest alike.
bool same_values(const PlainMove& p, const PlainMove& q, double allowed = 0.006) {
    if (p.rapid != q.rapid) return false;
    if (p.rapid) return true;
    return std::abs(p.feed - q.feed) <= allowed * p.feed &&
           std::abs(p.spindle - q.spindle) <= allowed * std::abs(p.spindle) && p.tool == q.tool &&
           p.coolant == q.coolant;
}

double from_segment(const std::array<double, 3>& p, const std::array<double, 3>& from,
                    const std::array<double, 3>& to) {
    double along = 0.0, length2 = 0.0, rest2 = 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
        along += (p[d] - from[d]) * (to[d] - from[d]);
        length2 += (to[d] - from[d]) * (to[d] - from[d]);
    }
    const double t = length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
        const double rest = from[d] + t * (to[d] - from[d]) - p[d];
        rest2 += rest * rest;
    }
    return std::sqrt(rest2);
}

/// Some point of `moves` lies off all moves of `others` that have the same values.
bool off_path(const std::vector<PlainMove>& moves, const std::vector<PlainMove>& others) {
    for (const PlainMove& m : moves)
        for (std::size_t k = 0; k<m.tips_mm.size(); k += m.tips_mm.size()> 2 ? 15 : 1) {
            double least = 1e9;
            for (const PlainMove& o : others)
                for (std::size_t n = 1; n < o.tips_mm.size() && same_values(m, o); ++n)
                    least =
                        std::min(least, from_segment(m.tips_mm[k], o.tips_mm[n - 1], o.tips_mm[n]));
            if (least > 0.02) return true;
        }
    return false;
}

enum class Opinion { same, changed, no_opinion };

/// The same codes in the same order; dwells within `allowed` of each other.
bool same_functions(const std::vector<PlainFunction>& a, const std::vector<PlainFunction>& b,
                    double allowed) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [allowed](const PlainFunction& p, const PlainFunction& q) {
                          const double least = p.kind == 'D' ? allowed * p.value : 0.0;
                          return p.kind == q.kind && p.moves_before == q.moves_before &&
                                 std::abs(p.value - q.value) <= least;
                      });
}

/// Functions without those that only set a state which moves show, and without what is repeated.
std::vector<PlainFunction> grave(const std::vector<PlainFunction>& all) {
    std::vector<PlainFunction> left;
    for (const PlainFunction& f : all)
        if (f.kind == 'D' || (f.kind == 'M' && (f.value < 3.0 || f.value == 6.0 || f.value > 9.0)))
            left.push_back(f);
    return left;
}

/// What lies next to a tolerance (feed and speed 0.5 percent, dwells 1) is not judged.
Opinion opinion(const Judged& a, const Judged& b) {
    if (!b.sure) return Opinion::no_opinion;
    if (b.stopped) return Opinion::changed;
    // Only the same moves one by one are the same for sure; moves may also be cut otherwise.
    if (a.moves.size() != b.moves.size())
        return off_path(a.moves, b.moves) || off_path(b.moves, a.moves) ? Opinion::changed
                                                                        : Opinion::no_opinion;
    bool alike = true;
    for (std::size_t k = 0; k < a.moves.size(); ++k) {
        const double far = far_apart(a.moves[k], b.moves[k]);
        if (far > 0.01 || !same_values(a.moves[k], b.moves[k])) return Opinion::changed;
        alike = alike && far <= 0.001 && same_values(a.moves[k], b.moves[k], 0.004);
    }
    if (!same_functions(grave(a.functions), grave(b.functions), 0.011)) return Opinion::changed;
    return alike && same_functions(a.functions, b.functions, 0.009) ? Opinion::same
                                                                    : Opinion::no_opinion;
}

struct Counts {
    int changed = 0, same = 0, not_judged = 0, false_equal = 0, false_different = 0;
};

Counts run_edits(std::uint64_t seed, int wanted) {
    setup::Setup setup = bc_table();
    setup.stores.tools.tool[1].length_geometry_mm = 100.0;
    setup.stores.tools.tool[2].length_geometry_mm = 80.0;
    for (std::size_t k = 0; k < 3; ++k) setup.stores.work.standard[1][all_axes[k]] = 0.0;
    setup.stores.work.standard[1][Axis::X] = g55_mm[0];
    setup.stores.work.standard[1][Axis::Y] = g55_mm[1];
    setup.stores.work.standard[1][Axis::Z] = g55_mm[2];
    const Judged truth = judged(base, setup);
    REQUIRE(truth.sure);
    REQUIRE_FALSE(truth.stopped);
    SeededNoise noise(seed);
    Counts n;
    regression::CompareOptions options;
    options.max_blocks = 3000;
    while (n.changed + n.same < wanted) {
        std::string what;
        const std::string b = edited(base, choices, noise, what);
        const Opinion o = opinion(truth, judged(b, setup));
        if (o == Opinion::no_opinion) {
            ++n.not_judged;
            continue;
        }
        const regression::Comparison r = compare_texts(base, b, setup, options);
        const bool changed = o == Opinion::changed;
        ++(changed ? n.changed : n.same);
        if (changed == !r.equal) continue;
        ++(changed ? n.false_equal : n.false_different);
        INFO("seed " << seed << ", " << what << ": " << r.verdict);
        CHECK(changed == !r.equal);
    }
    return n;
}

void say(const Counts& n) {
    WARN(n.changed + n.same << " edits judged: " << n.changed << " change machining, "
                            << n.false_equal << " of them called equal; " << n.same << " do not, "
                            << n.false_different << " of them called different; " << n.not_judged
                            << " more not judged");
    CHECK(n.false_equal == 0);
}

}  // namespace

TEST_CASE("300 random edits of every kind: none that changes machining is equal", "[compare]") {
    say(run_edits(20260701, 300));
}

TEST_CASE("5000 random edits of every kind: none that changes machining is equal",
          "[.assure][compare]") {
    Counts all;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Counts n = run_edits(seed, 500);
        all.changed += n.changed;
        all.same += n.same;
        all.not_judged += n.not_judged;
        all.false_equal += n.false_equal;
        all.false_different += n.false_different;
    }
    say(all);
}
