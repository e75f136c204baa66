// What becomes of the moves of a control: arcs, turned axes, jumps of the believed tip, controls
// without a five-axis transform.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;
using regression::Layer;

namespace {

/// A machine whose control knows no five-axis transform.
setup::Setup without_transform() {
    setup::Setup setup = bc_table();
    auto& entries = setup.stores.parameters.entry;
    std::erase_if(entries, [](const auto& e) { return e.first >= 19000 && e.first < 20000; });
    return setup;
}

bool equal(const std::string& a, const std::string& b, const setup::Setup& setup,
           Layer layer = Layer::path) {
    const regression::Comparison r = compare_texts(a, b, setup, only(layer));
    INFO(r.verdict);
    CHECK(r.alarm_a == "");
    CHECK(r.alarm_b == "");
    return r.equal;
}

const std::string head = "O1\nG90 G21 G17 G94 G54\nT1 M6\nS500 M3\nG0 X0. Y0. Z200.\n";

}  // namespace

TEST_CASE("without a transform the rotary axes of a move count all the same", "[compare]") {
    const setup::Setup setup = without_transform();
    REQUIRE_FALSE(regression::believed_transform(setup));
    const auto cut = [](const char* rotary) {
        return head + "G0 " + rotary + "\nG1 X20. F300.\nY10.\nG0 Z250.\nM30\n";
    };
    for (const Layer layer : {Layer::path, Layer::axes}) {
        CHECK(equal(cut("B0. C0."), cut("B0. C0. (A)"), setup, layer));
        CHECK_FALSE(equal(cut("B0. C0."), cut("B20. C0."), setup, layer));
        CHECK_FALSE(equal(cut("B0. C0."), cut("B0. C20."), setup, layer));
        CHECK_FALSE(equal(cut("B20. C20."), cut("B20. C-20."), setup, layer));
        CHECK(equal(cut("B20. C20."), replaced(cut("B20. C20."), "G1 X20.", "G1 F300. X9.\nX20."),
                    setup, layer));
    }
    // The tool length moves the tip there too.
    const std::string length = replaced(cut("B20. C0."), "G0 B", "G43 H1\nG0 B");
    CHECK_FALSE(equal(length, replaced(length, "H1", "H2"), setup));
}

TEST_CASE("an arc while an axis turns is a curve of the tip, not an arc", "[compare]") {
    const setup::Setup setup = bc_table();
    const auto helix = [](const char* c, const char* i) {
        return head + fmt::format("G1 Z150. F500.\nG2 X20. Y0. I{} J0. {}\nG0 Z250.\nM30\n", i, c);
    };
    for (const Layer layer : {Layer::path, Layer::axes}) {
        CHECK(equal(helix("C30.", "10."), helix("C30.000", "10."), setup, layer));
        CHECK_FALSE(equal(helix("C30.", "10."), helix("C31.", "10."), setup, layer));
        CHECK_FALSE(equal(helix("C30.", "10."), helix("", "10."), setup, layer));
    }
    // The same curve in two halves: C turns evenly along the way. The speed of the tip is told as
    // the mean of a block, so it is another one in each half; the place is the same.
    const std::string halves = replaced(helix("C30.", "10."), "G2 X20. Y0. I10. J0. C30.",
                                        "G2 X10. Y10. I10. J0. C15.\nG2 X20. Y0. I0. J-10. C30.");
    const regression::Comparison r =
        compare_texts(helix("C30.", "10."), halves, setup, only(Layer::path));
    CHECK(r.position_mm < 1e-3);
    for (const regression::Difference& d : r.differences)
        CHECK(d.kind == regression::DifferenceKind::feed);
}

TEST_CASE("turning about the tip moves nothing, but is machining", "[compare]") {
    const setup::Setup setup = bc_table();
    const auto turn = [](const char* to) {
        return head + fmt::format("G43.4 H1 Z200.\nG1 X5. F500.\nB{}\nG1 X9.\nG49\nM30\n", to);
    };
    CHECK(equal(turn("20."), turn("20.00"), setup));
    CHECK(equal(turn("20."), replaced(turn("20."), "B20.", "B8.\nB20."), setup));
    CHECK_FALSE(equal(turn("20."), turn("20.5"), setup));
}

TEST_CASE("the believed table moved in the middle of a program moves the cuts behind it",
          "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string plain = head + "G0 B20. C30.\nG1 X20. F300.\nY10.\nG1 X0.\nG0 Z250.\nM30\n";
    for (const char* word : {"N19700 R20.", "N19702 R-50.", "N19703 R5."}) {
        INFO(word);
        const std::string moved =
            replaced(plain, "Y10.\n", fmt::format("Y10.\nG10 L52\n{}\nG11\n", word));
        CHECK(equal(moved, moved + " ", setup));
        CHECK_FALSE(equal(plain, moved, setup));
    }
}

TEST_CASE("moves of one side alone are said as such, with the way that they go", "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string a = head + "G43 H1 Z200.\nG1 X20. F300.\nG0 Z250.\nG1 X40.\nG0 Z250.\nM30\n";
    // G49 moves by the length, and G43 back again.
    const std::string b = replaced(a, "G0 Z250.\nG1 X40.", "G0 Z250.\nG49\nG43 H1\nG1 X40.");
    const auto said = [&](const std::string& p, const std::string& q) {
        const regression::Comparison r = compare_texts(p, q, setup, only(Layer::path));
        REQUIRE(r.differences.size() == 1);
        return r.differences[0].what;
    };
    CHECK(said(a, b) == "only in B: moves, up to 150.0000 mm away (T1)");
    CHECK(said(b, a) == "only in A: moves, up to 150.0000 mm away (T1)");
}

TEST_CASE("stores of two days of one machine: seen through the first, every tool with its length",
          "[compare]") {
    const setup::Setup before = bc_table();
    setup::Setup after = before;
    after.stores.tools.tool[1].length_geometry_mm += 0.5;
    REQUIRE(regression::same_machine(before, after));
    const std::string a = head + "G43 H1 Z200.\nG1 X20. F300.\nG0 Z250.\nG49\nG0 Z260.\nM30\n";
    const auto compared = [&](const std::string& b, const setup::Setup& other) {
        return regression::compare_programs(text_of("a.nc", a), before, text_of("b.nc", b), other,
                                            {})
            .equal;
    };
    // With the longer tool the control goes higher; the tip of that tool is where it was.
    CHECK(compared(a, before));
    CHECK_FALSE(compared(a, after));
    // Another axis, direction or place is another machine.
    const auto with = [&](auto change) {
        setup::Setup other = before;
        change(other.machine.chain.work.front());
        return regression::same_machine(before, other);
    };
    CHECK(with([](kinematics::AxisGeometry&) {}));
    CHECK_FALSE(with([](kinematics::AxisGeometry& axis) { axis.axis = Axis::A; }));
    CHECK_FALSE(with([](kinematics::AxisGeometry& axis) { axis.direction *= -1.0; }));
    CHECK_FALSE(with([](kinematics::AxisGeometry& axis) { axis.point_mm.x() += 1e-3; }));
    setup::Setup less = before;
    less.machine.chain.work.pop_back();
    CHECK_FALSE(regression::same_machine(before, less));
}

TEST_CASE("states that a control writes into its words explain a path", "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string plain = head + "G1 Z150. F300.\nG1 X20. Y5.\nX0. Y0.\nG0 Z250.\nM30\n";
    struct Row {
        const char *with, *cause;
    };
    const Row row = GENERATE(values<Row>({
        {"G51 X0. Y0. Z0. I2. J2. K1.\nG1 X20. Y5.", "scaling or mirror (2, 2, 1)"},
        {"G51.1 X0.\nG1 X20. Y5.", "scaling or mirror (-1, 1, 1)"},
        {"G68 X0. Y0. R10.\nG1 X20. Y5.", "G68"},
        {"G52 X1.\nG1 X20. Y5.", "G52"},
        {"G55\nG1 X20. Y5.", "G55"},
        {"G20\nG1 X2. Y.5\nG21", "G20"},
        {"G41 D1\nG1 X20. Y5.\nG40", "D1 instead of D0"},
    }));
    setup::Setup own = setup;
    own.stores.tools.tool[1].radius_geometry_mm = 3.0;
    const std::string b = replaced(plain, "G1 X20. Y5.", row.with);
    const regression::Comparison r = compare_texts(plain, b, own, only(Layer::path));
    INFO(b << r.verdict);
    REQUIRE_FALSE(r.equal);
    CHECK(r.alarm_b == "");
    CHECK(r.differences.front().what.find(row.cause) != std::string::npos);
}
