// The page of a comparison: causes first, both paths, the first and the worst place from near.
#include <catch2/catch.hpp>

#include "report/comparison_report.h"
#include "tests/regression/programs.h"

using namespace trunnion;
using namespace trunnion::testing;

namespace {

const std::string program =
    "O1\nG90 G21 G94 G54 G40 G49\nT1 M6\nS5000 M3\nG0 X0. Y0. Z200.\nG1 Z150. F300.\nX30. F800.\n"
    "Y30.\nX0.\nY0.\nG0 Z200.\nX60.\nG1 Z150. F300.\nY10. F800.\nG0 Z200.\nM30\n";

/// The second cut lies 0.02 mm beside, the first one 0.5 mm.
regression::Comparison pair_of(const char* y) {
    const std::string b =
        replaced(replaced(program, "Y30.\nX0.", fmt::format("Y{}\nX0.", y)), "X60.", "X60.02");
    return compare_texts(program, b, bc_table());
}

std::size_t count_of(const std::string& text, const std::string& what) {
    std::size_t count = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += what.size())
        ++count;
    return count;
}

}  // namespace

TEST_CASE("close-ups stand where both paths lie apart, with the distance and the tool axis",
          "[compare]") {
    const regression::Comparison c = pair_of("30.5");
    INFO(c.verdict);
    REQUIRE(c.differences.size() == 2);
    REQUIRE(c.picture.closeups.size() == 1);
    const auto& first = c.picture.closeups.front();
    CHECK(first.first);
    CHECK(first.worst);
    CHECK(first.difference == 0);
    CHECK(first.apart_mm() == Approx(0.5));
    CHECK(first.up[1] == Approx(1.0));
    CHECK(first.axis_a[2] == Approx(1.0));
    CHECK_FALSE(first.a.empty());
}

TEST_CASE("the farthest place has a close-up of its own where the first difference is smaller",
          "[compare]") {
    const regression::Comparison c = pair_of("30.008");
    INFO(c.verdict);
    REQUIRE(c.picture.closeups.size() == 2);
    CHECK(c.picture.closeups[0].first);
    CHECK_FALSE(c.picture.closeups[0].worst);
    CHECK(c.picture.closeups[0].apart_mm() == Approx(0.008));
    CHECK(c.picture.closeups[1].worst);
    CHECK(c.picture.closeups[1].apart_mm() == Approx(0.02));
    CHECK(c.picture.closeups[1].difference == 1);
}

TEST_CASE("the page names each difference once, causes before pictures", "[compare]") {
    regression::CompareReport report;
    report.cases.push_back(pair_of("30.5"));
    const std::string html = report::page_html(report::comparison_page(report));
    const std::string& what = report.cases.front().differences.front().what;
    CHECK(count_of(html, what.substr(1)) == 1);
    CHECK(html.find("Differences and causes") < html.find("<h2>Where"));
    CHECK(count_of(html, "<svg ") == 4);  // three views, one close-up
    CHECK(count_of(html, "<title>") == 5);
    CHECK(html.find("0.5000 mm") != std::string::npos);
    CHECK(html.find("tool axis") != std::string::npos);
    CHECK(html.find("<script") == std::string::npos);
}

TEST_CASE("several programs have an index, gravest first, and the equal ones by name",
          "[compare]") {
    regression::CompareReport report;
    report.single = false;
    for (const char* y : {"30.008", "30.5"}) {
        report.cases.push_back(pair_of(y));
        report.cases.back().name = std::string("part") + y;
    }
    report.cases.push_back(compare_texts(program, program, bc_table()));
    report.cases.back().name = "same<part";
    const std::string html = report::page_html(report::comparison_page(report));
    CHECK(html.find("href=\"#program-1\">part30.5<") <
          html.find("href=\"#program-2\">part30.008<"));
    CHECK(html.find("id=\"program-2\"") != std::string::npos);
    CHECK(html.find("1 equal") != std::string::npos);
    CHECK(html.find("same&lt;part") != std::string::npos);
}

TEST_CASE("the picture survives the way through the parts of shards", "[compare]") {
    report::ComparePart part;
    part.report.cases.push_back(pair_of("30.008"));
    part.places = {0};
    part.total = 1;
    const report::ComparePart back = report::parse_part(report::format_part(part), "part");
    const auto page = [](const report::ComparePart& p) {
        return report::page_html(report::comparison_page(p.report));
    };
    CHECK(page(back) == page(part));
}
