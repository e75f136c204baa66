// Faults that posts have, seeded in a small post's output: found, the block named, the cause said.
#include <catch2/catch.hpp>
#include <sstream>

#include "tests/regression/programs.h"
#include "tests/regression/small_post.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

struct Fault {
    const char *name, *what, *with;
    const char* cause;  ///< stands in the difference's sentence
};

/// `what` occurs once in every part; the block that holds it is the culprit.
constexpr Fault faults[] = {
    {"H of another tool", "G43 H2", "G43 H1", "H1 instead of H2"},
    {"work offset", "G55\n", "G54.1 P1\n", "G54.1 P1 instead of G55"},
    {"work offset missing", "G55\n", "", "G55 is missing"},
    {"other side", "G41 D1", "G42 D1", "G42 instead of G41"},
    {"other radius", "G41 D1", "G41 D2", "D2 instead of D1"},
    {"no compensation", "G41 D1 X", "X", "G41"},
    {"compensation left on", "G40 X-", "X-", "G40 is missing"},
    {"spindle not started", "S{half} M3", "S{half}", "M3 is missing"},
    {"other speed", "S{half} M3", "S999 M3", "S999 instead of"},
    {"other direction", "S{half} M3", "S{half} M4", "M4"},
    {"no coolant", "H2 Z160. M8", "H2 Z160.", "M8 is missing"},
    {"no inverse time", "G93\n", "", "G93 is missing"},
    {"inverse time left on", "\nG94\nG0", "\nG0", "G94"},
    {"absolute centre", " I-{r} J0.", " I{xr} J{x}", "absolute"},
    {"other arc", "G3 X", "G2 X", "G2 instead of G3"},
    {"other plane", "G43 H1", "G18 G43 H1", "G18"},
    {"inch", "T2 M6", "G20 T2 M6", "G20"},
    {"incremental", "G0 X0. Y0.\nG43 H3", "G91 G0 X0. Y0.\nG43 H3", "G91"},
    {"decimal point", "Q3.", "Q3", "decimal point"},
    {"store", "G10 L2 P2 X5.", "G10 L2 P2 X5.5", "X5.5 instead of X5."},
    {"level after the cycle", "G98 G82", "G99 G82", "G99 instead of G98"},
    {"no dwell", "G98 G82", "G98 G81", "dwell 0.3 s is missing"},
    {"other dwell", "P300", "P30", "dwell 0.3 s -> 0.03 s"},
    {"no length", "G43 H2 Z160.", "Z160.", "H2 is missing"},
    {"other tool", "T2 M6", "T4 M6", "T4"},
    {"clearance", "\nG43 H3 Z160.", "\nG43 H3 Z150.", "Z150. instead of Z160."},
    {"depth of a cycle", "Z135. R145.", "Z153. R145.", "Z153. instead of Z135."},
    {"hole added", "\nG80\nG99", "\nX200.\nG80\nG99", "only in B"},
    {"tilt", "J{tilt} K0.", "J-{tilt} K0.", "of opposite sign"},
    {"axes exchanged", "X5. Y5.\nZ150.", "X5. Y-5.\nZ150.", "Y of opposite sign"},
    {"feed", "F120.", "F1200.", "F1200"},
    {"tool axis not turned", "G53.1\n", "", "G53.1"},
    {"stop", "T3 M6", "M0\nT3 M6", "M0 is only in B"},
    {"clamp", "T3 M6", "M10\nT3 M6", "M10 is only in B"},
    {"exact stop", "\nG93\n", "\nG61 G93\n", "exact stop"},
    {"high speed mode", "\nG93\n", "\nG5.1 Q1\nG93\n", "G5.1 Q1 is only in B"},
    {"variable", "T3 M6", "#500=1.\nT3 M6", "#500"},
    {"digit", "Y15.", "Y16.", "Y16. instead of Y15."},
    {"block missing", "\nY15.\n", "\n", "Y15."},
    {"retract missing", "\nY15.\nG0 Z180.\n", "\nY15.\n", "G0 Z180."},
};

std::string filled(std::string text, const SmallPart& p) {
    const auto put = [&text](const std::string& name, const std::string& value) {
        for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name))
            text.replace(at, name.size(), value);
    };
    put("{half}", fmt::format("{:.0f}", 0.5 * p.speed));
    put("{tilt}", fmt::format("{:.3f}", p.tilt_deg));
    put("{r}", fmt::format("{:.3f}", p.radius));
    put("{xr}", fmt::format("{:.3f}", p.side - p.radius));
    put("{x}", fmt::format("{:.3f}", p.side));
    return text;
}

setup::Setup bench_mill() {
    setup::Setup setup = bc_table();
    for (std::size_t k = 1; k <= 4; ++k) {
        setup.stores.tools.tool[k].length_geometry_mm = 100.0 + 10.0 * static_cast<double>(k);
        setup.stores.tools.tool[k].radius_geometry_mm = 3.0 + static_cast<double>(k);
    }
    setup.stores.work.additional[0][Axis::X] = 12.0;
    return setup;
}

/// First line that differs in the texts, on both sides.
int first_edited(const std::string& a, const std::string& b) {
    std::istringstream in_a(a), in_b(b);
    std::string line_a, line_b;
    for (int n = 1; std::getline(in_a, line_a) && std::getline(in_b, line_b); ++n)
        if (line_a != line_b) return n;
    return 0;
}

bool names(const regression::Comparison& r, int line) {
    if (r.differences.empty()) return false;
    const regression::Difference& d = r.differences.front();
    return d.a.line == line || d.b.line == line;
}

bool says(const regression::Comparison& r, const std::string& words) {
    return std::any_of(
        r.differences.begin(), r.differences.end(),
        [&](const regression::Difference& d) { return d.what.find(words) != std::string::npos; });
}

}  // namespace

TEST_CASE("the small post's parts run, and each is its own machining again", "[compare]") {
    const setup::Setup setup = bench_mill();
    for (const std::uint64_t seed : {1, 2, 3}) {
        const std::string text = small_post(small_part(seed));
        const regression::Comparison r =
            compare_texts(text, text, setup, only(regression::Layer::path));
        INFO(r.verdict << "\n" << text);
        CHECK(r.equal);
        CHECK(r.compared > 30);
    }
}

TEST_CASE("40 seeded faults: all are found, 95 percent by block, 80 percent by cause",
          "[compare]") {
    const setup::Setup setup = bench_mill();
    int count = 0, found = 0, placed = 0, caused = 0;
    std::string missed;
    for (const Fault& fault : faults) {
        const SmallPart p = small_part(static_cast<std::uint64_t>(++count));
        const std::string a = small_post(p);
        const std::string b = replaced(a, filled(fault.what, p), filled(fault.with, p));
        const regression::Comparison r = compare_texts(a, b, setup);
        INFO(fault.name << ": " << r.verdict);
        CHECK_FALSE(r.equal);
        const bool place = names(r, first_edited(a, b));
        const bool cause = fault.cause[0] != '\0' && says(r, fault.cause);
        found += r.equal ? 0 : 1;
        placed += place ? 1 : 0;
        caused += cause ? 1 : 0;
        if (!place || !cause)
            missed += fmt::format("\n  {} (line {}): {}{}{}", fault.name, first_edited(a, b),
                                  place ? "" : "[place] ", cause ? "" : "[cause] ", r.verdict);
    }
    WARN(count << " faults: " << found << " found, " << placed << " by block, " << caused
               << " by cause" << missed);
    CHECK(count == 40);
    CHECK(100 * placed >= 95 * count);
    CHECK(100 * caused >= 80 * count);
}

TEST_CASE("one cause is one difference", "[compare]") {
    const setup::Setup setup = bench_mill();
    const std::string a = small_post(small_part(7));
    for (const auto& [what, with] : std::vector<std::pair<std::string, std::string>>{
             {"G43 H2", "G43 H1"}, {"G41 D1", "G42 D1"}, {"G55\n", "G54.1 P1\n"}}) {
        const regression::Comparison r = compare_texts(a, replaced(a, what, with), setup);
        std::string all;
        for (const regression::Difference& d : r.differences)
            all += fmt::format("\n  {} (A {}, B {})", d.what, d.a.line, d.b.line);
        INFO(with << ": " << r.verdict << all);
        CHECK(r.differences.size() == 1);
    }
}

TEST_CASE("five shifts are one pivot that moved, or one length", "[compare]") {
    const setup::Setup setup = bc_table();
    const Vector3 true_pivot = Vector3::Zero();
    const std::string a = own_kinematics_post(true_pivot, 0.0);
    const Vector3 moved(0.25, -0.18, 0.31);
    const regression::Comparison r = compare_texts(a, own_kinematics_post(true_pivot + moved, 0.0),
                                                   setup, only(regression::Layer::path));
    INFO(r.verdict);
    CHECK_FALSE(r.equal);
    CHECK(says(r, "one pivot moved by (0.2500, -0.1800, 0.31"));
}
