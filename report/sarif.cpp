// SARIF 2.1.0 (OASIS), as GitHub code scanning takes it.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "report/places.h"

namespace trunnion {

namespace {

using Json = nlohmann::ordered_json;

/// A path as a relative URI reference: '/' between folders, everything else percent-encoded.
std::string uri_of(const std::string& path) {
    std::string uri;
    for (const char c : path) {
        const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                           (c >= '0' && c <= '9') || c == '/' || c == '.' || c == '-' || c == '_' ||
                           c == '~';
        uri += plain ? std::string(1, c)
                     : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    }
    return path.starts_with("/") ? "file://" + uri : uri;
}

std::string fingerprint_of(const ReportItem& item) {
    if (!item.fingerprint.empty()) return item.fingerprint;
    std::uint64_t h = 0xCBF29CE484222325ULL;
    for (const char c : item.rule + "|" + item.path + "|" + item.text)
        h = (h ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
    return fmt::format("{:016x}", h);
}

/// The same finding at several places of a file is told apart by its count.
std::string numbered(std::map<std::string, int>& seen, const std::string& fingerprint) {
    const int before = seen[fingerprint]++;
    return before == 0 ? fingerprint : fmt::format("{}:{}", fingerprint, before);
}

Json result_of(const ReportItem& item, std::size_t rule_index, const std::string& fingerprint) {
    Json region = Json::object();
    if (item.line > 0) region["startLine"] = item.line;
    if (item.line > 0 && item.column > 0) region["startColumn"] = item.column;
    if (item.line > 0 && item.last_line > item.line) region["endLine"] = item.last_line;
    Json location = {{"artifactLocation", {{"uri", uri_of(item.path)}}}};
    if (!region.empty()) location["region"] = region;
    const std::string remedy = item.remedy.empty() ? "" : " " + item.remedy;
    return {{"ruleId", item.rule},
            {"ruleIndex", rule_index},
            {"level", item.level},
            {"message", {{"text", valid_utf8(item.text + remedy)}}},
            {"locations", Json::array({{{"physicalLocation", location}}})},
            {"partialFingerprints", {{"trunnion/v1", fingerprint}}}};
}

}  // namespace

std::string format_sarif(const std::vector<ReportRule>& rules, const std::vector<ReportItem>& items,
                         std::size_t most_results) {
    Json rule_list = Json::array();
    for (const ReportRule& rule : rules)
        rule_list.push_back({{"id", rule.id}, {"shortDescription", {{"text", rule.description}}}});
    Json results = Json::array();
    std::map<std::string, int> seen;
    for (const ReportItem& item : items) {
        if (results.size() == most_results) break;
        const auto rule = std::find_if(rules.begin(), rules.end(),
                                       [&](const ReportRule& r) { return r.id == item.rule; });
        results.push_back(result_of(item, static_cast<std::size_t>(rule - rules.begin()),
                                    numbered(seen, fingerprint_of(item))));
    }
    Json run = {
        {"tool", {{"driver", {{"name", "trunnion"}, {"version", "0.1.0"}, {"rules", rule_list}}}}},
        {"columnKind", "utf16CodeUnits"},
        {"results", results}};
    if (items.size() > results.size())
        run["properties"] = {{"resultsLeftOut", items.size() - results.size()}};
    const Json log = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                      {"version", "2.1.0"},
                      {"runs", Json::array({run})}};
    return log.dump(2) + "\n";
}

}  // namespace trunnion
