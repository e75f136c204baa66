// Pairs that were called equal and are not, and some that were called different and are not.
#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "interpreter/program_folders.h"
#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

/// Two tools, a contour with G41, drilling; every function a post writes.
const std::string part = R"(%
O1
G21 G90 G17 G94 G40 G49 G80
G54
T1 M6
S8000 M3
G0 X-20. Y-20.
G43 H1 Z20. M8
Z2.
G1 Z-1. F300.
G41 D1 X0. Y-10. F800.
Y25.
G3 X-10. Y35. I-10. J0.
G1 X-30.
G40 X-40. Y45.
G1 X-45. F800.
G0 Z20.
M9
M5
T2 M6
S3000 M3
G0 X10. Y10.
G43 H2 Z20. M8
G98 G82 X10. Y10. Z-6. R2. P500 F120.
X20.
G80
G0 Z20.
M9
M5
G91 G28 Z0.
G90
M30
%
)";

setup::Setup mill() {
    setup::Setup setup = bc_table();
    setup.stores.tools.tool[1].length_geometry_mm = 100.0;
    setup.stores.tools.tool[1].radius_geometry_mm = 5.0;
    setup.stores.tools.tool[2].length_geometry_mm = 80.0;
    return setup;
}

/// The one difference of functions between `part` and an edit of it.
regression::Comparison by_function(const std::string& what, const std::string& with) {
    const setup::Setup setup = mill();
    const regression::Comparison r = compare_texts(part, replaced(part, what, with), setup);
    INFO(what << " became " << with << ": " << r.verdict);
    CHECK_FALSE(r.equal);
    CHECK(r.by == regression::Layer::functions);
    REQUIRE_FALSE(r.differences.empty());
    CHECK(r.differences.size() == 1);
    return r;
}

}  // namespace

TEST_CASE("words that repeat a number are not the same words where a mode changed", "[compare]") {
    const setup::Setup setup = mill();
    const auto differ = [&](const std::string& a, const std::string& b) {
        const regression::Comparison r =
            compare_texts("O1\n" + a + "M30\n", "O1\n" + b + "M30\n", setup);
        INFO(b << r.verdict);
        CHECK_FALSE(r.equal);
        CHECK_FALSE(compare_texts("O1\n" + a + "M30\n", "O1\n" + b + "M30\n", setup,
                                  only(regression::Layer::words))
                        .equal);
    };
    differ("G90 G21 G94\nG41 D1 G1 X10. F100.\nX20.\nG40 X30.\nX40. Y5.\n",
           "G90 G21 G94\nG41 D1 G1 X10. F100.\nX20.\nX30.\nX40. Y5.\n");  // a forgotten G40
    differ("G90 G21 G93\nG1 X10. F20.\nX20. F20.\n", "G90 G21 G93\nG1 X10. F20.\nX20.\n");
    differ("G90 G21 G93\nG1 X10. F20.\nG94 X20. F20.\n", "G90 G21 G93\nG1 X10. F20.\nG94 X20.\n");
    differ("G90 G21 G94\nG1 X10. F200.\nG20 X10. F20.\n", "G90 G21 G94\nG1 X10. F200.\nG20 F20.\n");
    differ("G90 G21 G94\nG1 X5. F200.\nG91 G90 X10.\n",
           "G90 G21 G94\nG1 X5. F200.\nG90 G91 X10.\n");
    differ("G10 L50\nN1815 R1.\nG11\nG0 X1.\n", "G10 L50\nN1816 R1.\nG11\nG0 X1.\n");
}

TEST_CASE("a mode that is repeated is the same words", "[compare]") {
    const setup::Setup setup = mill();
    const std::string a = "O1\nG90 G21 G94 G40\nG1 X10. F100.\nX20. Y5.\nG0 Z5.\nM30\n";
    const std::string b =
        "O1\nG90 G21 G94 G40\nG1 X10.0 F100\nG1 X20. Y5.0 F100. (here)\nG90 G0 Z5. X20.\nM30\n";
    const regression::Comparison r = compare_texts(a, b, setup);
    INFO(r.verdict);
    CHECK(r.equal);
    CHECK(r.by == regression::Layer::words);
}

TEST_CASE("a called program that differs is a difference", "[compare]") {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / "trunnion_called_programs";
    const auto write = [&](const char* name, const std::string& text) {
        fs::create_directories((folder / name).parent_path());
        std::ofstream(folder / name) << text;
    };
    const std::string main = "O1\nG90 G21 G94 G54\nS500 M3\nM98 P2\nM30\n";
    for (const char* side : {"a", "b", "c"}) write((std::string(side) + "/main.nc").c_str(), main);
    write("a/O2.nc", "O2\nG1 X10. F100.\nX20.\nM99\n");
    write("b/O2.nc", "O2\nG1 X10. F100.\nX21.\nM99\n");
    write("c/O2.nc", "O2\n(a remark)\nG1 X10. F100.\nX20.0\nM99\n");
    const setup::Setup setup = mill();
    const auto compare = [&](const char* b, regression::CompareOptions options = {}) {
        return regression::compare_programs(
            interpreter::read_program((folder / "a/main.nc").string()), setup,
            interpreter::read_program((folder / b / "main.nc").string()), setup, options);
    };
    const regression::Comparison r = compare("b");
    INFO(r.verdict);
    CHECK_FALSE(r.equal);
    CHECK_FALSE(r.layers.front().equal);
    CHECK_FALSE(compare("b", only(regression::Layer::text)).equal);
    CHECK_FALSE(compare("b", only(regression::Layer::words)).equal);
    CHECK(compare("b", only(regression::Layer::words)).differences.front().b.program ==
          (folder / "b/O2.nc").string());
    CHECK(compare("c").equal);
    CHECK(compare("c").by == regression::Layer::words);
    CHECK(compare("a").by == regression::Layer::text);
    fs::remove_all(folder);
}

TEST_CASE("functions are part of the verdict, each at its place", "[compare]") {
    CHECK(by_function("G0 Z20.\nM9\nM5\nT2", "G0 Z20.\nG4 P500\nM9\nM5\nT2").differences[0].what ==
          "dwell 0.5 s is only in B");
    CHECK(by_function("P500", "P900").differences[0].what == "dwell 0.5 s -> 0.9 s");
    CHECK(
        by_function("G82 X10. Y10. Z-6. R2. P500", "G81 X10. Y10. Z-6. R2.").differences[0].what ==
        "dwell 0.5 s is missing in B");
    for (const char* code : {"M10", "M29", "M88", "M0"}) {
        const regression::Comparison r = by_function("Z2.\n", std::string("Z2.\n") + code + "\n");
        CHECK(r.differences[0].b.block == code);
        CHECK(r.differences[0].kind == regression::DifferenceKind::function);
    }
    CHECK(by_function("G1 X-45. F800.\n", "G9 G1 X-45. F800.\n").differences[0].what ==
          "exact stop (G9, G61) is only in B");
    CHECK(by_function("Z2.\n", "Z2.\nG5.1 Q1\n").differences[0].what == "G5.1 Q1 is only in B");
    CHECK(by_function("G98", "G10 L2 P3 X5.\nG98").differences[0].what ==
          "G10 that writes a store is only in B");
    CHECK(by_function("M9\nM5\nG91", "M5\nG91").differences[0].what == "M9 is missing in B");
}

TEST_CASE("M3 is missing behind a tool change although the emulated spindle turns on",
          "[compare]") {
    const setup::Setup setup = mill();
    const std::string a = replaced(part, "M9\nM5\nT2", "M9\nT2");
    const regression::Comparison r = compare_texts(a, replaced(a, "S3000 M3\n", "S3000\n"), setup);
    INFO(r.verdict);
    CHECK(r.by == regression::Layer::functions);
    REQUIRE(r.differences.size() == 1);
    CHECK(r.differences[0].what == "M3 is missing in B");
    CHECK(r.differences[0].a.block == "S3000 M3");
}

TEST_CASE("a function at another place of the path is a difference, one block or two is not",
          "[compare]") {
    const regression::Comparison r = by_function("G0 Z20.\nM9\n", "M9\nG0 Z20.\n");
    CHECK(r.differences[0].what == "M9 stands at another place of the path");
    CHECK(r.differences[0].a.block == "M9");
    const setup::Setup setup = mill();
    for (const auto& [what, with] :
         std::vector<std::pair<std::string, std::string>>{{"S8000 M3", "S8000\nM3"},
                                                          {"T1 M6", "T1\nM6"},
                                                          {"G43 H1 Z20. M8", "G43 H1 Z20. M8\nM8"},
                                                          {"G43 H1 Z20. M8", "M8\nG43 H1 Z20."}}) {
        const regression::Comparison same = compare_texts(part, replaced(part, what, with), setup);
        INFO(with << ": " << same.verdict);
        CHECK(same.equal);
    }
}

TEST_CASE("the retract before an indexing counts where both sides use the same functions",
          "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string a =
        "O1\nG90 G21 G94 G54\nT1 M6\nS500 M3\nG43.4 H1\nG0 X0. Y0. Z150.\n"
        "G1 Z140. F200.\nX20.\nG0 Z200.\nG49\nG0 B20. C45.\nG43.4 H1\nG0 X10. Y0. "
        "Z150.\nG1 Z140.\nX30.\nG0 Z200.\nG49\nM30\n";
    const regression::Comparison r =
        compare_texts(a, replaced(a, "X20.\nG0 Z200.\n", "X20.\n"), setup);
    INFO(r.verdict);
    CHECK_FALSE(r.equal);
}

TEST_CASE("a lost decimal point is no equal program while parameter 3401 is not known",
          "[compare]") {
    setup::Setup setup = mill();
    setup.stores.parameters.entry.erase(3401);
    const std::string b = replaced(part, "X-30.", "X-30");
    const regression::Comparison r = compare_texts(part, b, setup);
    INFO(r.verdict);
    CHECK_FALSE(r.equal);
    CHECK(r.differences.back().b.line == line_with(part, "X-30."));
    CHECK(std::any_of(r.notes.begin(), r.notes.end(), [](const std::string& note) {
        return note.find("without a decimal point") != std::string::npos;
    }));
    setup.stores.parameters.entry[3401].value = 1;
    CHECK(compare_texts(part, b, setup).equal);
}

TEST_CASE("programs that stop for want of arguments are compared by words, and with --call",
          "[compare]") {
    const setup::Setup setup = mill();
    const std::string a =
        "O9814\n(bore)\nIF[#7EQ#0]GOTO90\nG91 G1 X[#7/2.] F#9\nX-#7\nG90\nGOTO99\nN90 "
        "#3000=91(DIAMETER "
        "MISSING)\nN99 M99\n";
    const std::string b = replaced(a, "X-#7", "X[-#7+0.2]");
    const regression::Comparison r = compare_texts(a, b, setup);
    INFO(r.verdict);
    CHECK_FALSE(r.equal);
    CHECK(r.by == regression::Layer::words);
    CHECK(r.status == regression::CompareStatus::differs);
    CHECK(r.differences.front().a.block == "X-#7");
    CHECK(r.alarm_a == r.alarm_b);
    CHECK_FALSE(r.alarm_a.empty());
    CHECK(compare_texts(a, replaced(a, "(bore)", "(a bore)"), setup).equal);
    regression::CompareOptions called;
    called.call = "G65 P9814 D25.4 F100.";
    const regression::Comparison by_call = compare_texts(a, b, setup, called);
    INFO(by_call.verdict);
    CHECK_FALSE(by_call.equal);
    CHECK(by_call.by == regression::Layer::path);
    CHECK(by_call.position_mm == Approx(0.2));
    CHECK(compare_texts(a, replaced(a, "X-#7", "X[0-#7]"), setup, called).equal);
}

TEST_CASE("rounding of short chords is no other feed, 2 percent more is", "[compare]") {
    const setup::Setup setup = bc_table();
    const auto program = [](int decimals, double feed) {
        std::string text =
            "O1\nG90 G21 G94 G54\nT1 M6\nS500 M3\nG0 B20. C0.\nG43.4 H1\nG0 X30. Y0. "
            "Z150.\nG1 Z140. F200.\n";
        for (int k = 1; k <= 400; ++k) {
            const double angle = 0.05 * k / 30.0;
            text += fmt::format("X{0:.{4}f} Y{1:.{4}f} C{2:.{4}f} F{3}.\n", 30.0 * std::cos(angle),
                                30.0 * std::sin(angle), 0.02 * k, feed, decimals);
        }
        return text + "G0 Z200.\nM30\n";
    };
    const regression::Comparison r = compare_texts(program(3, 1000), program(4, 1000), setup);
    INFO(r.verdict);
    CHECK(r.equal);
    const regression::Comparison faster = compare_texts(program(3, 1000), program(4, 1020), setup);
    INFO(faster.verdict);
    CHECK_FALSE(faster.equal);
    CHECK(faster.differences.front().kind == regression::DifferenceKind::feed);
}

TEST_CASE("a feed along 2.5 um between two others is noise", "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string head = "O1\nG90 G21 G94 G54\nT1 M6\nS500 M3\nG0 X0. Y0. Z150.\n";
    const std::string a = head +
                          "G1 Z140. F200.\nX20. F800.\nG0 Z150.\nX50.\nG1 Z140. F200.\nX60. "
                          "F800.\nG0 Z150.\nM30\n";
    const std::string b = head +
                          "G1 Z140.0025 F200.\nZ140. F300.\nX20. F800.\nG0 Z149.9975\nG1 "
                          "Z150. F5000.\nG0 X50.\nG1 Z140. F200.\nX60. F800.\nG0 Z150.\nM30\n";
    const regression::Comparison r = compare_texts(a, b, setup);
    INFO(r.verdict);
    CHECK(r.equal);
    CHECK_FALSE(
        compare_texts(a, replaced(b, "Z140.0025 F200.\nZ140. F300.", "Z141. F200.\nZ140. F300."),
                      setup)
            .equal);
}

TEST_CASE("a clearance plane is compared where the run starts from Z0", "[compare]") {
    std::vector<std::string> notes;
    const setup::Setup setup =
        setup::parse_setup("[machine]\nchain = \"w b X Y Z t\"\n", "mill.toml", notes);
    const std::string a =
        "O1\nG90 G21 G94 G54\nT1 M6\nS500 M3\nG0 X0. Y0.\nG43 H1 Z50.\nZ2.\nG1 Z-1. "
        "F200.\nX20.\nG0 Z50.\nM30\n";
    const regression::Comparison r = compare_texts(a, replaced(a, "H1 Z50.", "H1 Z5."), setup);
    INFO(r.verdict);
    CHECK_FALSE(r.equal);
    CHECK(r.differences.front().a.line == 6);
}

TEST_CASE("no number of a report is NaN where an arc is programmed in another plane", "[compare]") {
    const setup::Setup setup = mill();
    for (const char* arc :
         {"G18 G2 X20. Y20. I10. J0.", "G2 X20. Z5. I10. J0.", "G2 X20. I5. J5."}) {
        const std::string a = fmt::format(
            "O1\nG90 G21 G94 G54 G18\nS500 M3\nG41 D1 G1 X10. Z10. F100.\n{}\nG40 X40.\nM30\n",
            arc);
        const regression::Comparison r = compare_texts(a, replaced(a, "X40.", "X41."), setup);
        INFO(arc << ": " << r.verdict);
        CHECK(std::isfinite(r.time_a_s));
        CHECK(std::isfinite(r.position_mm));
        CHECK(r.verdict.find("nan") == std::string::npos);
    }
}

TEST_CASE("the path goes on with the length before G49: nothing jumps, what moves is seen",
          "[compare]") {
    const setup::Setup setup = bc_table();
    const std::string a =
        "O1\nG90 G21 G94 G54 G40 G49\nT1 M6\nS5000 M3\nG0 X0. Y0. Z300.\nG43 H1 Z160.\nG1 Z140. "
        "F300.\nX30. F800.\nG0 Z300.\nG91 G28 Z0.\nG90 G49\nT2 M6\nS5000 M3\nG0 X0. Y10.\nG43 "
        "H2 Z160.\nG1 Z140. F300.\nX30. F800.\nG0 Z300.\nM30\n";
    // Behind G28 G49 moves no axis: with it or without is the same path.
    const regression::Comparison kept =
        compare_texts(a, replaced(a, "G90 G49\nT2", "G90\nT2"), setup);
    INFO(kept.verdict);
    CHECK(kept.equal);
    const regression::Comparison missing =
        compare_texts(a, replaced(a, "G43 H2 Z160.", "Z160."), setup);
    INFO(missing.verdict);
    CHECK_FALSE(missing.equal);
    CHECK(missing.differences.front().what.find("H2") != std::string::npos);
    CHECK(missing.position_mm > 100.0);
    // Elsewhere it moves Z by the length (5006#6 = 0), and that is a difference of the rapids.
    const std::string b = replaced(a, "G91 G28 Z0.\nG90 G49\n", "");
    const regression::Comparison moves =
        compare_texts(b, replaced(b, "T2 M6", "G49\nT2 M6"), setup);
    INFO(moves.verdict);
    CHECK_FALSE(moves.equal);
    CHECK(moves.position_mm == Approx(150.0));
}
