// Programs that call others: they are compared together with what they call.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "interpreter/program_folders.h"
#include "regression/opened_programs.h"
#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

namespace fs = std::filesystem;

/// A folder for each side with the programs that it finds.
class TwoSides {
  public:
    TwoSides() {
        for (const char* side : {"a", "b"}) fs::create_directories(path / side);
    }
    ~TwoSides() { fs::remove_all(path); }
    void write(const char* name, const std::string& text) const {
        std::ofstream(path / name) << text;
    }
    regression::Comparison compare(std::optional<regression::Layer> by) const {
        regression::CompareOptions options;
        options.by = by;
        const setup::Setup setup = bc_table();
        return regression::compare_programs(
            interpreter::read_program((path / "a/main.nc").string()), setup,
            interpreter::read_program((path / "b/main.nc").string()), setup, options);
    }
    fs::path path = fs::temp_directory_path() / ("trunnion_calls_" + std::to_string(::getpid()));
};

const std::string main_program = "%\nO1\nG90 G21 G54\nT1 M6\nS500 M3\nM98 P2\nM98 P2\nM30\n%\n";
const std::string called = "%\nO2\nG0 X10.\nG1 X20. F300.\nM99\n%\n";

}  // namespace

TEST_CASE("a text may call where a code calls, is computed or is too long to be known", "[calls]") {
    setup::Setup setup = bc_table();
    for (const char* text : {"M98 P2", "m 9 8 P2", "M198 P1", "G65 P1", "G66 P1", "G#100", "M[#1]",
                             "M+98", "X1. G6 5 P1", "G123456", "G1\nM3\nM98P1"}) {
        INFO(text);
        CHECK(regression::may_call(text, setup));
    }
    for (const char* text :
         {"", "G1 X10. M3", "G", "M", "M99", "G650", "G6 X5.", "M9 (98)", "GX", "G12345 M8"}) {
        INFO(text);
        CHECK_FALSE(regression::may_call(text, setup));
    }
    CHECK_FALSE(regression::codes_call(setup));
}

TEST_CASE("a text may call by any code that a parameter names", "[calls]") {
    for (const int number : {6050, 6071, 6080, 6001}) {
        setup::Setup setup = bc_table();
        setup.stores.parameters.entry[number].value = number == 6001 ? 32.0 : 77.0;
        INFO(number);
        CHECK(regression::codes_call(setup));
        CHECK(regression::may_call("X1.", setup));
    }
}

TEST_CASE("a change of a called program is a difference, named once", "[calls]") {
    const TwoSides sides;
    sides.write("a/main.nc", main_program);
    sides.write("b/main.nc", main_program);
    sides.write("a/O2.nc", called);
    sides.write("b/O2.nc", called);
    CHECK(sides.compare({}).equal);
    CHECK(sides.compare({}).layers.size() == 1);  // the text
    sides.write("b/O2.nc", replaced(called, "X20.", "X20.0"));
    CHECK(sides.compare({}).equal);
    CHECK_FALSE(sides.compare(regression::Layer::text).equal);
    CHECK(sides.compare(regression::Layer::words).equal);
    sides.write("b/O2.nc", replaced(called, "X20.", "X21."));
    CHECK_FALSE(sides.compare({}).equal);
    const regression::Comparison words = sides.compare(regression::Layer::words);
    REQUIRE(words.differences.size() == 1);
    CHECK(words.differences[0].what == "1 block changed: X21. instead of X20.");
    CHECK(words.differences[0].b.program == (sides.path / "b/O2.nc").string());
    CHECK(words.differences[0].b.line == line_with(called, "X20."));
}

TEST_CASE("a program that one side alone calls, or finds, is a difference", "[calls]") {
    const TwoSides sides;
    sides.write("a/main.nc", main_program);
    sides.write("a/O2.nc", called);
    const auto said = [&](const std::string& main_b, bool same_machining) {
        sides.write("b/main.nc", main_b);
        CHECK(sides.compare({}).equal == same_machining);
        const regression::Comparison r = sides.compare(regression::Layer::words);
        CHECK_FALSE(r.equal);
        std::string all;
        for (const regression::Difference& d : r.differences) all += d.what + "\n";
        return all;
    };
    // B's folder has none.
    CHECK_THAT(said(main_program, false), Catch::Contains("O2 is called, and found, only in A"));
    sides.write("b/O3.nc", replaced(called, "O2", "O3"));
    const std::string other = said(replaced(replaced(main_program, "P2", "P3"), "P2", "P3"), true);
    CHECK_THAT(other, Catch::Contains("O2 is called, and found, only in A"));
    CHECK_THAT(other, Catch::Contains("O3 is called, and found, only in B"));
    // One call less is a difference of the main program alone.
    sides.write("b/O2.nc", called);
    const std::string less = said(replaced(main_program, "M98 P2\n", ""), false);
    CHECK_THAT(less, !Catch::Contains("found"));
    CHECK_THAT(less, Catch::Contains("only in A"));
}

TEST_CASE("a program called by name in brackets is found and compared", "[calls]") {
    const TwoSides sides;
    const std::string by_name = replaced(main_program, "M98 P2\nM98 P2", "M98 <POCKET>");
    sides.write("a/main.nc", by_name);
    sides.write("b/main.nc", by_name);
    sides.write("a/POCKET.nc", replaced(called, "O2", "<POCKET>"));
    sides.write("b/POCKET.nc", replaced(called, "O2", "<POCKET>"));
    CHECK(sides.compare({}).equal);
    sides.write("b/POCKET.nc", replaced(replaced(called, "O2", "<POCKET>"), "X20.", "X21."));
    const regression::Comparison r = sides.compare(regression::Layer::words);
    REQUIRE(r.differences.size() == 1);
    CHECK(r.differences[0].what == "1 block changed: X21. instead of X20.");
}

TEST_CASE("a difference that begins in a called program and ends in the caller", "[calls]") {
    const TwoSides sides;
    const std::string caller = replaced(main_program, "M98 P2\nM98 P2\n", "M98 P2\nX30.\nX40.\n");
    for (const char* side : {"a", "b"})
        sides.write((side + std::string("/main.nc")).c_str(), caller);
    sides.write("a/O2.nc", called);
    sides.write("b/O2.nc", replaced(called, "X20.", "X20. Y7."));
    const regression::Comparison r = sides.compare(regression::Layer::path);
    REQUIRE_FALSE(r.equal);
    const regression::ComparePlace& place = r.differences.front().b;
    CHECK(place.program == (sides.path / "b/O2.nc").string());
    CHECK(place.line == line_with(called, "X20."));
    CHECK(place.last_line == place.line);  // the end lies in another program
}

TEST_CASE("a program that calls itself, and one that nobody finds", "[calls]") {
    const TwoSides sides;
    const std::string itself =
        "%\nO1\nG90 G21 G54\n#100=#100+1\nG1 X[#100] F300.\nIF[#100GT3]GOTO9\nM98 P1\nN9 M99\n%\n";
    sides.write("a/main.nc", itself);
    sides.write("b/main.nc", replaced(itself, "GT3", "GT4"));
    const regression::Comparison r = sides.compare(regression::Layer::words);
    REQUIRE(r.differences.size() == 1);  // once, not for the call again
    sides.write("b/main.nc", replaced(itself, "GT3", "GE4"));
    CHECK_FALSE(sides.compare(regression::Layer::words).equal);
    // Neither side has O7: both stop there.
    const std::string missing =
        replaced(main_program, "M98 P2\nM98 P2\n", "G1 X5. F300.\nM98 P7\n");
    sides.write("a/main.nc", missing);
    sides.write("b/main.nc", replaced(missing, "X5.", "X6."));
    const regression::Comparison stopped = sides.compare({});
    CHECK_FALSE(stopped.equal);
    CHECK(stopped.alarm_a == stopped.alarm_b);
    REQUIRE(stopped.differences.size() == 1);
    CHECK(stopped.differences[0].what == "1 block changed: X6. instead of X5.");
}

TEST_CASE("a function of a called program has its place there", "[calls]") {
    const TwoSides sides;
    sides.write("a/main.nc", main_program);
    sides.write("b/main.nc", main_program);
    const std::string with = replaced(called, "G0 X10.\n", "M8\nG10 L2 P3 X1.\nG0 X10.\n");
    for (const char* function : {"M8", "G10 L2 P3 X1."}) {
        sides.write("a/O2.nc", with);
        sides.write("b/O2.nc", replaced(with, function, "M20"));
        const regression::Comparison r = sides.compare(regression::Layer::functions);
        INFO(function);
        REQUIRE_FALSE(r.differences.empty());
        CHECK(r.differences[0].a.program == (sides.path / "a/O2.nc").string());
    }
}
