// SARIF as GitHub takes it: the structure that its schema and rules ask for, limits, fingerprints.
#include "report/sarif.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "report/comparison_report.h"
#include "report/findings_report.h"
#include "report/places.h"
#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;
using Json = nlohmann::json;

namespace {

/// What the schema of SARIF 2.1.0 and GitHub's documentation ask for; the real validator that was
/// run stands in docs/compare.md.
void check_structure(const std::string& text) {
    const Json log = Json::parse(text);
    CHECK(log.at("version") == "2.1.0");
    CHECK(log.at("$schema").get<std::string>().find("sarif-2.1.0") != std::string::npos);
    REQUIRE(log.at("runs").size() == 1);
    const Json& run = log["runs"][0];
    const Json& driver = run.at("tool").at("driver");
    CHECK(driver.at("name") == "trunnion");
    for (const Json& rule : driver.at("rules"))
        for (const char* key : {"shortDescription", "fullDescription", "help"})
            REQUIRE_FALSE(rule.at(key).at("text").get<std::string>().empty());
    std::set<std::pair<std::string, std::string>> fingerprints;
    for (const Json& result : run.at("results")) {
        const auto index = result.at("ruleIndex").get<std::size_t>();
        REQUIRE(driver["rules"].at(index).at("id") == result.at("ruleId"));
        const std::string level = result.at("level");
        REQUIRE((level == "error" || level == "warning" || level == "note"));
        REQUIRE_FALSE(result.at("message").at("text").get<std::string>().empty());
        REQUIRE(result.at("locations").size() == 1);
        const Json& place = result["locations"][0].at("physicalLocation");
        const std::string uri = place.at("artifactLocation").at("uri");
        REQUIRE_FALSE(uri.empty());
        REQUIRE(uri.find_first_of(" \\<>") == std::string::npos);
        if (place.contains("region")) {
            const int first = place["region"].at("startLine");
            REQUIRE(first >= 1);
            REQUIRE(place["region"].value("endLine", first) >= first);
        }
        const std::string fingerprint =
            result.at("partialFingerprints").at("primaryLocationLineHash");
        REQUIRE(fingerprints.insert({uri, fingerprint}).second);
    }
}

std::vector<std::string> fingerprints_in(const std::string& sarif) {
    std::vector<std::string> result;
    const Json log = Json::parse(sarif);
    for (const Json& r : log["runs"][0]["results"])
        result.push_back(r["partialFingerprints"]["primaryLocationLineHash"]);
    return result;
}

const std::string program =
    "%\nO1\nG90 G21 G17 G94 G54\nT1 M6\nS500 M3\nG43 H1 Z10.\nG0 X0. Y0.\nZ2.\n"
    "G1 Z-1. F200.\nX50.\nG3 X60. Y10. I0. J10.\nG0 Z10.\nX0.\nG1 Z-2.\nX40.\nG0 Z10.\nM30\n%\n";

std::string sarif_of(const std::string& a, const std::string& b) {
    const regression::Comparison r = compare_texts(a, b, bc_table());
    return report::format_comparison({"", true, {r}}, report::ReportFormat::sarif);
}

std::vector<report::ReportItem> many(std::size_t count, std::size_t notes) {
    std::vector<report::ReportItem> items(count);
    for (std::size_t k = 0; k < count; ++k) {
        items[k].rule = "moved";
        items[k].level = k < notes ? "note" : "error";
        items[k].path = "my part.nc";
        items[k].line = static_cast<int>(k) + 1;
        items[k].text = "moved by X+0.01 mm";
    }
    return items;
}

}  // namespace

TEST_CASE("the SARIF of a comparison and of a check has the required structure", "[sarif]") {
    check_structure(sarif_of(program, program));
    std::string b = replaced(program, "X50.", "X50.1");
    b = replaced(b, "F200.", "F210.");
    b = replaced(b, "Z-2.", "Z-2.2");
    check_structure(sarif_of(program, b));
    check_structure(sarif_of(program, replaced(program, "G3", "<<<<<<< HEAD\nG3")));
    check_structure(report::format_findings(
        {{"jump-target", check::Severity::error, "a b.nc", 3, 1, "GOTO 50: no N50", "add N50"},
         {"jump-target", check::Severity::error, "a b.nc", 4, 1, "GOTO 50: no N50", "add N50"}},
        {"a b.nc"}, "sarif"));
}

TEST_CASE("fingerprints stay when lines are inserted above, removed below, renumbered", "[sarif]") {
    std::string b = replaced(program, "X50.", "X50.1");
    b = replaced(b, "Z-2.", "Z-2.2");
    const auto before = fingerprints_in(sarif_of(program, b));
    REQUIRE(before.size() >= 2);
    const auto with_head = [](const std::string& text) {
        return replaced(text, "O1\n", "O1\n(A NEW HEADER)\n(DATE 2026)\n\nG80\n");
    };
    CHECK(fingerprints_in(sarif_of(program, with_head(b))) == before);
    CHECK(fingerprints_in(sarif_of(with_head(program), with_head(b))) == before);
    CHECK(fingerprints_in(sarif_of(program, replaced(b, "M30", "(A)\n(B)\nM30"))) == before);
    // A pass added before them is one result more, and the others keep theirs.
    const auto more = fingerprints_in(sarif_of(
        program,
        replaced(b, "G0 X0. Y0.\n", "G0 X90. Y90.\nZ2.\nG1 Z-1. F200.\nG0 Z10.\nG0 X0. Y0.\n")));
    for (const std::string& f : before) {
        INFO(f);
        CHECK(std::find(more.begin(), more.end(), f) != more.end());
    }
    // Findings of check name lines in their text.
    const auto finding = [](const char* text, int line) {
        return fingerprints_in(report::format_findings(
            {{"jump-target", check::Severity::error, "a.nc", line, 1, text, ""}}, {"a.nc"},
            "sarif"));
    };
    CHECK(finding("N5 stands again at line 17", 3) == finding("N5 stands again at line 19", 5));
    CHECK(finding("N5 stands again at line 17", 3) != finding("N6 stands again at line 17", 3));
}

TEST_CASE("results at, below and above the limits of count and size", "[sarif]") {
    const std::vector<report::ReportRule> rules{{"moved", "The same path, shifted"}};
    const auto run_of = [&](const std::vector<report::ReportItem>& items,
                            const report::SarifLimits& limits) {
        return Json::parse(report::format_sarif(rules, items, limits))["runs"][0];
    };
    for (const std::size_t count : {4999, 5000, 5001, 25001}) {
        const Json run = run_of(many(count, 0), {});
        CHECK(run["results"].size() == std::min<std::size_t>(count, 5000));
        CHECK(run.contains("properties") == (count > 5000));
        if (count > 5000) CHECK(run["properties"]["resultsLeftOut"] == count - 5000);
    }
    // Notes (expected differences) give way to errors.
    const Json mixed = run_of(many(20, 15), {10, 1'000'000});
    CHECK(mixed["results"].size() == 10);
    CHECK(mixed["results"][0]["level"] == "error");
    CHECK(mixed["results"][5]["level"] == "note");
    // Size: long texts, so that the count is not what stops it.
    std::vector<report::ReportItem> items = many(3000, 0);
    for (report::ReportItem& item : items) item.text.assign(5000, 'x');
    const std::string text = report::format_sarif(rules, items);
    CHECK(text.size() < 10'000'000);
    CHECK(text.size() > 8'000'000);
    check_structure(report::format_sarif(rules, many(5001, 0)));
    const std::size_t one = run_of(many(1, 0), {})["results"][0].dump(2).size();
    CHECK(run_of(many(1, 0), {10, one})["results"].size() == 1);
    CHECK(run_of(many(1, 0), {10, one - 1})["results"].empty());
}
