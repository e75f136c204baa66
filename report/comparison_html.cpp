#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "report/comparison_report.h"
#include "report/places.h"
#include "report/svg.h"

namespace trunnion {

namespace {

constexpr const char* style =
    "body{font:15px/1.5 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem;"
    "color:#222;background:#fff}h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2rem}"
    "table{border-collapse:collapse}td,th{padding:.2rem .7rem;border-bottom:1px solid #ddd;"
    "text-align:right}td:last-child,th:last-child,td:first-child{text-align:left}"
    "pre{background:#f6f6f4;padding:.5rem;overflow-x:auto;margin:.2rem 0}mark{background:#ffe28a}"
    ".pair{display:grid;grid-template-columns:1fr 1fr;gap:1rem}.equal{color:#00664a}"
    ".differs{color:#a33b00}svg{max-width:100%;height:auto}";

std::string place_html(const char* side, const ComparePlace& p) {
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

/// Looks along (-1, -1, -0.8) at the part: x to the right, z up.
Point2 seen(const std::array<double, 3>& p) {
    return {0.7071 * (p[0] - p[1]), 0.35 * (p[0] + p[1]) + 0.8 * p[2]};
}

struct View {
    double low_x = std::numeric_limits<double>::infinity(), low_y = low_x;
    double high_x = -low_x, high_y = -low_x;
    void widen(const ComparePicture::Line& line) {
        for (const auto& p : line) {
            const Point2 q = seen(p);
            low_x = std::min(low_x, q.x);
            high_x = std::max(high_x, q.x);
            low_y = std::min(low_y, q.y);
            high_y = std::max(high_y, q.y);
        }
    }
};

std::string picture_html(const ComparePicture& picture) {
    if (picture.a.empty() && picture.b.empty()) return {};
    View view;
    view.widen(picture.a);
    view.widen(picture.b);
    const double size = std::max({view.high_x - view.low_x, view.high_y - view.low_y, 1e-6});
    const double scale = 760.0 / size;
    const double height = (view.high_y - view.low_y) * scale + 60.0;
    Svg svg(820.0, height);
    const auto draw = [&](const ComparePicture::Line& line, const SvgStyle& line_style) {
        std::vector<Point2> points;
        for (const auto& p : line) {
            const Point2 q = seen(p);
            points.push_back(
                {30.0 + (q.x - view.low_x) * scale, height - 20.0 - (q.y - view.low_y) * scale});
        }
        if (points.size() > 1) svg.polyline(points, line_style);
    };
    draw(picture.a, {"#9a9a9a", 1.0, "none", ""});
    draw(picture.b, {"#56B4E9", 1.0, "none", "4 3"});
    for (const auto& line : picture.differing_a) draw(line, {"#D55E00", 2.5, "none", ""});
    for (const auto& line : picture.differing_b) draw(line, {"#0072B2", 2.5, "none", "5 3"});
    svg.text({30, 18}, "grey A, light blue B; where they differ: orange A, blue B", 12);
    return "<figure>" + svg.str() + "</figure>";
}

std::string range_html(const std::array<double, 2>& r) {
    return r[0] == r[1] ? fmt::format("{:g}", r[1]) : fmt::format("{:g}–{:g}", r[0], r[1]);
}

std::string table_html(const Comparison& c) {
    if (c.tools.empty()) return {};
    std::string out =
        "<table><tr><th>tool<th>cut A mm<th>cut B mm<th>longer by<th>feed A<th>feed B<th>spindle A"
        "<th>spindle B<th>equal<th>moved<th>changed<th>reordered<th>only A<th>only B</tr>\n";
    for (const ToolRow& r : c.tools)
        out += fmt::format(
            "<tr><td>T{}<td>{:.3f}<td>{:.3f}<td>{:+.3f}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}<td>{}"
            "<td>{}<td>{}<td>{}</tr>\n",
            r.tool, r.cut_a_mm, r.cut_b_mm, r.cut_b_mm - r.cut_a_mm, range_html(r.feed_a),
            range_html(r.feed_b), range_html(r.spindle_a), range_html(r.spindle_b), r.equal,
            r.moved, r.changed, r.reordered, r.only_a, r.only_b);
    return out + "</table>\n";
}

std::string case_html(const Comparison& c) {
    std::string out = fmt::format("<h2>{}</h2><p class=\"{}\">{}</p>\n",
                                  escape_xml(c.name.empty() ? c.b : c.name),
                                  c.equal ? "equal" : "differs", escape_xml(c.verdict));
    if (c.equal && c.differences.empty()) return out;
    out += picture_html(c.picture) + table_html(c);
    constexpr std::size_t shown = 200;
    for (std::size_t k = 0; k < std::min(shown, c.differences.size()); ++k) {
        const Difference& d = c.differences[k];
        out += fmt::format("<h3>{}. {}</h3>{}<div class=\"pair\">{}{}</div>\n", k + 1,
                           escape_xml(d.what),
                           d.expected ? "<p>expected: " + escape_xml(d.reason) + "</p>" : "",
                           place_html("A", d.a), place_html("B", d.b));
    }
    return out;
}

}  // namespace

std::string comparison_html(const CompareReport& report) {
    std::string out = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>trunnion "
        "compare</title><style>{}</style></head><body>\n<h1>{}</h1>\n",
        style, escape_xml(verdict_of(report)));
    for (const Comparison& c : report.cases) out += case_html(c);
    return out + "</body></html>\n";
}

}  // namespace trunnion
