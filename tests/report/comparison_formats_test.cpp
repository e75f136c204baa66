// One pair of programs in every format of `compare`: the same answer, place and cause in each.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "report/comparison_report.h"
#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

const std::string program = R"(%
O1000
G90 G21 G94 G54 G40 G49
T1 M6
S5000 M3
G0 X0. Y0.
G43 H1 Z160.
Z142.
G1 Z139. F300.
X30. F800.
G0 Z160.
M5
M30
%
)";

/// The pair: another length number, and a stop that only B has.
regression::CompareReport report_of_pair() {
    regression::CompareReport report;
    const std::string b = replaced(replaced(program, "G43 H1", "G43 H2"), "M5\n", "M0\nM5\n");
    report.cases.push_back(compare_texts(program, b, bc_table()));
    return report;
}

std::string written(report::ReportFormat format) {
    return report::format_comparison(report_of_pair(), format);
}

std::size_t count_of(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size())
        ++count;
    return count;
}

constexpr const char* cause = "H2 instead of H1";

}  // namespace

TEST_CASE("text: verdict, both places with the block marked, tools", "[compare]") {
    const std::string text = written(report::ReportFormat::text);
    INFO(text);
    CHECK(text.starts_with("differs by path: 2 differences"));
    CHECK(text.find("    A a.nc:7\n") != std::string::npos);
    CHECK(text.find("    B b.nc:7\n") != std::string::npos);
    CHECK(text.find("    >       7 | G43 H1 Z160.\n") != std::string::npos);
    CHECK(text.find("    >       7 | G43 H2 Z160.\n") != std::string::npos);
    CHECK(text.find("M0 is only in B") != std::string::npos);
    CHECK(text.find("  T1 ") != std::string::npos);
}

TEST_CASE("JSON: the contract's keys with the same place and cause", "[compare]") {
    const auto j = nlohmann::json::parse(written(report::ReportFormat::json));
    CHECK(j.at("schema") == "trunnion.compare/1");
    CHECK(j.at("equal") == false);
    CHECK(j.at("by") == "path");
    CHECK(j.at("first").at("a").at("line") == 7);
    CHECK(j.at("first").at("b").at("block") == "G43 H2 Z160.");
    CHECK(j.at("worst").at("position_mm").get<double>() == Approx(30.0));
    REQUIRE(j.at("differences").size() == 2);
    CHECK(j.at("differences")[0].at("cause") == cause);
    CHECK(j.at("differences")[1].at("kind") == "function");
}

TEST_CASE("JSON of folders: the first place, though a program of one folder comes before it",
          "[compare]") {
    regression::CompareReport report = report_of_pair();
    regression::Comparison alone;
    alone.equal = false;
    report.cases.insert(report.cases.begin(), alone);
    const auto j =
        nlohmann::json::parse(report::format_comparison(report, report::ReportFormat::json));
    CHECK(j.at("equal") == false);
    CHECK(j.at("first").at("a").at("line") == 7);
    CHECK(j.at("cases")[0].at("first").is_null());
}

TEST_CASE("markdown: a heading, a table row, the blocks of both sides", "[compare]") {
    const std::string text = written(report::ReportFormat::markdown);
    INFO(text);
    CHECK(text.starts_with("## differs by path"));
    CHECK(count_of(text, "\n| ") == 2);  // the head and one program
    CHECK(text.find("1. H2 instead of H1") != std::string::npos);
    CHECK(text.find("`` G43 H1 Z160. ``") != std::string::npos);
    CHECK(text.find("`` G43 H2 Z160. ``") != std::string::npos);
}

TEST_CASE("SARIF: one result for each difference, at its line of B", "[compare]") {
    const auto j = nlohmann::json::parse(written(report::ReportFormat::sarif));
    const auto& results = j.at("runs")[0].at("results");
    REQUIRE(results.size() == 2);
    const auto& place = results[0].at("locations")[0].at("physicalLocation");
    CHECK(place.at("artifactLocation").at("uri") == "b.nc");
    CHECK(place.at("region").at("startLine") == 7);
    CHECK(results[0].at("message").at("text").get<std::string>().find(cause) != std::string::npos);
}

TEST_CASE("GitHub: one annotation for the program, at its gravest difference", "[compare]") {
    const std::string text = written(report::ReportFormat::github);
    INFO(text);
    CHECK(count_of(text, "::error ") == 1);
    CHECK(text.find("file=b.nc,line=7") != std::string::npos);
    CHECK(text.find(cause) != std::string::npos);
}

TEST_CASE("JUnit: one failure with both differences", "[compare]") {
    const std::string text = written(report::ReportFormat::junit);
    INFO(text);
    CHECK(count_of(text, "<failure") == 1);
    CHECK(text.find("A a.nc:7") != std::string::npos);
    CHECK(text.find("M0 is only in B") != std::string::npos);
}

TEST_CASE("an equal pair is equal in every format", "[compare]") {
    regression::CompareReport report;
    report.cases.push_back(
        compare_texts(program, replaced(program, "X30.", "X30.000"), bc_table()));
    const auto in = [&](report::ReportFormat format) {
        return report::format_comparison(report, format);
    };
    CHECK(in(report::ReportFormat::text).starts_with("equal by words"));
    CHECK(nlohmann::json::parse(in(report::ReportFormat::json)).at("first").is_null());
    CHECK(in(report::ReportFormat::github).empty());
    CHECK(in(report::ReportFormat::junit).find("<failure") == std::string::npos);
    CHECK(in(report::ReportFormat::markdown).starts_with("## equal by words"));
    CHECK(
        nlohmann::json::parse(in(report::ReportFormat::sarif)).at("runs")[0].at("results").empty());
}
