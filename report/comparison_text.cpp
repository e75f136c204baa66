#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.h"
#include "report/comparison_report.h"
#include "report/paragraph.h"

namespace trunnion::report {

namespace {

std::string side_text(const char* side, const regression::ComparePlace& p) {
    if (p.line == 0) return fmt::format("    {} {}: nothing here\n", side, p.program);
    std::string out = fmt::format("    {} {}:{}\n", side, p.program, p.line);
    for (int k = 0; k < static_cast<int>(p.context.size()); ++k)
        out += fmt::format("    {} {:>7} | {}\n", k == p.context_at ? ">" : " ",
                           p.line - p.context_at + k,
                           printable(p.context[static_cast<std::size_t>(k)]));
    return out;
}

std::string difference_text(const regression::Difference& d, std::size_t number) {
    std::string out = paragraph(fmt::format("{}. {}", number, printable(d.what)), 2);
    if (d.expected) out += paragraph(fmt::format("expected: {}", d.reason), 4);
    return out + side_text("A", d.a) + side_text("B", d.b);
}

std::string range_text(const std::array<double, 2>& range) {
    if (range[0] == range[1]) return fmt::format("{:g}", range[1]);
    return fmt::format("{:g}..{:g}", range[0], range[1]);
}

std::string both_text(const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return a == b ? range_text(a) : range_text(a) + " -> " + range_text(b);
}

/// Result of a tool's passes, in words.
std::string fate_text(const regression::ToolRow& r) {
    std::string out;
    const auto say = [&](std::uint64_t count, const char* word) {
        if (count == 0) return;
        if (!out.empty()) out += ", ";
        out += fmt::format("{} {}", count, word);
    };
    say(r.equal, "equal");
    say(r.moved, "moved");
    say(r.changed, "changed");
    say(r.reordered, "reordered");
    say(r.only_a, "only in A");
    say(r.only_b, "only in B");
    return out;
}

std::string table_text(const regression::Comparison& c) {
    if (c.tools.empty()) return {};
    std::string out = "\n  tool  cut A mm  cut B mm longer by  feed mm/min  spindle rpm  passes\n";
    for (const regression::ToolRow& r : c.tools)
        if (r.says_something())
            out += fmt::format("  T{:<4} {:>8.3f} {:>9.3f} {:>+9.3f}  {:<11}  {:<11}  {}\n", r.tool,
                               r.cut_a_mm, r.cut_b_mm, r.cut_b_mm - r.cut_a_mm + 0.0,
                               both_text(r.feed_a, r.feed_b), both_text(r.spindle_a, r.spindle_b),
                               fate_text(r));
    return out;
}

std::string layers_text(const regression::Comparison& c) {
    std::string out = "  layers:";
    for (const regression::LayerVerdict& l : c.layers)
        out += fmt::format(" {} {}", name_of(l.layer), l.equal ? "equal" : "differs");
    return out + "\n";
}

std::string case_text(const regression::Comparison& c, bool single) {
    std::string out = paragraph(printable(single ? c.verdict : c.name + ": " + c.verdict), 0);
    if (c.equal && !single && c.differences.empty()) return out;
    if (!c.layers.empty()) out += layers_text(c);
    constexpr std::size_t shown = 20;
    const std::size_t gravest = regression::gravest_difference(c);
    for (std::size_t k = 0; k < std::min(shown, c.differences.size()); ++k)
        out += difference_text(c.differences[k], k + 1);
    const std::uint64_t more =
        c.differences.size() - std::min(shown, c.differences.size()) + c.differences_left_out;
    if (more > 0) {
        if (gravest >= shown)
            out += "  the most serious:\n" + difference_text(c.differences[gravest], gravest + 1);
        out += fmt::format("  and {} more (--format json lists them)\n", more);
    }
    if (c.position_mm > 0.0 || c.direction_deg > 0.0)
        out += fmt::format("  worst: {:.4f} mm, {:.4f} deg, A line {}, B line {}\n", c.position_mm,
                           c.direction_deg, c.worst_a.line, c.worst_b.line);
    out += table_text(c);
    if (c.time_a_s > 0.0 || c.time_b_s > 0.0)
        out += fmt::format("  cycle time {:.1f} -> {:.1f} s\n", c.time_a_s, c.time_b_s);
    for (const std::string& note : c.notes) out += paragraph("note: " + note, 2);
    return out;
}

}  // namespace

std::string comparison_text(const regression::CompareReport& report) {
    const bool single = report.single && report.cases.size() == 1;
    std::string out;
    if (!single) out = verdict_of(report) + "\n";
    for (const regression::Comparison& c : report.cases) out += case_text(c, single);
    for (const regression::ExpectedDifference& e : regression::no_longer_occurring(report))
        out +=
            fmt::format("expected, but no longer present: {} {} ({}); remove it from the suite\n",
                        e.case_name, e.fingerprint, e.reason);
    return out;
}

}  // namespace trunnion::report
