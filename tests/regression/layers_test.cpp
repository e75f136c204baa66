// Each layer by itself, and the tolerances of feed and time at 0.9 and 1.1.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

const std::string part =
    "%\nO1\nN1 G90 G21 G17 G94 G54\nN2 T1 M6\nN3 S500 M3\nN4 G0 B20. C45.\nN5 G0 X10. Y0. Z150.\n"
    "N6 G1 Z140. F200.\nN7 X60. F500.\nN8 Y20.\nN9 G0 Z150.\nN10 #100=3.5\nPOPEN\n"
    "DPRNT[POS#100[34]]\nPCLOS\nN11 M30\n%\n";

regression::Comparison by(regression::Layer layer, const std::string& a, const std::string& b) {
    static const setup::Setup setup = bc_table();
    return compare_texts(a, b, setup, only(layer));
}

}  // namespace

TEST_CASE("each layer alone, with the place of what it finds", "[compare]") {
    struct Row {
        const char *what, *with;
        bool text, words, blocks, path, functions, axes, effects;  ///< equal?
    };
    const Row row = GENERATE(values<Row>({
        {"N7 X60. F500.", "N7 X60. F500.  ", true, true, true, true, true, true, true},
        {"N7 X60. F500.", "N70 F500 X60.0", false, true, true, true, true, true, true},
        {"N7 X60. F500.", "N7 G91 X50. F500.\nG90", false, false, true, true, true, true, true},
        {"N7 X60. F500.", "N7 X30. F500.\nX60.", false, false, false, true, true, true, true},
        {"N7 X60.", "N7 X60.02", false, false, false, false, true, false, true},
        {"F500.", "F510.", false, false, false, false, true, false, false},
        {"#100=3.5", "#100=3.6", false, false, true, true, false, true, false},
        {"DPRNT[POS", "DPRNT[POZ", false, false, true, true, false, true, false},
        {"N9 G0", "N9 G4 X20.\nG0", false, false, false, true, false, false, false},
        {"C45.", "C405.", false, false, false, true, true, false, false},
    }));
    const std::string b = replaced(part, row.what, row.with);
    INFO(row.what << " became " << row.with);
    const auto check = [&](regression::Layer layer, bool equal) {
        const regression::Comparison r = by(layer, part, b);
        INFO(name_of(layer) << ": " << r.verdict);
        CHECK(r.equal == equal);
        CHECK(r.by == layer);
        if (equal || layer == regression::Layer::effects || layer == regression::Layer::axes ||
            layer == regression::Layer::functions)
            return;
        // A dwell in its layer stands at the move before it.
        if (layer == regression::Layer::blocks &&
            std::string(row.with).find("G4") != std::string::npos)
            return;
        // Where the line, block or cut is named it is the edited one, on both sides.
        CHECK(r.differences.front().a.line == line_with(part, row.what));
        CHECK(r.differences.front().b.line == line_with(part, row.what));
    };
    check(regression::Layer::text, row.text);
    check(regression::Layer::words, row.words);
    check(regression::Layer::blocks, row.blocks);
    check(regression::Layer::path, row.path);
    check(regression::Layer::functions, row.functions);
    check(regression::Layer::axes, row.axes);
    check(regression::Layer::effects, row.effects);
    // The default names the first layer that differs, and where it became equal.
    static const setup::Setup setup = bc_table();
    const regression::Comparison r = compare_texts(part, b, setup);
    CHECK(r.equal == (row.path && row.functions));
    CHECK(r.layers.front().layer == regression::Layer::text);
    CHECK(r.layers.front().equal == row.text);
    if (!row.text) CHECK(r.layers.back().layer == r.by);
}

TEST_CASE("the other rotary branch is the same machining and another axis motion", "[compare]") {
    // (B, C) and (-B, C + 180) point the tool alike; own kinematics turns the point with them.
    const auto program = [](double b, double c, double x, double y) {
        return fmt::format(
            "%\nO1\nG90 G21 G17 G94 G54\nT1 M6\nS500 M3\nG43.4 H1\nG0 B{} C{}\n"
            "G0 X{} Y{} Z150.\nG1 Z140. F200.\nX{}\nG0 Z150.\nM30\n%\n",
            b, c, x, y, x + 20.0);
    };
    const setup::Setup setup = bc_table();
    const std::string a = program(20.0, 45.0, 10.0, 5.0), b = program(-20.0, 225.0, 10.0, 5.0);
    const regression::Comparison path = compare_texts(a, b, setup, only(regression::Layer::path));
    INFO(path.verdict);
    CHECK(path.equal);
    const regression::Comparison axes = compare_texts(a, b, setup, only(regression::Layer::axes));
    CHECK_FALSE(axes.equal);
    CHECK(axes.direction_deg >= 180.0);
    // Beyond the travel of B the program stops, and that is the answer.
    const regression::Comparison stops = compare_texts(a, program(120.0, 45.0, 10.0, 5.0), setup);
    CHECK(stops.status == regression::CompareStatus::alarm);
    CHECK(stops.alarm_b.find("500") != std::string::npos);
    CHECK(stops.differences.front().b.line == 7);
}

TEST_CASE("0.9 of the feed, speed and time tolerance is equal and 1.1 differs", "[compare]") {
    const double part_of = GENERATE(0.9, 0.99, 1.01, 1.1);
    const bool equal = part_of < 1.0;
    const setup::Setup setup = bc_table();
    const regression::Tolerances t;
    // Relative to the larger of both values.
    const double feed = 500.0 / (1.0 - part_of * t.feed_ratio);
    const regression::Comparison f =
        compare_texts(part, replaced(part, "F500.", fmt::format("F{:.6f}", feed)), setup,
                      only(regression::Layer::path));
    INFO(f.verdict);
    CHECK(f.equal == equal);
    if (!equal) {
        CHECK(f.differences.front().kind == regression::DifferenceKind::feed);
        CHECK(f.differences.front().a.line == line_with(part, "N7 "));
        CHECK(f.differences.front().a.last_line == line_with(part, "N8 "));
        CHECK(f.differences.front().b.line == line_with(part, "N7 "));
    }
    const std::string fast = replaced(part, "S500", "S100000");
    const double speed = 100000.0 / (1.0 - part_of * t.feed_ratio);
    CHECK(compare_texts(fast, replaced(fast, "S100000", fmt::format("S{:.0f}", speed)), setup,
                        only(regression::Layer::path))
              .equal == equal);
    const double time_s = by(regression::Layer::effects, part, part).time_a_s;
    const double dwell = time_s / (1.0 - part_of * t.time_ratio) - time_s;
    for (const regression::Layer layer : {regression::Layer::axes, regression::Layer::effects}) {
        const regression::Comparison r =
            by(layer, part, replaced(part, "N9 G0", fmt::format("G4 X{:.9f}\nN9 G0", dwell)));
        INFO(r.verdict << " " << time_s << " " << r.time_b_s);
        CHECK(r.equal == equal);
        if (!equal) CHECK(r.differences.front().kind == regression::DifferenceKind::time);
    }
}
