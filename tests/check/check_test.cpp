#include "check/check.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "report/findings_report.h"

using namespace trunnion;

namespace {

std::vector<check::Finding> check_text(const std::string& text) {
    const auto owner = std::make_shared<const std::string>(text);
    check::CheckOptions options;
    options.dialect = interpreter::fanuc_dialect();
    options.knows_g = [](int code10) { return code10 != 7770; };
    options.finds_program = [](int number) { return number == 5; };
    options.arc_fit = [](double start_mm, double end_mm) {
        return std::abs(start_mm - end_mm) > 0.02 ? check::ArcFit::refused : check::ArcFit::good;
    };
    options.chord_exceeds = [](double chord_mm, double radius_mm) {
        return 0.5 * chord_mm - std::abs(radius_mm) > 0.02;
    };
    options.finds_named = [](const std::string& name) { return name == "BORE"; };
    return check::check_program({"p.nc", *owner, owner}, options);
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
        {"branch", "O1\nENDIF\nM30\n", "O1\nIF[#1EQ1]THEN\nELSE\nENDIF\nM30\n", 2},
        {"branch", "O1\nIF[#1EQ1]THEN\nM30\n", "O1\nIF[#1EQ1]THEN #1=2\nM30\n", 2},
        {"branch", "O1\nELSE\nM30\n", "O1\nIF[#1EQ1]THEN\nM30\nENDIF\nM30\n", 2},
        {"loop", "O1\nEND1\nM30\n", "O1\nWHILE[#1LT3]DO1\nEND1\nM30\n", 2},
        {"loop", "O1\nWHILE[#1LT3]DO2\nM30\n", "O1\nWH[#1LT3]DO2\nEND2\nM30\n", 2},
        {"loop", "O1\nIF[#1EQ1]GOTO5\nWHILE[#1LT3]DO1\nN5#1=#1+1\nEND1\nM30\n",
         "O1\nIF[#1EQ1]GOTO5\nN5WHILE[#1LT3]DO1\n#1=#1+1\nEND1\nM30\n", 2},
        {"loop",
         "O1\nWHILE[#1LT3]DO1\nIF[#1EQ1]GOTO5\nEND1\nDO1\nN5#1=#1+1\nIF[#1GT9]GOTO6\n"
         "END1\nN6M30\n",
         "O1\nWHILE[#1LT3]DO1\nIF[#1EQ1]GOTO5\nDO2\n#1=#1+1\nIF[#1GT9]GOTO6\nEND2\n"
         "N5#1=#1+1\nEND1\nN6M30\n",
         3},
        {"subprogram-missing", "O1\nM98<DRILL>\nM30\n",
         "O1\nM98<BORE>\nG65<TAP>A1.\nM30\n<TAP>\nM99\n", 2},
        {"subprogram-missing", "O1\nM198P7\nM30\nO7\nM99\n", "O1\nM198P5\nM30\n", 2},
        {"word", "O1\nG65P5A1.P2\nM30\n", "O1\nG65P5A1.\nM30\n", 2},
        {"word", "O1\nG66P5G4X1.\nM30\n", "O1\nG66P5L2X1.\nG67\nM30\n", 2},
        {"word", "O1\nG65H01P#101Q#102\nM30\n", "O1\nG65P#1H2\nM30\n", 2},
        {"word", "O1\nG65H80P5\nM30\n", "O1\nG65H8.P5\nM30\n", 2},
        {"skip-compensation", "O1\nG42D1\nG31X5.F9.\nG40\nM30\n",
         "O1\nG42D1\nX1.\nG40\nG31X5.F9.\nM30\n", 3},
        {"arc-radius", "O1\nG19G91G3Y10.Z0.J4.K0.F9.\nM30\n", "O1\nG19G91G3Y10.Z0.J5.K0.F9.\nM30\n",
         2},
        {"left-on", "O1\nG43.5H1\nM2\n", "O1\nG43.5H1\nG49\nM2\n", 3},
        {"unreachable", "O9001\nM99\nX1.\n", "O9001\nM99\nN5X1.\n", 3},
        {"syntax", "O1\nIF[#1EQ2]X1.\nM30\n", "O1\nIF[#1EQ2]THEN#1=3\nM30\n", 2},
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
        {"unreachable", "O1\nM30\nX1.\n", "O1\nG65P5M30\nX1.\nM30\n", 3},
        {"word", "O1\nM29.7\nM30\n", "O1\nM29\nM30\n", 2},
        {"word", "O1\nM98P2.5\nM30\n", "O1\nM98P5\nM30\n", 2},
        {"modal-group", "O1\nG#4012\nM30\n", "O1\nG#4014\nM30\n", 2},
        {"dwell-point", "O1\nG4P10.\nM30\n", "O1\nG4P10\nG4X1.5\nG4P#1\nG4P[10.]\nM30\n", 2},
        {"variable", "O1\n#99=1\nM30\n", "O1\n#100=1\nM30\n", 2},
        {"family", "O1\nG71P10Q20U.4W.1F.2\nG777\nM30\n", "O1\nG73Z-1.\nM30\n", 2},
        {"family", "O1\nM97P100\nM30\nN100M99\n", "O1\nM98P5\nM30\n", 2},
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
        CHECK(report::format_findings(findings, {"p.nc"}, format).find("GOTO 50") !=
              std::string::npos);
    CHECK_THROWS(report::format_findings(findings, {"p.nc"}, "xml"));
    CHECK(report::format_findings({}, {"p.nc"}, "text") == "0 findings in 1 file\n");
    CHECK(report::format_findings({}, {"p.nc"}, "github").empty());
}

TEST_CASE("a code of this control, or of its builder, is no sign of a Haas", "[check]") {
    const std::string text = "O1\nG103P1\nM30\n";
    CHECK(check_text(text).empty());  // this control has every code but G777
    const auto owner = std::make_shared<const std::string>(text);
    check::CheckOptions options;
    options.knows_g = [](int code10) { return code10 != 1030; };
    const auto findings = check::check_program({"p.nc", *owner, owner}, options);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].rule == "family");
    const auto lamp = std::make_shared<const std::string>("O1\nM130\nM97P10\nM30\n");
    CHECK(check::check_program({"p.nc", *lamp, lamp}, options).size() == 1);
    options.builders_code = [](char letter, int code10) {
        return letter == 'M' && (code10 == 1300 || code10 == 970);
    };
    CHECK(check::check_program({"p.nc", *lamp, lamp}, options).empty());
}

TEST_CASE("a code of an option that is not emulated is named", "[check]") {
    check::CheckOptions options;
    options.knows_g = [](int code10) { return code10 != 62 && code10 != 7770; };
    options.missing_option = [](int code10) { return code10 == 62 ? "NURBS interpolation" : ""; };
    const auto owner = std::make_shared<const std::string>("O1\nG6.2\nG777\nM30\n");
    const auto findings = check::check_program({"p.nc", *owner, owner}, options);
    REQUIRE(findings.size() == 2);
    CHECK(findings[0].text == "G6.2 (NURBS interpolation) is an option that is not emulated");
    CHECK(findings[1].text == "this control has no G777");
}

TEST_CASE("text has a line for each finding, with place and rule, and the remedy below",
          "[check]") {
    const auto findings = check_text("O1\nGOTO 50\nG777\nM30\n");
    const std::string text = report::format_findings(findings, {"p.nc"}, "text");
    CHECK(std::count(text.begin(), text.end(), '\n') == 7);  // three of two lines, and the sum
    CHECK(text.starts_with(
        "p.nc:2:1: error: GOTO 50 but the program has no N50 [jump-target]\n    "));
    CHECK(text.find("p.nc:3:1: error: this control has no G777 [unknown-code]\n    Use") !=
          std::string::npos);
    CHECK(text.ends_with("3 findings in 1 file\n"));
}

TEST_CASE("SARIF is what 2.1.0 asks for", "[check]") {
    using Json = nlohmann::json;
    const auto findings = check_text("O1\nG777\nG777\nG2X1.I1.\nM30\n");
    REQUIRE(findings.size() == 3);
    const Json log = Json::parse(report::format_findings(findings, {"my part.nc"}, "sarif"));
    CHECK(log["version"] == "2.1.0");
    CHECK(log["$schema"].get<std::string>().find("sarif-2.1.0") != std::string::npos);
    REQUIRE(log["runs"].size() == 1);
    const Json& run = log["runs"][0];
    const Json& driver = run["tool"]["driver"];
    CHECK(driver["name"] == "trunnion");
    CHECK(driver["rules"].size() == check::check_rules().size());
    std::set<std::string> ids, fingerprints;
    for (const Json& rule : driver["rules"]) {
        CHECK(ids.insert(rule["id"].get<std::string>()).second);
        CHECK_FALSE(rule["shortDescription"]["text"].get<std::string>().empty());
    }
    REQUIRE(run["results"].size() == 3);
    for (const Json& result : run["results"]) {
        const std::string id = result["ruleId"];
        CHECK(ids.contains(id));
        CHECK(driver["rules"][result["ruleIndex"].get<std::size_t>()]["id"] == id);
        CHECK((result["level"] == "error" || result["level"] == "warning"));
        CHECK(result["message"]["text"].is_string());
        const Json& place = result["locations"].at(0)["physicalLocation"];
        CHECK(place["artifactLocation"]["uri"] == "p.nc");
        CHECK(place["region"]["startLine"].get<int>() >= 1);
        CHECK(place["region"]["startColumn"].get<int>() >= 1);
        for (const auto& [name, value] : result["partialFingerprints"].items())
            CHECK(fingerprints.insert(value.get<std::string>()).second);
    }
    CHECK(fingerprints.size() == 3);
    CHECK(run["results"][0]["ruleId"] == "unknown-code");
    CHECK(run["results"][2]["level"] == "warning");
}

TEST_CASE("a SARIF fingerprint stays when lines move", "[check]") {
    using Json = nlohmann::json;
    const auto fingerprint = [](const std::string& text) {
        const Json log = Json::parse(report::format_findings(check_text(text), {"p.nc"}, "sarif"));
        return log["runs"][0]["results"][0]["partialFingerprints"];
    };
    CHECK(fingerprint("O1\nG777\nM30\n") == fingerprint("O1\n(A)\n(B)\nG777\nM30\n"));
    CHECK(fingerprint("O1\nG777\nM30\n") != fingerprint("O1\nGOTO5\nM30\n"));
}

TEST_CASE("JUnit has a case for each file, GitHub a line for each finding", "[check]") {
    const auto findings = check_text("O1\nGOTO 50\nM98<A,B>\nM30\n");
    REQUIRE(findings.size() >= 2);
    const std::string junit = report::format_findings(findings, {"p.nc", "clean.nc"}, "junit");
    CHECK(junit.find("tests=\"2\" failures=\"1\"") != std::string::npos);
    CHECK(junit.find("name=\"clean.nc\"") != std::string::npos);
    const std::string github = report::format_findings(findings, {"p.nc"}, "github");
    CHECK(github.starts_with("::error file=p.nc,line=2,col=1,title=trunnion jump-target::GOTO"));
    CHECK(std::count(github.begin(), github.end(), '\n') ==
          static_cast<std::ptrdiff_t>(findings.size()));
}

TEST_CASE("numbers beyond all N, O and codes are findings like others", "[check]") {
    for (const char* number : {"2000000001", "993333333333333333"}) {
        const auto findings = check_text(std::string("O1\nWHILE[#1LT3]DO1\nGOTO") + number +
                                         "\nEND1\nM98P" + number + "\nG" + number + "\nM30\n");
        CHECK(std::any_of(findings.begin(), findings.end(), [](const auto& finding) {
            return finding.rule == "jump-target" && finding.line == 3;
        }));
    }
}

TEST_CASE("one cause is one finding, with how often", "[check]") {
    std::string text = "O1\n";
    for (int i = 0; i < 50; ++i) text += "G777\n";
    const auto findings = check_text(text + "M30\n");
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].line == 2);
    CHECK(findings[0].text.find("(50 times, last in line 51)") != std::string::npos);
}

TEST_CASE("an M code that the control lacks is one note for each code, no fault", "[check]") {
    const std::string text =
        "O1\nM141\nM8\nM141M3S1\nM5\nG65P9001M142.A1.\nM98P9001\nM143\nM144\nM30\nO9001\nM141\n"
        "M145\nM99\n";
    const auto owner = std::make_shared<const std::string>(text);
    check::CheckOptions options;
    options.knows_m = [](int code) { return code < 100 || code == 144; };
    options.calls_program = [](char letter, int code10) { return letter == 'M' && code10 == 1430; };
    const auto found = check::check_program({"p.nc", *owner, owner}, options);
    REQUIRE(found.size() == 2);
    CHECK(found[0].rule == "unknown-m");
    CHECK(found[0].severity == check::Severity::note);
    CHECK(found[0].line == 2);
    CHECK(found[0].column == 1);
    CHECK(found[0].text ==
          "M141 is not known to this control: it passes without effect (3 times, last in line 12)");
    CHECK_THAT(found[0].remedy, Catch::Contains("[control.builder]"));
    CHECK_THAT(found[1].text, Catch::StartsWith("M145 "));
    CHECK(check::count_faults(found) == 0);
    const auto report = [&](const char* format) {
        return report::format_findings(found, {"p.nc"}, format);
    };
    CHECK_THAT(report("text"), Catch::StartsWith("p.nc:2:1: note: M141") &&
                                   Catch::EndsWith("0 findings in 1 file, 2 notes\n"));
    CHECK_THAT(report("junit"), Catch::Contains("failures=\"0\""));
    CHECK_THAT(report("sarif"), Catch::Contains("\"level\": \"note\""));
    CHECK_THAT(report("github"), Catch::StartsWith("::notice "));
    CHECK_THAT(report("json"), Catch::Contains("\"severity\": \"note\""));
}

TEST_CASE("variables of one range, and programs of a missing folder, are one finding", "[check]") {
    std::string range = "O1\n", two = "O1\n", calls = "O1\n";
    for (int i = 0; i < 60; ++i) range += "#" + std::to_string(300 + i) + "=0\n";
    for (int i = 0; i < 100; ++i)
        two += "#" + std::to_string(990600 + i % 5) + "=#" + std::to_string(200 + 2 * i) + "\n";
    for (int i = 0; i < 7; ++i) calls += "M98P98" + std::to_string(10 + i * (i - 1)) + "\n";
    const auto one = check_text(range + "M30\n");
    REQUIRE(one.size() == 1);
    CHECK(one[0].line == 2);
    CHECK(one[0].column == 1);
    CHECK(one[0].text == "alarm 115: #300 to #359 (all 60 of them), in 60 places, last in line 61");
    const auto reads = check_text(two + "M30\n");
    REQUIRE(reads.size() == 1);
    CHECK(reads[0].text ==
          "alarm 115: #200 to #398 (100 of them), in 100 places, last in line 101");
    const auto missing = check_text(calls + "M30\n");
    REQUIRE(missing.size() == 1);
    CHECK(missing[0].text ==
          "programs O9810 to O9840 (6 of them) are called and nowhere to be found, in 7 places, "
          "last in line 8");
    CHECK(missing[0].line == 2);
    CHECK(missing[0].column == 4);
    CHECK(check_text("O1\n#300=1\n#301=1\n#302=1\nM30\n").size() == 3);  // few: each its own
    CHECK(check_text("O1\n#300=1\n#300=2\n#450=1\n#301=1\n#302=1\nM30\n").size() == 2);
    // Reading and writing, and far ranges, are causes of their own.
    CHECK(check_text("O1\n#0=1\n#0=2\n#300=1\n#301=1\nM98P300\nM98P301\nM30\n").size() == 6);
}

TEST_CASE("arcs that are wrong in the same way are one finding", "[check]") {
    std::string arcs = "O1\nG17G91\n";
    for (int i = 0; i < 200; ++i)
        arcs += "G2X10.Y" + std::to_string(i % 7) + ".I" + std::to_string(50 + i) + ".J3.F9.\n";
    const auto found = check_text(arcs + "M30\n");
    REQUIRE(found.size() == 1);
    CHECK(found[0].line == 3);
    CHECK_THAT(found[0].text,
               Catch::Contains("radius ") && Catch::EndsWith("(200 times, last in line 202)"));
}
