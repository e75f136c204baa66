#include "report/run_page.h"

#include <catch2/catch.hpp>

#include "report/packed_columns.h"
#include "report/page.h"

using namespace trunnion;

TEST_CASE("a page names the script and the style that it runs by their hashes and no other") {
    report::Page page;
    page.title = "A <title>";
    page.verdict = "equal & more";
    page.script = report::PageScript::chart;
    page.data_json = R"({"text": "</script><script>alert(1)</script>"})";
    page.origin.command = "trunnion run \"a.nc\"";
    page.origin.version = "1.2.3";
    const std::string html = report::page_html(page);
    CHECK(html.find("default-src 'none'; script-src 'sha256-") != std::string::npos);
    CHECK(html.find("unsafe") == std::string::npos);
    CHECK(html.find("A &lt;title&gt;") != std::string::npos);
    CHECK(html.find("equal &amp; more") != std::string::npos);
    CHECK(html.find("<script>alert") == std::string::npos);
    CHECK(html.find("trunnion 1.2.3") != std::string::npos);
}

TEST_CASE("a page without a script allows none") {
    CHECK(report::page_html(report::Page{}).find("script-src 'none'") != std::string::npos);
    CHECK(report::page_html(report::Page{}).find("<script") == std::string::npos);
}

TEST_CASE("packed columns: the same columns give the same text, and an even slope costs nothing") {
    report::PackedColumn even{"X", 1e-4, {}, -1, 1}, same{"Y", 1e-4, {}, -1, 1};
    for (int i = 0; i < 200'000; ++i) {
        even.number.push_back(25 * i - 7);
        same.number.push_back(-3);
    }
    const std::string text = report::packed_base64({even, same});
    CHECK(text == report::packed_base64({even, same}));
    CHECK(text.size() < 2000);
}

TEST_CASE("packed columns: a column that follows another costs nothing, with either sign") {
    std::vector<report::PackedColumn> columns{
        {"X", 1e-4, {}, -1, 1}, {"tip_x", 1e-4, {}, -1, 1}, {"time", 1.0, {}, -1, 1}};
    std::uint64_t noise = 1;
    for (int i = 0; i < 50'000; ++i) {
        noise = noise * 6364136223846793005ULL + 1442695040888963407ULL;
        columns[0].number.push_back(static_cast<std::int64_t>(noise >> 44));
        columns[1].number.push_back(12345 - columns[0].number.back());
        columns[2].number.push_back(i);
    }
    const std::string alone = report::packed_base64({columns[0]});
    report::find_likes(columns);
    CHECK(columns[1].like == 0);
    CHECK(columns[1].sign == -1);
    CHECK(columns[2].like == -1);
    CHECK(report::packed_base64(columns).size() < alone.size() + alone.size() / 50);
}

TEST_CASE("the path of a run is read from its trace in any pieces") {
    const std::string trace =
        "seq,program,line,motion,tool,feed_mm_min,x_mm,b_deg,tip_x_mm,tip_y_mm,tip_z_mm,tool_i,"
        "tool_j,tool_k,length_mm,time_s,true_x_mm,true_y_mm,true_z_mm\n"
        "0,\"a,b\"\"c.nc\",3,G0,1,0,10,90,1,2,3,0,0,1,10,0.5,1,2,3.25\n"
        "1,\"a,b\"\"c.nc\",4,G1,1,100,20,90,1,2,4,0,0,1,20,1.5,1,2,4\n";
    for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, trace.size()}) {
        report::RunPath path;
        for (std::size_t i = 0; i < trace.size(); i += piece) path.add(trace.substr(i, piece));
        REQUIRE(path.points().size() == 2);
        CHECK(path.programs() == std::vector<std::string>{"a,b\"c.nc"});
        CHECK(path.axis_columns() == std::vector<std::string>{"x_mm", "b_deg"});
        CHECK(path.points()[0].true_tip_W_mm[2] == 3.25);
        CHECK(path.points()[1].line == 4);
        CHECK(path.points()[1].axes == std::vector<double>{20.0, 90.0});
    }
}

TEST_CASE("a path beyond the limit keeps every second point and says so") {
    std::string trace =
        "seq,program,line,motion,tool,feed_mm_min,x_mm,tip_x_mm,tip_y_mm,tip_z_mm,time_s,"
        "true_x_mm,true_y_mm,true_z_mm\n";
    report::RunPath path;
    path.add(trace);
    for (std::size_t i = 0; i < report::RunPath::most + 10; ++i)
        path.add(std::to_string(i) + ",a,1,G1,1,0," + std::to_string(i) + ",0,0,0,0,0,0,0\n");
    CHECK(path.stride() == 2);
    CHECK(path.points().size() == report::RunPath::most / 2 + 5);
    for (std::size_t i = 0; i < path.points().size(); ++i)
        REQUIRE(path.points()[i].axes[0] == 2.0 * static_cast<double>(i));
}
