#include "check/check.h"

#include <catch2/catch.hpp>
#include <memory>

#include "report/findings_report.h"

using namespace trunnion;

namespace {

std::vector<Finding> check_text(const std::string& text) {
    const auto owner = std::make_shared<const std::string>(text);
    CheckOptions options;
    options.dialect = fanuc_dialect();
    options.knows_g = [](int code10) { return code10 != 7770; };
    options.finds_program = [](int number) { return number == 5; };
    return check_program({"p.nc", *owner, owner}, options);
}

}  // namespace

TEST_CASE("each rule finds its fault at its line, once, and not in the mended program", "[check]") {
    struct Row {
        const char *rule, *bad, *good;
        int line;
    };
    const Row row = GENERATE(values<Row>({
        {"jump-target", "O1\nIF[#1EQ1]GOTO 50\nN60 M30\n", "O1\nGOTO 60\nN60 M30\n", 2},
        {"syntax", "O1\nIF[#1EQ2]\nM30\n", "O1\nIF[#1EQ2]GOTO9\nN9M30\n", 2},
        {"duplicate-target", "O1\nIF[#1EQ1]GOTO7\nN7X1.\nN7X2.\nM30\n",
         "O1\nIF[#1EQ1]GOTO8\nN7X1.\nN7X2.\nN8M30\n", 2},
        {"loop", "O1\nEND1\nM30\n", "O1\nWHILE[#1LT3]DO1\nEND1\nM30\n", 2},
        {"loop", "O1\nWHILE[#1LT3]DO2\nM30\n", "O1\nWH[#1LT3]DO2\nEND2\nM30\n", 2},
        {"arc-radius", "O1\nG17G90G0X0.Y0.\nG2X20.Y5.I5.J0.F9.\nM30\n",
         "O1\nG17G90G0X0.Y0.\nG2X5.Y5.I5.J0.F9.\nM30\n", 3},
        {"arc-radius", "O1\nG17G90G0X0.Y0.\nG2X20.Y0.R9.F9.\nM30\n",
         "O1\nG17G90G0X0.Y0.\nG2X20.Y0.R10.F9.\nM30\n", 3},
        {"arc-radius", "O1\nG18G91G2X10.Z0.I4.K0.F9.\nM30\n", "O1\nG18G91G2X10.Z0.I5.K0.F9.\nM30\n",
         2},
        {"arc-plane", "O1\nG90G2X5.Y5.I5.J0.F9.\nM30\n", "O1\nG17G90G2X5.Y5.I5.J0.F9.\nM30\n", 2},
        {"unknown-code", "O1\nG777\nM30\n", "O1\nG77\nM30\n", 2},
        {"subprogram-missing", "O1\nM98P77\nM30\n", "O1\nM98P5\nM98P2\nM30\nO2\nM99\n", 2},
        {"skip-compensation", "O1\nG41D1\nG31X5.F9.\nG40\nM30\n",
         "O1\nG41D1\nG40\nG31X5.F9.\nM30\n", 3},
        {"unreachable", "O1\nGOTO7\nX1.\nN7M30\n", "O1\nIF[#1EQ1]GOTO7\nX1.\nN7M30\n", 3},
        {"left-on", "O1\nG43.4H1\nM30\n", "O1\nG43.4H1\nG49\nM30\n", 3},
        {"left-on", "O1\nG68.2X0Y0Z0I0J0K0\nM30\n", "O1\nG68.2X0Y0Z0I0J0K0\nG69\nM30\n", 3},
        {"merge-marker", "O1\n<<<<<<< HEAD\nM30\n", "O1\n(<<<<<<< HEAD)\nM30\n", 2},
    }));
    INFO(row.rule << "\n" << row.bad);
    const auto bad = check_text(row.bad);
    REQUIRE(bad.size() == 1);
    CHECK(bad[0].rule == row.rule);
    CHECK(bad[0].line == row.line);
    CHECK_FALSE(bad[0].remedy.empty());
    const auto good = check_text(row.good);
    INFO(row.good << (good.empty() ? "" : good[0].text));
    CHECK(good.empty());
}

TEST_CASE("findings in every format carry the place", "[check]") {
    const auto findings = check_text("O1\nGOTO 50\nM30\n");
    for (const char* format : {"text", "json", "junit", "sarif", "github"})
        CHECK(format_findings(findings, {"p.nc"}, format).find("GOTO 50") != std::string::npos);
    CHECK(format_findings({}, {"p.nc"}, "text") == "0 findings in 1 file\n");
    CHECK(format_findings({}, {"p.nc"}, "github").empty());
}
