// SARIF 2.1.0 (OASIS), as accepted by GitHub code scanning.
#include "report/sarif.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "report/json_values.h"

namespace trunnion::report {

namespace {

using Json = nlohmann::ordered_json;

/// A path as a relative URI reference: '/' between folders, other special characters
/// percent-encoded.
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

/// The text without line numbers, which change when lines are added or removed above.
std::string without_line_numbers(const std::string& text) {
    std::string out;
    for (std::size_t at = 0; at < text.size();) {
        out += text[at++];
        if (!out.ends_with("line ")) continue;
        while (at < text.size() && text[at] >= '0' && text[at] <= '9') ++at;
    }
    return out;
}

/// One for each item; equal items are distinguished by their order.
std::vector<std::string> fingerprints_of(const std::vector<ReportItem>& items) {
    std::map<std::string, int> before;
    std::vector<std::string> result;
    for (const ReportItem& item : items) {
        const std::string what =
            item.path + "|" +
            (item.fingerprint.empty() ? item.rule + "|" + without_line_numbers(item.text)
                                      : item.fingerprint);
        std::uint64_t h = 0xCBF29CE484222325ULL;
        for (const char c : what) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001B3ULL;
        result.push_back(fmt::format("{:016x}:{}", h, ++before[what]));
    }
    return result;
}

/// Selection when there are too many items: errors before notes, otherwise in order.
std::vector<std::size_t> most_telling(const std::vector<ReportItem>& items, std::size_t most) {
    std::vector<std::size_t> order(items.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (items.size() <= most) return order;
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t k) { return items[k].level != "note"; });
    order.resize(most);
    return order;
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
            // The key by which GitHub tracks a result.
            {"partialFingerprints", {{"primaryLocationLineHash", fingerprint}}}};
}

}  // namespace

std::string format_sarif(const std::vector<ReportRule>& rules, const std::vector<ReportItem>& items,
                         const SarifLimits& limits, std::uint64_t left_out) {
    Json rule_list = Json::array();
    for (const ReportRule& rule : rules)
        rule_list.push_back({{"id", rule.id},
                             {"shortDescription", {{"text", rule.description}}},
                             {"fullDescription", {{"text", rule.description + "."}}},
                             {"help", {{"text", rule.description + ". See docs/compare.md."}}}});
    const std::vector<std::string> fingerprints = fingerprints_of(items);
    Json results = Json::array();
    std::size_t bytes = 0;
    for (const std::size_t k : most_telling(items, limits.results)) {
        const ReportItem& item = items[k];
        const auto rule = std::find_if(rules.begin(), rules.end(),
                                       [&](const ReportRule& r) { return r.id == item.rule; });
        Json result =
            result_of(item, static_cast<std::size_t>(rule - rules.begin()), fingerprints[k]);
        bytes += result.dump(2).size();
        if (bytes > limits.bytes) break;
        results.push_back(std::move(result));
    }
    left_out += items.size() - results.size();
    Json run = {
        {"tool", {{"driver", {{"name", "trunnion"}, {"version", "0.1.0"}, {"rules", rule_list}}}}},
        {"columnKind", "utf16CodeUnits"},
        {"results", results}};
    if (left_out > 0) run["properties"] = {{"resultsLeftOut", left_out}};
    const Json log = {{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                      {"version", "2.1.0"},
                      {"runs", Json::array({run})}};
    return json_text(log, 2) + "\n";
}

}  // namespace trunnion::report
