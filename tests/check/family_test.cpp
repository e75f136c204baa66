// Programs of lathes and of a Haas are named in one line each; a mill's program never is.
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "base/read_file.h"
#include "check/check.h"
#include "controller/g_codes.h"
#include "controller/hurco_codes.h"

using namespace trunnion;
namespace fs = std::filesystem;

namespace {

check::CheckOptions mill_options() {
    check::CheckOptions options;
    options.dialect = interpreter::fanuc_dialect();
    options.knows_g = [](int code10) {
        return controller::find_g_code(code10 / 10.0) || (code10 >= 650 && code10 <= 670);
    };
    options.finds_program = [](int) { return false; };
    options.has_u_axis = false;
    return options;
}

std::vector<check::Finding> check_text(const std::string& text,
                                       const check::CheckOptions& options = mill_options()) {
    const auto owner = std::make_shared<const std::string>(text);
    return check::check_program({"p.nc", *owner, owner}, options);
}

/// "lathe", "Haas" or "" for the first program of a text.
std::string family_of(const std::string& text,
                      const check::CheckOptions& options = mill_options()) {
    for (const check::Finding& f : check_text(text, options))
        if (f.rule == "family") return f.text.find("lathe") != f.text.npos ? "lathe" : "Haas";
    return "";
}

}  // namespace

TEST_CASE("a lathe's program is one finding that names the words", "[check]") {
    const std::string body = GENERATE(
        "G50S2500\nG96S200M3\nG0X52.Z2.\n", "T0101\nG54\nG50S2000\n",
        "G71U2.R.5\nG71P10Q20U.5W.1F.25\nN10G0X20.\nN20X52.\nG70P10Q20\n",
        "G72W2.R.5\nG72P10Q20U.5W.1F.25\nN10G0X20.\nN20X52.\n",
        "G73U5.W2.R3\nG73P10Q20U.5W.1F.25\nN10G0X20.\nN20X52.\n", "G70P10Q20\nN10X1.\nN20X2.\n",
        "G28U0.\nG28W0.\nT0101\nG97S1000M3\nG0X50.Z1.\nU2.\n",
        "G99G97S1000M3T0202\nG0X30.Z5.\nG92X29.Z-20.F1.5\nX28.5\nG28U0W0\n",
        "G18G40G80G99\nT0303(DRILL)\nG97S800M3\nG0X0Z5.\nG74R1.\nG74Z-40.Q5000F.1\n",
        "G18G99G97S1000M3\nG0X50.Z1.\nG76P010060Q100R50\nG76X28.Z-20.P1000Q300F1.5\n",
        "G99G97S1000M3\nG0X50.Z1.\nG76P021060\nG76U-2.W-20.P1000Q300F1.5\n",
        "G75R1.\nG75X20.P2000F.1\n", "G99G96S150M3T0303\nG0X50.Z1.M8\nG1X20.F.1\n",
        "T0700\nG96S100M3\nX5.Z1.\nT0707\n", "G76X28.Z-20.K.9D.3F1.5\nG96S100\n",
        "G50X200.Z150.S1500\nT0500\n", "G50S2500T0101M42\nX1.\n", "G32Z-20.F1.5\nG4U1.\n",
        "G28U0.W0.\nT0101M06\nG96S400M3\nG0X2.Z.1\n", "G21G96G50S2000\nT0101\nX5.Z1.\n",
        "T909\nG50S2000\nT707\nG96S120M3\nX15.Z.1\n",
        "T0101M6\nG96S180M3\nG71P10Q20U.02W.005F.02\nN10X20.\nN20Z-25.\n");
    INFO(body);
    const auto found = check_text("%\nO100(TURN)\n" + body + "GOTO99\nG777\nQQ\nM98P77\nM30\n%\n");
    REQUIRE(found.size() == 1);
    CHECK(found[0].rule == "family");
    CHECK_THAT(found[0].text, Catch::StartsWith("O0100 is a program for a lathe (") &&
                                  Catch::Contains(" in line "));
    CHECK(found[0].line >= 3);
}

TEST_CASE("a mill's program is never a lathe's", "[check]") {
    const std::string body = GENERATE(
        "T0101M6\nG96S200M3\nG0X10.Z10.\nG99G81X1.Z-3.R1.F100\nG80\n",  // T with four digits, G96
        "G17\nT0303\nG96S100M3\nG0X1.Y1.\n", "G76X1.Y1.Z-5.R1.Q.1P100F100\nG80\n",
        "G76P010060Q.1R1.\nG76X1.Y1.Z-5.R1.Q.1P1000F100\nG80\n", "G92X0Z0\nX1.Z1.\n",
        "G92X10.Z10.F100\nG1X1.Z1.\n", "G50\nS1000M3\nX1.\n", "G50S2000\nX1.\nZ1.\n",
        "T0101\nG50S2000M3\nX1.\n", "T0101M6\nG96S150M3\nG0X1.Z1.\nG92X0Z0\n",
        "T0101M6\nG50S2000\nG0X1.Z1.\n", "T101M6\nT202\nS100M3\nG0X1.Z1.\n",
        "T0101\nG50S100\nG96S100\nG28U0\nY1.\n", "G99G96S100M3\nG0X1.Z1.\n", "T0303\nG0X1.Z1.\n",
        "T1234\nG96S100M3\nG0X1.Z1.\n", "G73X1.Z-5.R1.Q1.F100\nG80\n",
        "G73X1.Z-5.R1.Q1P500F100U1.W1.\nG80\n", "G28U0W0\nG0X1.\n", "G74X1.Z-5.R1.F100\nG80\n",
        "M29S100\nG74R1.\nG74Z-5.Q500F100\nG80\n", "G74R1.\nG74Z-40.Q5.F1.\nG80\n",
        "G65P9001U1.W1.S5T0303\nG96S100\nX1.\n", "G4P100\nG4X1.\n",
        "G43H1Z5.\nT0101\nG50S100\nG96S100\n");
    INFO(body);
    CHECK(family_of("O1\n" + body + "M30\n").empty());
}

TEST_CASE("a machine with a U axis, and codes that call a program, are no sign of a lathe",
          "[check]") {
    check::CheckOptions options = mill_options();
    const std::string boring = "O1\nT0101\nG28U0\nG0X1.Z1.\nM30\n";
    CHECK(family_of(boring, options) == "lathe");
    options.has_u_axis = true;
    CHECK(family_of(boring, options).empty());
    const std::string own = "O1\nG71P10Q20U1.\nN10X1.\nN20X2.\nM30\n";
    CHECK(family_of(own, options) == "lathe");
    options.calls_program = [](char letter, int code10) { return letter == 'G' && code10 == 710; };
    CHECK(family_of(own, options).empty());
    options.calls_program = nullptr;
    options.builders_code = [](char letter, int code10) { return letter == 'G' && code10 == 710; };
    CHECK(family_of(own, options).empty());
}

TEST_CASE("a Haas program is named, one that has one of its codes is not", "[check]") {
    for (const std::string body :
         {"M97P100\nM30\nN100M99\n", "M130\nM97P10\n", "G187P3\n", "G187\n", "G154P5\n", "G103P1\n",
          "G150P1001X2.Y2.Z-.1I.3K.01Q.25R.1G41D1F10.\n", "G110\nG143H1Z1.\n",
          "G12I1.D1F10.\nG129\nX1.\n", "G70I5.J15.L12\nG234H1\n",
          "G47P1X1.Y1.(TEXT)\nG13I1.D1F10.\n", "G254\nG110\n"}) {
        INFO(body);
        CHECK(family_of("O1\nG0X1.\n" + body + "M30\n") == "Haas");
    }
    for (const std::string body :
         {"M97P5\n", "M130\n", "G187P5\n", "G110\n", "G110\nG111\nG129\n", "G110P5Q3\nG143H1\n",
          "G13I1.D1F10.\n", "G47X1.D1\nG13I1.\n", "G150\n", "G101X5.\nG102X5.\n",
          "G65P9001M97.A1.\n", "G70\nG71\nG72\n"}) {
        INFO(body);
        CHECK(family_of("O1\nG0X1.\n" + body + "M30\n").empty());
    }
}

TEST_CASE("the finding says which words show the family, and where", "[check]") {
    const auto found = check_text("O7\nT0303\nG96S100\nX1.Z1.\nM30\n");
    REQUIRE(found.size() == 1);
    CHECK(found[0].text ==
          "O0007 is a program for a lathe (T0303 in line 2; G96 S in line 3): it is not checked "
          "further");
    CHECK(found[0].line == 2);
    CHECK(check_text("G71P1Q2U1.\nM30\n")[0].text ==
          "this is a program for a lathe (G71 P Q in line 1): it is not checked further");
    CHECK(check_text("O1\nG110\nM30\n")[0].text ==
          "this control has no G110 (on a Haas: work offset)");
}

TEST_CASE("a lathe's program beside a mill's hides nothing of the mill's", "[check]") {
    const std::string mill = "O1(MILL)\nG21G90G54G17\nM98P4444\nGOTO77\nM30\n",
                      lathe = "O2(LATHE)\nG50S2000\nG96S100M3\nQQ\nGOTO78\nM98P5555\nM30\n",
                      haas = "O3(HAAS)\nG187P1\nGOTO79\nM30\n";
    const auto alone = check_text(mill);
    REQUIRE(alone.size() == 3);
    for (const std::string& text :
         {mill + lathe + haas, lathe + mill + haas, haas + lathe + mill}) {
        INFO(text);
        const auto found = check_text("%\n" + text + "%\n");
        REQUIRE(found.size() == 5);
        std::set<std::string> texts;
        for (const auto& f : found) texts.insert(f.text);
        for (const auto& f : alone) CHECK(texts.contains(f.text));
        CHECK(std::count_if(found.begin(), found.end(),
                            [](const auto& f) { return f.rule == "family"; }) == 2);
        CHECK(check::begins_foreign(text, found) == !text.starts_with("O1"));
    }
    // A lathe's program is still a program that can be called.
    CHECK(check_text("O1\nM98P2\nM30\n" + lathe).size() == 1);
}

TEST_CASE("no program that ships and none of the language tests is another family's", "[check]") {
    std::size_t programs = 0;
    for (const char* folder : {"/programs", "/tests/nc"})
        for (const auto& entry :
             fs::recursive_directory_iterator(TRUNNION_SOURCE_DIR + std::string(folder))) {
            if (entry.path().extension() != ".nc") continue;
            ++programs;
            const std::string text = read_file(entry.path().string());
            check::CheckOptions options = mill_options();
            if (entry.path().parent_path().filename() == "hurco")
                options.knows_g = [](int code10) {
                    return controller::find_hurco_g_code(code10 / 10.0, false) != nullptr;
                };
            for (const check::Finding& f : check_text(text, options))
                if (f.rule == "family") {
                    INFO(entry.path() << " " << f.text);
                    CHECK(false);
                }
        }
    CHECK(programs > 300);
}
