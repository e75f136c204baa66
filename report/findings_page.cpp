#include "report/findings_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/text.h"

namespace trunnion::report {
namespace {

std::string counted(std::size_t n, const char* one) {
    return fmt::format("{} {}{}", n, one, n == 1 ? "" : "s");
}

PageTable findings_table(const std::vector<check::Finding>& findings) {
    PageTable table{"", {"place", "what", "remedy", "severity", "rule"}, "lllll", {}};
    for (const check::Finding& f : findings)
        table.rows.push_back({valid_utf8(fmt::format("{}:{}:{}", f.path, f.line, f.column)),
                              valid_utf8(f.text), valid_utf8(f.remedy), name_of(f.severity),
                              f.rule});
    return table;
}

PageTable rules_table(const std::vector<check::Finding>& findings) {
    std::set<std::string> used;
    for (const check::Finding& f : findings) used.insert(f.rule);
    PageTable table{"", {"rule", "what it looks for"}, "ll", {}};
    for (const check::CheckRule& rule : check::check_rules())
        if (used.contains(rule.name)) table.rows.push_back({rule.name, rule.description});
    return table;
}

}  // namespace

Page findings_page(const std::vector<check::Finding>& findings,
                   const std::vector<std::string>& files) {
    const auto errors = static_cast<std::size_t>(std::count_if(
        findings.begin(), findings.end(),
        [](const check::Finding& f) { return f.severity == check::Severity::error; }));
    Page page;
    page.title = "Findings in NC programs";
    page.subject = counted(files.size(), "program") + " looked at";
    const std::size_t faults = check::count_faults(findings);
    page.verdict = faults == 0 ? std::string("Nothing found.")
                               : fmt::format("{} and {} found.", counted(errors, "error"),
                                             counted(faults - errors, "warning"));
    page.tone = errors > 0 ? Tone::bad : faults == 0 ? Tone::good : Tone::neutral;
    if (!findings.empty())
        page.body_html = section_html("Findings", table_html(findings_table(findings))) +
                         section_html("Rules", table_html(rules_table(findings)));
    page.body_html += section_html(
        "How to read this",
        paragraph_html(
            "An error stops the control or cannot be intended. A warning "
            "should be checked. A note is no fault. The place is file, line and column."));
    return page;
}

}  // namespace trunnion::report
