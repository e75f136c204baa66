#include "report/findings_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/alarm.h"
#include "report/json_values.h"
#include "report/paragraph.h"
#include "report/places.h"
#include "report/sarif.h"

namespace trunnion::report {

namespace {

std::string line_of(const check::Finding& f) {
    return fmt::format("{}:{}:{}: {}: {} [{}]{}\n", printable(f.path), f.line, f.column,
                       name_of(f.severity), printable(f.text), f.rule,
                       f.remedy.empty() ? "" : " " + f.remedy);
}

/// The place on one line, as editors read it; the remedy below.
std::string place_and_remedy(const check::Finding& f) {
    check::Finding place = f;
    place.remedy.clear();
    return line_of(place) + paragraph(printable(f.remedy), 4);
}

std::string text_of(const std::vector<check::Finding>& findings, std::size_t files) {
    std::string out;
    for (const check::Finding& f : findings) out += place_and_remedy(f);
    const std::size_t faults = check::count_faults(findings), notes = findings.size() - faults;
    out += fmt::format("{} finding{} in {} file{}", faults, faults == 1 ? "" : "s", files,
                       files == 1 ? "" : "s");
    if (notes > 0) out += fmt::format(", {} note{}", notes, notes == 1 ? "" : "s");
    return out + "\n";
}

std::string json_of(const std::vector<check::Finding>& findings,
                    const std::vector<std::string>& files, const std::vector<FileRead>& inputs) {
    nlohmann::ordered_json j = {{"schema", "trunnion.check/1"},
                                {"files", files.size()},
                                {"findings", nlohmann::ordered_json::array()}};
    for (const check::Finding& f : findings)
        j["findings"].push_back({{"rule", f.rule},
                                 {"severity", name_of(f.severity)},
                                 {"path", valid_utf8(f.path)},
                                 {"line", f.line},
                                 {"column", f.column},
                                 {"text", valid_utf8(f.text)},
                                 {"remedy", valid_utf8(f.remedy)}});
    add_inputs(j, inputs);
    return json_text(j, 2) + "\n";
}

std::vector<ReportItem> items_of(const std::vector<check::Finding>& findings) {
    std::vector<ReportItem> items;
    for (const check::Finding& f : findings)
        items.push_back(
            {f.rule, name_of(f.severity), f.path, f.line, f.column, f.line, f.text, f.remedy, ""});
    return items;
}

std::vector<ReportRule> rules() {
    std::vector<ReportRule> list;
    for (const check::CheckRule& rule : check::check_rules())
        list.push_back({rule.name, rule.description});
    return list;
}

std::string junit_of(const std::vector<check::Finding>& findings,
                     const std::vector<std::string>& files) {
    std::vector<JUnitCase> cases;
    for (const std::string& file : files) {
        JUnitCase c{file, file, "", ""};
        int count = 0;
        for (const check::Finding& f : findings)
            if (f.path == file && f.severity != check::Severity::note) {
                if (++count == 1) c.failure = f.text;
                c.details += line_of(f);
            }
        if (count > 1) c.failure += fmt::format(", and {} more", count - 1);
        cases.push_back(c);
    }
    return format_junit("trunnion check", cases);
}

}  // namespace

std::string format_findings(const std::vector<check::Finding>& findings,
                            const std::vector<std::string>& files, const std::string& format,
                            const std::vector<FileRead>& inputs) {
    if (format == "text") return text_of(findings, files.size());
    if (format == "json") return json_of(findings, files, inputs);
    if (format == "junit") return junit_of(findings, files);
    if (format == "sarif") return format_sarif(rules(), items_of(findings));
    if (format == "github") return format_github(items_of(findings));
    throw InputError("--format " + format + " is not one of text, json, junit, sarif, github");
}

}  // namespace trunnion::report
