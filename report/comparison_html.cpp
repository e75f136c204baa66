#include <fmt/format.h>

#include <algorithm>

#include "report/comparison_picture.h"
#include "report/comparison_report.h"
#include "report/places.h"

namespace trunnion::report {

namespace {

constexpr const char* style =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem;"
    "color:#222;background:#fff}h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2rem}"
    "table{border-collapse:collapse}td,th{padding:.2rem .7rem;border-bottom:1px solid #ddd;"
    "text-align:right}td:last-child,th:last-child,td:first-child{text-align:left}"
    "pre{background:#f6f6f4;padding:.5rem;overflow-x:auto;margin:.2rem 0}mark{background:#ffe28a}"
    ".pair{display:grid;grid-template-columns:1fr "
    "1fr;gap:1rem}.pair>div{min-width:0}.equal{color:#00664a}"
    ".differs{color:#a33b00}svg{max-width:100%;height:auto}";

std::string place_html(const char* side, const regression::ComparePlace& p) {
    if (p.line == 0)
        return fmt::format("<div>{} {}<pre>nothing here</pre></div>", side, escape_xml(p.program));
    std::string lines;
    for (int k = 0; k < static_cast<int>(p.context.size()); ++k) {
        const std::string text = fmt::format("{:>7} {}", p.line - p.context_at + k,
                                             escape_xml(p.context[static_cast<std::size_t>(k)]));
        lines += (k == p.context_at ? "<mark>" + text + "</mark>" : text) + "\n";
    }
    return fmt::format("<div>{} {}:{}<pre>{}</pre></div>", side, escape_xml(p.program), p.line,
                       lines);
}

std::string range_html(const std::array<double, 2>& r) {
    return r[0] == r[1] ? fmt::format("{:g}", r[1]) : fmt::format("{:g}–{:g}", r[0], r[1]);
}

std::string table_html(const regression::Comparison& c) {
    if (c.tools.empty()) return {};
    std::string out =
        "<table><tr><th>tool<th>cut A mm<th>cut B mm<th>longer by<th>feed A<th>feed B<th>spindle A"
        "<th>spindle B<th>equal<th>moved<th>changed<th>reordered<th>only A<th>only B</tr>\n";
    for (const regression::ToolRow& r : c.tools)
        if (r.says_something())
            out += fmt::format(
                "<tr><td>T{}<td>{:.3f}<td>{:.3f}<td>{:+.3f}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>"
                "{}"
                "<td>{}<td>{}<td>{}</tr>\n",
                r.tool, r.cut_a_mm, r.cut_b_mm, r.cut_b_mm - r.cut_a_mm, range_html(r.feed_a),
                range_html(r.feed_b), range_html(r.spindle_a), range_html(r.spindle_b), r.equal,
                r.moved, r.changed, r.reordered, r.only_a, r.only_b);
    return out + "</table>\n";
}

/// What was compared, by which layers, how long it takes, what else there is to know.
std::string facts_html(const regression::Comparison& c) {
    std::string out =
        fmt::format("<p>A: {}{}<br>B: {}{}<br>layers:", escape_xml(c.a),
                    c.setup.empty() ? "" : " on " + escape_xml(c.setup), escape_xml(c.b),
                    c.setup_b.empty() ? "" : " on " + escape_xml(c.setup_b));
    for (const regression::LayerVerdict& l : c.layers)
        out += fmt::format(" {} {}", name_of(l.layer), l.equal ? "equal" : "differs");
    if (c.time_a_s > 0.0 || c.time_b_s > 0.0)
        out += fmt::format("<br>cycle time {:.1f} → {:.1f} s", c.time_a_s, c.time_b_s);
    for (const std::string& note : c.notes) out += "<br>note: " + escape_xml(note);
    return out + "</p>\n";
}

std::string case_html(const regression::Comparison& c, bool single) {
    std::string out;
    if (!single)
        out = fmt::format("<h2>{}</h2><p class=\"{}\">{}</p>\n",
                          escape_xml(c.name.empty() ? c.b : c.name), c.equal ? "equal" : "differs",
                          escape_xml(c.verdict));
    if (single || !c.equal) out += facts_html(c);
    if (c.equal && c.differences.empty()) return out;
    out += picture_html(c) + table_html(c);
    constexpr std::size_t shown = 200;
    for (std::size_t k = 0; k < std::min(shown, c.differences.size()); ++k) {
        const regression::Difference& d = c.differences[k];
        out += fmt::format("<h3>{}. {}</h3>{}<div class=\"pair\">{}{}</div>\n", k + 1,
                           escape_xml(d.what),
                           d.expected ? "<p>expected: " + escape_xml(d.reason) + "</p>" : "",
                           place_html("A", d.a), place_html("B", d.b));
    }
    return out;
}

}  // namespace

std::string comparison_html(const regression::CompareReport& report) {
    const bool single = report.single && report.cases.size() == 1;
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>trunnion "
        "compare</title><style>{}</style></head><body>\n<h1 class=\"{}\">{}</h1>\n",
        style, regression::exit_code(report) == 0 ? "equal" : "differs",
        escape_xml(verdict_of(report)));
    for (const regression::Comparison& c : report.cases) out += case_html(c, single);
    for (const regression::ExpectedDifference& e : regression::no_longer_occurring(report))
        out +=
            fmt::format("<p>Expected, but no longer there: {} {} ({}).</p>\n",
                        escape_xml(e.case_name), escape_xml(e.fingerprint), escape_xml(e.reason));
    return out + "</body></html>\n";
}

}  // namespace trunnion::report
