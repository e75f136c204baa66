#include "report/places.h"

#include <fmt/format.h>

#include <algorithm>

namespace trunnion {

namespace {

/// Length of the UTF-8 sequence that `lead` begins, 0 when none can.
std::size_t sequence_length(unsigned char lead) {
    if (lead < 0x80) return 1;
    if (lead >= 0xC2 && lead < 0xE0) return 2;
    if (lead >= 0xE0 && lead < 0xF0) return 3;
    return lead >= 0xF0 && lead < 0xF5 ? 4 : 0;
}

/// The second byte also decides: overlong forms, surrogates and values beyond U+10FFFF are refused.
bool second_byte_fits(unsigned char lead, unsigned char second) {
    if (lead == 0xE0) return second >= 0xA0;
    if (lead == 0xED) return second < 0xA0;
    if (lead == 0xF0) return second >= 0x90;
    return lead != 0xF4 || second < 0x90;
}

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

std::string valid_utf8(const std::string& text) {
    std::string out;
    for (std::size_t k = 0; k < text.size();) {
        const auto lead = static_cast<unsigned char>(text[k]);
        const std::size_t length = sequence_length(lead);
        bool good = length > 0 && k + length <= text.size();
        for (std::size_t n = 1; good && n < length; ++n)
            good = (static_cast<unsigned char>(text[k + n]) & 0xC0) == 0x80;
        if (good && length > 1)
            good = second_byte_fits(lead, static_cast<unsigned char>(text[k + 1]));
        if (good)
            out.append(text, k, length);
        else
            out += '?';
        k += good ? length : 1;
    }
    return out;
}

std::string escape_xml(const std::string& text) {
    std::string out;
    for (const char c : valid_utf8(text)) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')
            out += '?';
        else
            out += c;
    }
    return out;
}

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

}  // namespace trunnion
