// A comparison as GitHub-flavoured Markdown.
#include <fmt/format.h>

#include <algorithm>

#include "base/text.h"
#include "report/comparison_report.h"

namespace trunnion::report {

namespace {

/// Escapes text for a table cell or a line: no markup, and no bar that would end the cell.
std::string plain(const std::string& text) {
    std::string out;
    for (const char c : printable(text)) {
        if (c == '\n' || c == '\r') {
            out += ' ';
            continue;
        }
        if (std::string_view("\\`*_{}[]<>()#+!|~").find(c) != std::string_view::npos) out += '\\';
        out += c;
    }
    return out;
}

std::string place(const regression::ComparePlace& p) {
    return p.line > 0 ? fmt::format("{}:{}", plain(p.program), p.line) : plain(p.program);
}

std::string comparison_row(const regression::Comparison& c) {
    const std::string name = c.name.empty() ? c.b : c.name;
    return fmt::format("| {} | {} | {} |\n", plain(name), c.equal ? "equal" : "**differs**",
                       plain(c.verdict));
}

std::string block(const char* side, const regression::ComparePlace& p) {
    return fmt::format("  - {} {}: `` {} ``\n", side, place(p), printable(p.block));
}

std::string details(const regression::Comparison& c) {
    constexpr std::size_t shown = 5;
    std::string out = fmt::format("\n### {}\n\n", plain(c.name.empty() ? c.b : c.name));
    for (std::size_t k = 0; k < std::min(shown, c.differences.size()); ++k) {
        const regression::Difference& d = c.differences[k];
        out += fmt::format("{}. {}\n", k + 1, plain(d.what));
        out += block("A", d.a) + block("B", d.b);
    }
    const std::uint64_t more =
        c.differences.size() - std::min(shown, c.differences.size()) + c.differences_left_out;
    if (more > 0) out += fmt::format("\nand {} more\n", more);
    return out;
}

}  // namespace

std::string comparison_markdown(const regression::CompareReport& report) {
    std::vector<const regression::Comparison*> order;
    for (const regression::Comparison& c : report.cases)
        if (!c.equal || report.cases.size() == 1) order.push_back(&c);
    std::stable_sort(order.begin(), order.end(),
                     [](const regression::Comparison* p, const regression::Comparison* q) {
                         return regression::gravity_of(*p) > regression::gravity_of(*q);
                     });
    constexpr std::size_t listed = 200, detailed = 10;  // a GitHub summary is limited to 1 MB
    std::string out = fmt::format("## {}\n", plain(verdict_of(report)));
    if (order.empty()) return out;
    out += "\n| program | | answer |\n|---|---|---|\n";
    for (std::size_t k = 0; k < std::min(listed, order.size()); ++k)
        out += comparison_row(*order[k]);
    if (order.size() > listed)
        out += fmt::format("\n{} more programs differ\n", order.size() - listed);
    for (std::size_t k = 0; k < std::min(detailed, order.size()); ++k)
        if (!order[k]->differences.empty()) out += details(*order[k]);
    return out;
}

}  // namespace trunnion::report
