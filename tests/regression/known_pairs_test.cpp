// Generated pairs with known answers: verdict, layer and place have to be right.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>

#include "base/units.h"
#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

struct Slot {
    double x, y, z;
};

std::string milling(const std::vector<Slot>& passes, const std::string& header = "(DATE 2024)") {
    std::string p = "%\nO1000 " + header +
                    "\nN1 G21 G90 G17 G94 G40 G49 G80\nN2 G54\nN3 T1 M6\n"
                    "N4 S8000 M3\nN5 G0 X0. Y0.\nN6 G43 H1 Z10. M8\n";
    int n = 10;
    for (const Slot& pass : passes) {
        p += fmt::format("N{} G0 X{:.3f} Y{:.3f}\n", n, pass.x, pass.y);
        p += fmt::format("N{} Z2.\nN{} G1 Z{:.3f} F300.\n", n + 1, n + 2, pass.z);
        p += fmt::format("N{} X{:.3f} F500.\n", n + 3, pass.x + 40.0);
        p += fmt::format("N{} G3 X{:.3f} Y{:.3f} I0. J5.\n", n + 4, pass.x + 40.0, pass.y + 10.0);
        p += fmt::format("N{} G1 X{:.3f}\nN{} G0 Z10.\n", n + 5, pass.x, n + 6);
        n += 10;
    }
    return p + "N9990 M9\nN9991 M5\nN9992 M30\n%\n";
}

std::vector<Slot> grid(int count) {
    std::vector<Slot> passes;
    for (int k = 0; k < count; ++k) passes.push_back({0.5 * k, 0.25 * k, -0.5 - 0.01 * k});
    return passes;
}

}  // namespace

TEST_CASE("what does not change machining is equal at its layer", "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string a = milling(grid(10));
    SECTION("the same") {
        CHECK(compare_texts(a, a, setup).by == regression::Layer::text);
    }
    SECTION("line ends and trailing blanks") {
        std::string b;
        for (const char c : a) b += c == '\n' ? std::string("  \r\n") : std::string(1, c);
        const regression::Comparison r = compare_texts(a, b, setup);
        CHECK(r.equal);
        CHECK(r.by == regression::Layer::text);
    }
    SECTION("header date only") {
        const regression::Comparison r = compare_texts(a, milling(grid(10), "(DATE 2026)"), setup);
        CHECK(r.equal);
        CHECK(r.by == regression::Layer::words);
        CHECK(r.layers.front().equal == false);
    }
    SECTION("renumbered, without blanks, other number forms, other word order") {
        std::string b;
        int n = 5;
        for (std::size_t at = 0; at < a.size();) {
            const std::size_t end = a.find('\n', at);
            std::string line = a.substr(at, end - at);
            if (line[0] == 'N') {
                const std::size_t blank = line.find(' ');
                line = "N" + std::to_string(n += 5) + line.substr(blank);
                std::string dense;
                for (const char c : line) dense += c == ' ' ? "" : std::string(1, c);
                line = dense;
            }
            b += line + "\n";
            at = end + 1;
        }
        b = replaced(b, "Z-0.500F300.", "F300.00Z-.5");
        const regression::Comparison r = compare_texts(a, b, setup);
        CHECK(r.equal);
        CHECK(r.by == regression::Layer::words);
    }
    SECTION("long hand and subprogram are equal blocks") {
        const std::string head = "%\nO1\nG90 G21 G17 G94 G54\nT1 M6\nS500 M3\nG0 X0. Y0. Z5.\n";
        const std::string body = "G91 G1 X10. F100.\nY5.\nG90\n";
        const regression::Comparison r =
            compare_texts(head + body + body + "M30\n%\n",
                          head + "M98 P2 L2\nM30\nO2\n" + body + "M99\n%\n", setup);
        CHECK(r.equal);
        CHECK(r.by == regression::Layer::blocks);
    }
    SECTION("inch") {
        std::string b = replaced(a, "G21", "G20");
        std::string inch;
        for (std::size_t at = 0; at < b.size();) {
            const std::size_t end = b.find('\n', at);
            const std::string line = b.substr(at, end - at);
            for (std::size_t k = 0; k < line.size();) {
                const bool word = std::string("XYZIJF").find(line[k]) != std::string::npos &&
                                  line[0] == 'N' && k > 0;
                inch += line[k++];
                if (!word) continue;
                std::size_t used = 0;
                const double value = std::stod(line.substr(k), &used);
                inch += fmt::format("{:.5f}", value / 25.4);
                k += used;
            }
            inch += "\n";
            at = end + 1;
        }
        const regression::Comparison r = compare_texts(a, inch, setup);
        CHECK(r.equal);
        CHECK(r.by == regression::Layer::path);
    }
}

TEST_CASE("every change of machining is named with its place", "[compare]") {
    const setup::Setup setup = bc_table();
    const std::vector<Slot> passes = grid(400);
    const std::string a = milling(passes);
    const auto first = [](const regression::Comparison& r) {
        REQUIRE_FALSE(r.equal);
        REQUIRE(r.by == regression::Layer::path);
        REQUIRE_FALSE(r.differences.empty());
        return r.differences.front();
    };
    SECTION("one clearance of 2,800 lines") {
        const std::string b = replaced(a, "N2016 G0 Z10.", "N2016 G0 Z9.906");
        const regression::Comparison r = compare_texts(a, b, setup);
        const regression::Difference d = first(r);
        CHECK(r.differences.size() == 1);
        CHECK(d.kind == regression::DifferenceKind::moved);
        CHECK(d.shift_mm[2] == Approx(-0.094));
        CHECK(d.a.line == line_with(a, "N2016 "));
        CHECK(d.b.line == d.a.line);
        CHECK(d.b.block == "N2016 G0 Z9.906");
        CHECK(r.position_mm == Approx(0.094));
    }
    SECTION("one arc reversed") {
        const std::string b = replaced(a, "N1014 G3", "N1014 G2");
        const regression::Difference d = first(compare_texts(a, b, setup));
        CHECK(d.kind == regression::DifferenceKind::path);
        CHECK(d.a.line == line_with(a, "N1014 "));
        CHECK(d.b.line == line_with(a, "N1014 "));
        CHECK(d.a.last_line == d.a.line);
    }
    SECTION("feed by one percent in one block") {
        const std::string b = replaced(a, "N1003 X89.500 F500.", "N1003 X89.500 F505.");
        // Modal: it holds until the next F.
        const regression::Comparison r = compare_texts(a, b, setup);
        const regression::Difference d = first(r);
        CHECK(r.differences.size() == 1);
        CHECK(d.kind == regression::DifferenceKind::feed);
        CHECK(d.value_a == Approx(500));
        CHECK(d.value_b == Approx(505));
        CHECK(d.a.line == line_with(a, "N1003 "));
        CHECK(d.b.line == line_with(a, "N1003 "));
        CHECK(d.a.last_line == line_with(a, "N1005 "));
    }
    SECTION("a pass missing") {
        std::vector<Slot> fewer = passes;
        fewer.erase(fewer.begin() + 100);
        const regression::Comparison r = compare_texts(a, milling(fewer), setup);
        const regression::Difference d = first(r);
        CHECK(r.differences.size() == 1);
        CHECK(d.kind == regression::DifferenceKind::only_a);
        CHECK(d.a.line == line_with(a, "N1012 "));
        CHECK(d.a.last_line == line_with(a, "N1015 "));
        CHECK(d.b.line == d.a.line);  // before the pass that follows there
        CHECK(r.tools.front().cut_a_mm - r.tools.front().cut_b_mm ==
              Approx(2.0 + 1.5 + 80.0 + 5.0 * pi));
    }
    SECTION("passes reordered") {
        std::vector<Slot> other = passes;
        std::swap(other[50], other[51]);
        const regression::Comparison r = compare_texts(a, milling(other), setup);
        const regression::Difference d = first(r);
        CHECK(r.differences.size() == 1);
        CHECK(d.kind == regression::DifferenceKind::reordered);
        // The same plunge, ten numbers and a pass of seven lines apart.
        CHECK(d.a.block.substr(d.a.block.find(' ')) == d.b.block.substr(d.b.block.find(' ')));
        CHECK(std::abs(d.a.line - d.b.line) == 7);
        CHECK(std::min(d.a.line, d.b.line) == line_with(a, "N512 "));
        CHECK(r.tools.front().cut_a_mm == Approx(r.tools.front().cut_b_mm));
    }
    SECTION("merge markers in one file") {
        const std::string b = replaced(a, "N1014 G3", "<<<<<<< HEAD\nN1014 G3");
        const regression::Comparison r = compare_texts(a, b, setup);
        CHECK(r.status == regression::CompareStatus::alarm);
        CHECK(r.differences.front().kind == regression::DifferenceKind::alarm);
        CHECK(r.differences.front().b.line == line_with(b, "<<<<<<<"));
        CHECK(r.differences.front().b.block == "<<<<<<< HEAD");
        CHECK(r.differences.front().a.line == 0);
        CHECK(regression::exit_code({"", true, {r}}) == 3);
    }
}

TEST_CASE("C by 360 degrees is the same machining and another axis motion", "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string a =
        "%\nO1\nG90 G21 G17 G94 G54\nT1 M6\nS500 M3\nG0 X10. Y0. Z5.\nG0 C30.\nG1 X20. "
        "F100.\nM30\n%\n";
    const std::string b = replaced(a, "C30.", "C390.");
    CHECK(compare_texts(a, b, setup).equal);
    CHECK(compare_texts(a, b, setup).by == regression::Layer::path);
    const regression::Comparison axes = compare_texts(a, b, setup, only(regression::Layer::axes));
    CHECK_FALSE(axes.equal);
    CHECK(axes.differences.front().direction_deg == Approx(360.0));
    CHECK_FALSE(compare_texts(a, replaced(a, "C30.", "C30.02"), setup).equal);
}

TEST_CASE("a program of offsets alone is compared by its effects", "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string a = "%\nO1\nG90 G10 L2 P1 X10. Y20. Z30.\n#100=3.5\nM30\n%\n";
    CHECK(compare_texts(a, replaced(a, "X10. Y20.", "Y20.0 X10."), setup).equal);
    const regression::Comparison r = compare_texts(a, replaced(a, "Y20.", "Y20.1"), setup);
    CHECK_FALSE(r.equal);
    CHECK(r.by == regression::Layer::effects);
    CHECK(r.differences.front().what == "G54 Y: 20 -> 20.1");
}

TEST_CASE("U V W count with the axis that they run beside", "[compare]") {
    std::vector<std::string> notes;
    const setup::Setup setup =
        setup::parse_setup("[machine]\nchain = \"w W b X Y Z t\"\n", "mill.toml", notes);
    const std::string head = "O1\nG21 G90 G94 G54\nG0 X0 Y0 Z50. W0\n", end = "M30\n";
    const std::string by_z = head + "G1 Z20. F500.\nX40.\n" + end;
    CHECK(compare_texts(by_z, head + "G1 W-30. F500.\nX40.\n" + end, setup).equal);
    const regression::Comparison without = compare_texts(by_z, head + "X40. F500.\n" + end, setup);
    CHECK_FALSE(without.equal);
    const regression::Comparison less =
        compare_texts(by_z, head + "G1 W-29. F500.\nX40.\n" + end, setup);
    CHECK_FALSE(less.equal);
    CHECK(less.position_mm == Approx(1.0));
}
