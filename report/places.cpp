#include "report/places.h"

#include <fmt/format.h>

#include <algorithm>

namespace trunnion::report {

namespace {

std::string escape_github(const std::string& text, bool property) {
    std::string out;
    for (const char c : valid_utf8(text)) {
        if (c == '%')
            out += "%25";
        else if (c == '\r')
            out += "%0D";
        else if (c == '\n')
            out += "%0A";
        else if (property && c == ':')
            out += "%3A";
        else if (property && c == ',')
            out += "%2C";
        else
            out += c;
    }
    return out;
}

}  // namespace

std::string format_github(const std::vector<ReportItem>& items) {
    std::string out;
    for (const ReportItem& item : items) {
        std::string place = "file=" + escape_github(item.path, true);
        if (item.line > 0) place += fmt::format(",line={}", item.line);
        if (item.last_line > item.line) place += fmt::format(",endLine={}", item.last_line);
        if (item.column > 0) place += fmt::format(",col={}", item.column);
        const std::string level = item.level == "note" ? "notice" : item.level;
        const std::string remedy = item.remedy.empty() ? "" : " " + item.remedy;
        out += fmt::format("::{} {},title={}::{}\n", level, place,
                           escape_github("trunnion " + item.rule, true),
                           escape_github(item.text + remedy, false));
    }
    return out;
}

std::string format_junit(const std::string& suite, const std::vector<JUnitCase>& cases) {
    const auto failures = std::count_if(cases.begin(), cases.end(),
                                        [](const JUnitCase& c) { return !c.failure.empty(); });
    const std::string counts =
        fmt::format("tests=\"{}\" failures=\"{}\" errors=\"0\"", cases.size(), failures);
    std::string out = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {0}>\n"
        "  <testsuite name=\"{1}\" {0} skipped=\"0\">\n",
        counts, escape_xml(suite));
    for (const JUnitCase& c : cases) {
        out += fmt::format("    <testcase classname=\"{}\" name=\"{}\" file=\"{}\"",
                           escape_xml(suite), escape_xml(c.name), escape_xml(c.file));
        if (c.failure.empty())
            out += "/>\n";
        else
            out += fmt::format(">\n      <failure message=\"{}\">{}</failure>\n    </testcase>\n",
                               escape_xml(c.failure), escape_xml(c.details));
    }
    return out + "  </testsuite>\n</testsuites>\n";
}

}  // namespace trunnion::report
