// Causes that several differences share: one length, one frame.
#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/regression/programs.h"
#include "tests/regression/small_post.h"

using namespace trunnion;
using namespace trunnion::testing;

TEST_CASE("shifts along the tool in five poses are one length", "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string a = own_kinematics_post(Vector3::Zero(), 0.0);
    for (const double length_mm : {22.756, -3.5, 0.05}) {
        const regression::Comparison r =
            compare_texts(a, own_kinematics_post(Vector3::Zero(), length_mm), setup,
                          only(regression::Layer::path));
        INFO(r.verdict);
        REQUIRE_FALSE(r.equal);
        const std::string said =
            fmt::format("the length along the tool differs by {:.4f} mm", length_mm);
        CHECK(r.differences.front().what.find(said) != std::string::npos);
        CHECK(r.differences.size() == 1);
    }
}

TEST_CASE("a pose that only rapid moves visit is part of one moved pivot, its own fault is not",
          "[compare]") {
    const setup::Setup setup = bc_table();
    // The shift grows with the turn: a rapid visit at C180 shows ten times what the cuts show.
    const auto post = [](const Vector3& pivot_mm, double fault_mm) {
        const std::string cuts = own_kinematics_post(pivot_mm, 0.0, 0.15);
        const Matrix3 turned = rotation_about(-Vector3::UnitZ(), pi);
        const auto at = [&](double x, double y) {
            const Vector3 p = turned * (Vector3(x, y, 150.0) - pivot_mm) + pivot_mm;
            return fmt::format("X{:.4f} Y{:.4f} Z{:.4f}\n", p.x() + fault_mm, p.y(), p.z());
        };
        return replaced(cuts, "G0 Z200.\nM5\n",
                        "G0 Z200.\nG0 B0 C180.\n" + at(10.0, 5.0) + at(40.0, 5.0) + "Z200.\nM5\n");
    };
    const std::string a = post(Vector3::Zero(), 0.0);
    const Vector3 moved_mm(1.0, 0.5, 0.0);
    const regression::Comparison r =
        compare_texts(a, post(moved_mm, 0.0), setup, only(regression::Layer::path));
    INFO(r.verdict);
    REQUIRE_FALSE(r.equal);
    for (const auto& d : r.differences) UNSCOPED_INFO(d.what);
    CHECK(r.differences.size() == 1);
    CHECK(r.differences.front().what.find("one pivot moved by (1.000") != std::string::npos);
    const regression::Comparison other =
        compare_texts(a, post(moved_mm, 3.0), setup, only(regression::Layer::path));
    for (const auto& d : other.differences) UNSCOPED_INFO(d.what);
    CHECK(other.differences.size() == 2);
}

TEST_CASE("shifts that no length and no pivot explains are said one by one", "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string a = own_kinematics_post(Vector3::Zero(), 0.0);
    // The third section alone is shifted, by a fault of its own.
    const std::size_t at = a.find("B20.000 C60.000");
    std::string b = a;
    for (std::size_t k = b.find("X", at), n = 0; n < 5; k = b.find("X", k + 1), ++n) {
        const std::size_t end = b.find(' ', k);
        b.replace(k, end - k, fmt::format("X{:.4f}", std::stod(b.substr(k + 1, end - k)) + 0.4));
    }
    const regression::Comparison r = compare_texts(a, b, setup, only(regression::Layer::path));
    INFO(r.verdict);
    REQUIRE_FALSE(r.equal);
    for (const regression::Difference& d : r.differences) {
        CHECK(d.what.find("one pivot") == std::string::npos);
        CHECK(d.what.find("length along the tool") == std::string::npos);
    }
}

TEST_CASE("an orientation of a tilted plane is a cause only where it differs", "[compare]") {
    const setup::Setup setup = bc_table();
    const auto cut = [](const char* angles, const char* shift) {
        return fmt::format(
            "O1\nG90 G21 G94 G54 G40 G49\nG52 {}\nG68.2 X0 Y0 Z0 {}\nG0 X10. Y5. Z150.\n"
            "G1 X40. F500.\nY30.\nG0 Z200.\nM30\n",
            shift, angles);
    };
    const auto said = [&](const std::string& a, const std::string& b) {
        std::string text;
        for (const auto& d : compare_texts(a, b, setup, only(regression::Layer::path)).differences)
            text += d.what + "\n";
        return text;
    };
    // A quarter turn about Z at once, or in two halves: the same plane but for the rounding.
    const std::string at_once = cut("I90. J0 K0", "X0"), halves = cut("I45. J0 K45.", "X0");
    CHECK(said(at_once, halves).empty());
    const std::string orientation = "another orientation of the tilted plane";
    const std::string shifted = said(at_once, cut("I45. J0 K45.", "X1."));
    INFO(shifted);
    CHECK_FALSE(shifted.empty());
    CHECK(shifted.find(orientation) == std::string::npos);
    CHECK(said(at_once, cut("I60. J0 K0", "X0")).find(orientation) != std::string::npos);
}

TEST_CASE("a side that indexes before G43.4 gets the hint of the frame, the other does not",
          "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string cut = "G0 X10. Y0. Z60.\nG1 Z50. F300.\nX20. B{0} C{1}\nG0 Z150.\nG49\nM30\n";
    const std::string head = "O1\nG90 G21 G94 G54 G40 G49\nT2 M6\nS5000 M3\nG0 X0. Y0. Z300.\n";
    const std::string turned =
        head + "G0 B20. C30.\nG43.4 H2 Z150.\n" + fmt::format(fmt::runtime(cut), "25.", "40.");
    const std::string straight =
        head + "G43.4 H2 Z150.\nG0 B20. C30.\n" + fmt::format(fmt::runtime(cut), "25.", "40.");
    const auto hints = [](const regression::Comparison& r) {
        std::string all;
        for (const std::string& note : r.notes)
            if (note.find("begins with the rotary axes at") != std::string::npos) all += note;
        return all;
    };
    const regression::Comparison r = compare_texts(turned, straight, setup);
    INFO(r.verdict);
    CHECK_FALSE(r.equal);
    CHECK(hints(r).starts_with(fmt::format(
        "A line {}: G43.4 begins with the rotary axes at A0 B20 C30", line_with(turned, "G43.4"))));
    CHECK(hints(r).find("tcp_frame") != std::string::npos);
    CHECK(hints(r).find("B line") == std::string::npos);
    CHECK(hints(compare_texts(straight, replaced(straight, "X20.", "X21."), setup)).empty());
}

// The later change stands three lines behind the block that moves.
TEST_CASE("a changed variable moves the path, not a coolant code behind it", "[compare]") {
    const std::string a =
        "O1\nG21 G90 G54\n#1=5.\nG0 X0 Y0 Z10.\nG1 X#1 Y10. F500.\nM8\n"
        "G1 X20. Y30.\nM30\n";
    const std::string b = replaced(replaced(a, "#1=5.", "#1=6."), "M8", "M7");
    const regression::Comparison r = compare_texts(a, b, bc_table(), only(regression::Layer::path));
    INFO(r.verdict);
    REQUIRE_FALSE(r.differences.empty());
    CHECK(r.differences.front().what.starts_with("#1=6. instead of #1=5.: moved by X+1.0000 mm"));
    for (const regression::Difference& d : r.differences)
        if (d.what.find("M7") != std::string::npos)
            CHECK(d.what.find("moved") == std::string::npos);
}

TEST_CASE("operations in another order are one difference with both places", "[compare]") {
    const setup::Setup setup = bc_table();
    // 400 pockets; the last twenty move to the front.
    const auto pocket = [](int n) {
        return fmt::format("G0 X{0}. Y{1}.\nZ5.\nG1 Z-1. F200.\nX{2}. F500.\nY{3}.\nG0 Z30.\n",
                           n % 20 * 10, n / 20 * 10, n % 20 * 10 + 6, n / 20 * 10 + 6);
    };
    const auto program = [&](bool other_order) {
        std::string text = "O1\nG90 G21 G94 G54\nT1 M6\nS500 M3\nG0 X0. Y0. Z30.\n";
        for (int k = 0; k < 400; ++k) text += pocket(other_order ? (k + 380) % 400 : k);
        return text + "M30\n";
    };
    const std::string a = program(false), b = program(true);
    regression::CompareOptions options = only(regression::Layer::path);
    const regression::Comparison r = compare_texts(a, b, setup, options);
    INFO(r.verdict);
    CHECK_FALSE(r.equal);
    REQUIRE(r.differences.size() == 1);
    const regression::Difference& d = r.differences.front();
    CHECK(d.kind == regression::DifferenceKind::reordered);
    CHECK(d.what.starts_with("passes reordered: 20 passes"));
    CHECK(d.count == 20);
    CHECK(d.a.line == line_with(a, pocket(380)) + 2);
    CHECK(d.b.line == line_with(b, pocket(380)) + 2);
    CHECK(r.tools.front().reordered == 20);
}
