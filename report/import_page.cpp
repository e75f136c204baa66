#include "report/import_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/units.h"
#include "report/scatter.h"

namespace trunnion::report {
namespace {

struct TestSummary {
    std::string device;
    std::size_t rows = 0;
    double low_um = 0.0, high_um = 0.0, squares = 0.0;
    bool angular = false;
};

std::map<std::string, TestSummary> tests_of(const records::ReadingTable& table) {
    std::map<std::string, TestSummary> tests;
    for (const records::Reading& row : table.rows) {
        if (row.device == records::Device::none || !row.value_mm) continue;
        TestSummary& test = tests[row.test];
        const double value = row.angular ? urad_from_rad(*row.value_mm) : um_from_mm(*row.value_mm);
        test.device = name_of(row.device);
        test.angular = row.angular;
        test.low_um = test.rows == 0 ? value : std::min(test.low_um, value);
        test.high_um = test.rows == 0 ? value : std::max(test.high_um, value);
        test.squares += value * value;
        ++test.rows;
    }
    return tests;
}

std::string values_picture(const records::ReadingTable& table, bool angular) {
    Scatter scatter;
    scatter.title = angular ? "Angles read" : "Values read";
    scatter.description = "Each reading over its place in the table, by device.";
    scatter.x_label = "row";
    scatter.y_label = angular ? "reading / µrad" : "reading / µm";
    std::map<std::string, ScatterSeries> series;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const records::Reading& row = table.rows[i];
        if (row.device == records::Device::none || !row.value_mm || row.angular != angular)
            continue;
        const std::string device(name_of(row.device));
        series[device].name = device;
        series[device].points.push_back(
            {static_cast<double>(i + 1),
             angular ? urad_from_rad(*row.value_mm) : um_from_mm(*row.value_mm)});
    }
    if (series.empty()) return {};
    for (auto& [name, s] : series) scatter.series.push_back(std::move(s));
    return figure_html(scatter_svg(scatter), "Readings in the order taken");
}

/// Linear or rotary axes over time.
std::string positions_picture(const records::ReadingTable& table, bool rotary) {
    Scatter scatter;
    scatter.title = rotary ? "Rotary axes" : "Linear axes";
    scatter.description = "Logged position of each axis over time.";
    scatter.x_label = "time / s";
    scatter.y_label = rotary ? "position / deg" : "position / mm";
    for (const Axis axis : table.axes) {
        if (table.names.is_rotary(axis) != rotary) continue;
        ScatterSeries& series = scatter.series.emplace_back();
        series.name = table.names[axis];
        for (const records::Reading& row : table.rows)
            series.points.push_back(
                {row.time_s, rotary ? deg_from_rad(row.commanded[axis]) : row.commanded[axis]});
    }
    if (scatter.series.empty()) return {};
    return figure_html(scatter_svg(scatter), "Logged positions over time");
}

std::string lines_section(const std::string& heading, const std::vector<std::string>& lines) {
    std::string body;
    for (const std::string& line : lines) body += paragraph_html(line);
    return lines.empty() ? std::string() : section_html(heading, body);
}

/// A log of the axes contains no tests: its positions are drawn instead.
std::string results_html(const records::ReadingTable& table, const PageTable& tests) {
    if (tests.rows.empty())
        return section_html("Positions",
                            positions_picture(table, false) + positions_picture(table, true));
    return section_html("Tests", table_html(tests)) +
           section_html("Values", values_picture(table, false) + values_picture(table, true));
}

}  // namespace

Page import_page(const records::ReadingTable& table, const std::vector<std::string>& understood,
                 const std::vector<std::string>& assumed) {
    const auto tests = tests_of(table);
    std::size_t rows = 0;
    PageTable list{
        "", {"test", "device", "readings", "least", "largest", "rms", "unit"}, "llrrrrl", {}};
    for (const auto& [name, test] : tests) {
        rows += test.rows;
        list.rows.push_back(
            {name, test.device, fmt::format("{}", test.rows), fmt::format("{:.2f}", test.low_um),
             fmt::format("{:.2f}", test.high_um),
             fmt::format("{:.2f}", std::sqrt(test.squares / static_cast<double>(test.rows))),
             test.angular ? "µrad" : "µm"});
    }
    Page page;
    page.title = "Imported readings";
    page.verdict = tests.empty()
                       ? fmt::format("{} axis positions were understood.", table.rows.size())
                       : fmt::format("{} readings of {} test{} were understood.", rows,
                                     tests.size(), tests.size() == 1 ? "" : "s");
    page.body_html = lines_section("What was understood", understood) +
                     lines_section("What was assumed", assumed) + results_html(table, list) +
                     section_html("How to read this",
                                  paragraph_html("A reading is actual minus commanded, as "
                                                 "docs/readings.md says for its device. Nothing is "
                                                 "corrected here: identify and diagnose say what "
                                                 "the readings mean."));
    return page;
}

}  // namespace trunnion::report
