// A comparison as JUnit, SARIF and GitHub lines; merging of the parts of shards.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/alarm.h"
#include "report/comparison_report.h"
#include "report/places.h"
#include "report/sarif.h"

namespace trunnion::report {

namespace {

const std::vector<ReportRule>& difference_rules() {
    static const std::vector<ReportRule> table = {
        {"moved", "The same path, shifted"},
        {"path", "Another path"},
        {"only-in-a", "Machining that is missing in B"},
        {"only-in-b", "Machining that B adds"},
        {"reordered", "The same passes in another order"},
        {"feed", "Another feed"},
        {"spindle", "Another spindle speed"},
        {"coolant", "Coolant differs"},
        {"tool", "Another tool"},
        {"time", "Another cycle time"},
        {"value", "Another result: variable, offset or printed line"},
        {"alarm", "An NC alarm stopped a program"},
        {"text", "What is written differs"},
        {"function", "Another machine function: M or T code, dwell, mode, store"},
        {"case", "A program could not be compared"},
        {"stale-expectation", "An expected difference no longer occurs"}};
    return table;
}

/// The position to open: in B, the new program, or in A where B has nothing.
ReportItem item_of(const regression::Difference& d) {
    const regression::ComparePlace& p = d.b.line > 0 || d.a.line == 0 ? d.b : d.a;
    ReportItem item;
    item.rule = name_of(d.kind);
    item.level = d.expected ? "note" : "error";
    item.path = p.program;
    item.line = p.line;
    item.last_line = std::max(p.line, p.last_line);
    item.text = d.what;
    if (d.a.line > 0 && d.b.line > 0 && d.a.program != d.b.program)
        item.text += fmt::format(" (A: {}:{})", d.a.program, d.a.line);
    if (d.expected) item.text += " (expected: " + d.reason + ")";
    item.fingerprint = d.fingerprint;
    return item;
}

/// A whole program as one item: position of its most severe difference, with its verdict.
ReportItem item_of(const regression::Comparison& c) {
    const std::size_t gravest = regression::gravest_difference(c);
    ReportItem item;
    if (gravest < c.differences.size())
        item = item_of(c.differences[gravest]);
    else
        item.rule = "case";
    if (item.path.empty()) item.path = c.b.empty() ? c.a : c.b;
    item.level = "error";
    item.text = c.verdict;
    return item;
}

ReportItem item_of(const regression::ExpectedDifference& e, const std::string& suite) {
    ReportItem item;
    item.rule = "stale-expectation";
    item.level = "warning";
    item.path = suite;
    item.text = fmt::format("expected, but no longer present: {} {} ({})", e.case_name,
                            e.fingerprint, e.reason);
    return item;
}

std::vector<ReportItem> items_of(const regression::CompareReport& report) {
    std::vector<ReportItem> items;
    for (const regression::Comparison& c : report.cases) {
        for (const regression::Difference& d : c.differences) items.push_back(item_of(d));
        if (c.equal || !c.differences.empty()) continue;
        ReportItem whole;
        whole.rule = "case";
        whole.path = c.b.empty() ? c.a : c.b;
        whole.text = c.verdict;
        items.push_back(whole);
    }
    for (const regression::ExpectedDifference& e : regression::no_longer_occurring(report))
        items.push_back(item_of(e, report.suite));
    return items;
}

/// GitHub shows ten annotations of a step: one for each program that differs, most severe first;
/// the last one counts the remaining programs.
std::vector<ReportItem> annotations_of(const regression::CompareReport& report) {
    constexpr std::size_t shown = 10;
    std::vector<const regression::Comparison*> order;
    for (const regression::Comparison& c : report.cases)
        if (!c.equal) order.push_back(&c);
    std::stable_sort(order.begin(), order.end(),
                     [](const regression::Comparison* p, const regression::Comparison* q) {
                         return regression::gravity_of(*p) > regression::gravity_of(*q);
                     });
    std::vector<ReportItem> items;
    const std::size_t room = order.size() > shown ? shown - 1 : order.size();
    for (std::size_t k = 0; k < room; ++k) items.push_back(item_of(*order[k]));
    for (const regression::ExpectedDifference& e : regression::no_longer_occurring(report))
        if (items.size() < shown && order.size() <= room) items.push_back(item_of(e, report.suite));
    if (order.size() <= room) return items;
    ReportItem rest;
    rest.rule = "case";
    rest.level = "error";
    rest.path = order[room]->b.empty() ? order[room]->a : order[room]->b;
    rest.text = fmt::format("{} more programs differ: see the report", order.size() - room);
    items.push_back(rest);
    return items;
}

std::uint64_t left_out_of(const regression::CompareReport& report) {
    std::uint64_t count = 0;
    for (const regression::Comparison& c : report.cases) count += c.differences_left_out;
    return count;
}

std::string junit_of(const regression::CompareReport& report) {
    std::vector<JUnitCase> cases;
    for (const regression::Comparison& c : report.cases) {
        JUnitCase j{c.name.empty() ? c.b : c.name, c.b, "", ""};
        if (!c.equal) {
            j.failure = c.verdict;
            for (const regression::Difference& d : c.differences)
                if (!d.expected)
                    j.details += fmt::format("A {}:{}  B {}:{}  {}\n", d.a.program, d.a.line,
                                             d.b.program, d.b.line, d.what);
        }
        cases.push_back(j);
    }
    return format_junit(report.suite.empty() ? "trunnion compare" : report.suite, cases);
}

constexpr std::array<const char*, 7> format_names{"text",   "json", "junit",   "sarif",
                                                  "github", "html", "markdown"};

}  // namespace

ReportFormat report_format(const std::string& name) {
    const auto found = std::find(format_names.begin(), format_names.end(), name);
    if (found == format_names.end())
        throw InputError("--format " + name +
                         " is not one of text, json, junit, sarif, github, html, markdown");
    return static_cast<ReportFormat>(found - format_names.begin());
}

std::string format_comparison(const regression::CompareReport& report, ReportFormat format) {
    switch (format) {
        case ReportFormat::text: return comparison_text(report);
        case ReportFormat::json: return comparison_json(report);
        case ReportFormat::html: return page_html(comparison_page(report));
        case ReportFormat::junit: return junit_of(report);
        case ReportFormat::sarif:
            return format_sarif(difference_rules(), items_of(report), {}, left_out_of(report));
        case ReportFormat::github: return format_github(annotations_of(report));
        case ReportFormat::markdown: return comparison_markdown(report);
    }
    return {};
}

namespace {

/// Each file of any part once, in the order of one process.
std::vector<FileRead> inputs_together(const std::vector<ComparePart>& parts) {
    std::set<std::pair<std::string, std::string>> files;
    for (const ComparePart& part : parts)
        for (const FileRead& file : part.report.inputs) files.emplace(file.path, file.sha256);
    std::vector<FileRead> list;
    for (const auto& [path, hash] : files) list.push_back({path, hash});
    return list;
}

/// Before anything is made as large as a part says.
void refuse_missing(const std::vector<ComparePart>& parts) {
    std::size_t cases = 0;
    for (const ComparePart& part : parts) cases += part.places.size();
    if (cases < parts.front().total)
        throw InputError(fmt::format("merge: {} of {} cases are in no part: a shard is missing",
                                     parts.front().total - cases, parts.front().total));
}

}  // namespace

regression::CompareReport merge_parts(const std::vector<ComparePart>& parts) {
    if (parts.empty()) throw InputError("merge: no parts given");
    const ComparePart& first = parts.front();
    regression::CompareReport whole{
        first.report.suite, first.report.single, {}, first.report.expected, {}};
    refuse_missing(parts);
    whole.cases.resize(first.total);
    std::vector<bool> seen(first.total, false);
    for (const ComparePart& part : parts) {
        if (part.report.suite != first.report.suite || part.total != first.total)
            throw InputError("merge: parts of different suites: '" + first.report.suite +
                             "' and '" + part.report.suite + "'");
        for (std::size_t k = 0; k < part.places.size(); ++k) {
            const std::size_t place = part.places[k];
            if (place >= whole.cases.size() || seen[place])
                throw InputError(fmt::format("merge: case {} is in two parts", place + 1));
            seen[place] = true;
            whole.cases[place] = part.report.cases[k];
        }
    }
    whole.inputs = inputs_together(parts);
    return whole;
}

}  // namespace trunnion::report
