// A comparison as a page: the answer, an index of programs, then causes, places, tools.
#include <fmt/format.h>

#include <algorithm>

#include "report/comparison_picture.h"
#include "report/comparison_report.h"
#include "report/page.h"
#include "report/xml.h"

namespace trunnion::report {

namespace {

std::string name_of_case(const regression::Comparison& c) {
    return c.name.empty() ? c.b : c.name;
}

std::string place_html(const char* side, const regression::ComparePlace& p) {
    if (p.line == 0)
        return fmt::format("<div><p>{} {}: nothing here</p></div>", side, escape_xml(p.program));
    std::string lines;
    for (int k = 0; k < static_cast<int>(p.context.size()); ++k) {
        const std::string text = fmt::format("{:>7} {}", p.line - p.context_at + k,
                                             escape_xml(p.context[static_cast<std::size_t>(k)]));
        lines += (k == p.context_at ? "<mark>" + text + "</mark>" : text) + "\n";
    }
    return fmt::format("<div><p>{} {}:{}</p><pre tabindex=\"0\">{}</pre></div>", side,
                       escape_xml(p.program), p.line, lines);
}

std::string difference_html(const regression::Difference& d, std::size_t number) {
    std::string what = d.what;
    if (!what.empty())
        what[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(what[0])));
    return fmt::format("<h3>{}. {}</h3>\n{}<div class=\"pair\">{}{}</div>\n", number,
                       escape_xml(what), d.expected ? paragraph_html("Expected: " + d.reason) : "",
                       place_html("A", d.a), place_html("B", d.b));
}

std::string differences_html(const regression::Comparison& c, std::size_t shown) {
    std::string out;
    for (std::size_t k = 0; k < std::min(shown, c.differences.size()); ++k)
        out += difference_html(c.differences[k], k + 1);
    const std::uint64_t more =
        c.differences.size() - std::min(shown, c.differences.size()) + c.differences_left_out;
    if (more > 0)
        out += paragraph_html(fmt::format("And {} more (--format json lists them).", more));
    return out;
}

std::string both_html(const std::array<double, 2>& a, const std::array<double, 2>& b) {
    const auto range = [](const std::array<double, 2>& r) {
        return r[0] == r[1] ? fmt::format("{:g}", r[1]) : fmt::format("{:g} to {:g}", r[0], r[1]);
    };
    return a == b ? range(a) : range(a) + " → " + range(b);
}

std::string tools_html(const regression::Comparison& c) {
    PageTable table{"",
                    {"Tool", "Cut of A, mm", "B longer by, mm", "Feed, mm/min", "Spindle, rpm",
                     "Passes equal", "moved", "changed", "reordered", "only in A", "only in B"},
                    "lrrllrrrrrr",
                    {}};
    for (const regression::ToolRow& r : c.tools)
        if (r.says_something())
            table.rows.push_back({fmt::format("T{}", r.tool), fmt::format("{:.3f}", r.cut_a_mm),
                                  fmt::format("{:+.3f}", r.cut_b_mm - r.cut_a_mm + 0.0),
                                  both_html(r.feed_a, r.feed_b),
                                  both_html(r.spindle_a, r.spindle_b), fmt::format("{}", r.equal),
                                  fmt::format("{}", r.moved), fmt::format("{}", r.changed),
                                  fmt::format("{}", r.reordered), fmt::format("{}", r.only_a),
                                  fmt::format("{}", r.only_b)});
    return table.rows.empty() ? "" : table_html(table);
}

/// Machines, layers, cycle time and other facts.
std::string facts_html(const regression::Comparison& c) {
    PageTable table{"", {}, "ll", {}};
    const bool one = c.setup == c.setup_b;
    if (!c.setup.empty()) table.rows.push_back({one ? "Machine" : "Machine of A", c.setup});
    if (!one && !c.setup_b.empty()) table.rows.push_back({"Machine of B", c.setup_b});
    std::string layers;
    for (const regression::LayerVerdict& l : c.layers)
        layers += fmt::format("{}{} {}", layers.empty() ? "" : ", ", name_of(l.layer),
                              l.equal ? "equal" : "differs");
    if (!layers.empty()) table.rows.push_back({"Layers", layers});
    if (c.time_a_s > 0.0 || c.time_b_s > 0.0)
        table.rows.push_back(
            {"Cycle time", fmt::format("{:.1f} s → {:.1f} s", c.time_a_s, c.time_b_s)});
    for (const std::string& note : c.notes) table.rows.push_back({"Note", note});
    return table_html(table);
}

/// The verdict without the sentences of the list of differences.
std::string short_verdict(const regression::Comparison& c) {
    using regression::CompareStatus;
    if (c.equal || c.differences.empty() || c.status == CompareStatus::bad_input) return c.verdict;
    const std::uint64_t count = c.differences.size() + c.differences_left_out;
    std::string text = fmt::format("{}ot the same: {} difference{} of the {}",
                                   c.status == CompareStatus::alarm ? "Stopped, and n" : "N", count,
                                   count == 1 ? "" : "s", name_of(c.by));
    if (c.position_mm > 0.0) text += fmt::format(", up to {:.4f} mm apart", c.position_mm);
    if (const std::size_t gravest = regression::gravest_difference(c); gravest > 0)
        text += fmt::format(", the most serious is number {}", gravest + 1);
    return text + ".";
}

std::string with_heading(bool single, const char* heading, const std::string& body) {
    if (body.empty()) return {};
    return single ? section_html(heading, body) : fmt::format("<h3>{}</h3>\n{}", heading, body);
}

std::string case_html(const regression::Comparison& c, bool single) {
    const std::string differences = differences_html(c, single ? 200 : 20);
    return (single ? with_heading(true, "Differences and causes", differences) : differences) +
           with_heading(single, "Where", pictures_html(c)) +
           with_heading(single, "Tools", tools_html(c)) +
           with_heading(single, "What was compared", facts_html(c));
}

/// The programs that differ, most severe first, then the equal ones by name.
std::string index_html(const std::vector<const regression::Comparison*>& differing,
                       const regression::CompareReport& report) {
    std::string out =
        "<div class=\"scroll\" tabindex=\"0\"><table>\n<thead><tr><th>Program</th><th>Answer</th>"
        "<th class=\"number\">Farthest, mm</th></tr></thead>\n<tbody>\n";
    for (std::size_t k = 0; k < differing.size(); ++k)
        out += fmt::format(
            "<tr><td><a href=\"#program-{}\">{}</a></td><td>{}</td><td class=\"number\">{:.4f}</td>"
            "</tr>\n",
            k + 1, escape_xml(name_of_case(*differing[k])),
            escape_xml(short_verdict(*differing[k])), differing[k]->position_mm);
    out = differing.empty() ? "" : out + "</tbody>\n</table></div>\n";
    std::string equal;
    std::size_t count = 0;
    for (const regression::Comparison& c : report.cases) {
        if (!c.equal) continue;
        equal += (count++ > 0 ? ", " : "") + name_of_case(c);
    }
    if (count > 0)
        out += fmt::format("<details><summary>{} equal</summary>{}</details>\n", count,
                           paragraph_html(equal));
    return section_html("Programs", out);
}

std::string many_html(const regression::CompareReport& report) {
    std::vector<const regression::Comparison*> differing;
    for (const regression::Comparison& c : report.cases)
        if (!c.equal) differing.push_back(&c);
    std::stable_sort(differing.begin(), differing.end(), [](const auto* p, const auto* q) {
        return regression::gravity_of(*p) > regression::gravity_of(*q);
    });
    std::string out = index_html(differing, report);
    for (std::size_t k = 0; k < differing.size(); ++k)
        out +=
            fmt::format("<section id=\"program-{}\">\n<h2>{}</h2>\n{}</section>\n", k + 1,
                        escape_xml(name_of_case(*differing[k])), case_html(*differing[k], false));
    return out;
}

}  // namespace

Page comparison_page(const regression::CompareReport& report) {
    const bool single = report.single && report.cases.size() == 1;
    Page page;
    page.tone = regression::exit_code(report) == 0 ? Tone::good : Tone::bad;
    page.title = "Is it the same machining?";
    page.subject =
        single ? report.cases.front().a + " and " + report.cases.front().b : report.suite;
    page.verdict = single ? short_verdict(report.cases.front()) : verdict_of(report);
    if (!page.verdict.empty())
        page.verdict[0] =
            static_cast<char>(std::toupper(static_cast<unsigned char>(page.verdict[0])));
    page.body_html = single ? case_html(report.cases.front(), true) : many_html(report);
    for (const regression::ExpectedDifference& e : regression::no_longer_occurring(report))
        page.body_html += paragraph_html(fmt::format("Expected, but no longer present: {} {} ({}).",
                                                     e.case_name, e.fingerprint, e.reason));
    const auto drawn = [](const regression::Comparison& c) { return !c.picture.empty(); };
    if (std::any_of(report.cases.begin(), report.cases.end(), drawn))
        page.body_html += section_html("How to read the pictures", paragraph_html(pictures_legend));
    return page;
}

}  // namespace trunnion::report
