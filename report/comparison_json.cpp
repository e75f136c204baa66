#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/alarm.h"
#include "report/comparison_report.h"
#include "report/json_values.h"
#include "report/places.h"

namespace trunnion::report {

namespace {

using Json = nlohmann::ordered_json;

Json place_json(const regression::ComparePlace& p, bool whole) {
    Json j = {{"program", valid_utf8(p.program)}, {"line", p.line}, {"block", valid_utf8(p.block)}};
    if (!whole) return j;
    j["last_line"] = p.last_line;
    j["context_at"] = p.context_at;
    j["context"] = Json::array();
    for (const std::string& line : p.context) j["context"].push_back(valid_utf8(line));
    return j;
}

regression::ComparePlace place_of(const Json& j) {
    regression::ComparePlace p;
    p.program = j.at("program");
    p.line = j.at("line");
    p.block = j.at("block");
    p.last_line = j.at("last_line");
    p.context_at = j.at("context_at");
    p.context = j.at("context").get<std::vector<std::string>>();
    return p;
}

Json difference_json(const regression::Difference& d) {
    return {{"kind", name_of(d.kind)},
            {"what", valid_utf8(d.what)},
            {"cause", valid_utf8(d.cause)},
            {"a", place_json(d.a, true)},
            {"b", place_json(d.b, true)},
            {"position_mm", d.position_mm},
            {"direction_deg", d.direction_deg},
            {"shift_mm", d.shift_mm},
            {"value_a", d.value_a},
            {"value_b", d.value_b},
            {"tool", d.tool},
            {"count", d.count},
            {"fingerprint", d.fingerprint},
            {"expected", d.expected},
            {"reason", valid_utf8(d.reason)}};
}

template <typename Names>
std::size_t index_of_name(const Names& names, const std::string& name) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) throw InputError("unknown name '" + name + "'");
    return static_cast<std::size_t>(found - names.begin());
}

regression::Difference difference_of(const Json& j) {
    regression::Difference d;
    d.kind = static_cast<regression::DifferenceKind>(
        index_of_name(regression::difference_names, j.at("kind")));
    d.what = j.at("what");
    d.cause = j.at("cause");
    d.a = place_of(j.at("a"));
    d.b = place_of(j.at("b"));
    d.position_mm = j.at("position_mm");
    d.direction_deg = j.at("direction_deg");
    d.shift_mm = j.at("shift_mm");
    d.value_a = j.at("value_a");
    d.value_b = j.at("value_b");
    d.tool = j.at("tool");
    d.count = j.at("count");
    d.fingerprint = j.at("fingerprint");
    d.expected = j.at("expected");
    d.reason = j.at("reason");
    return d;
}

/// Columns of the table: JSON name and member, used for writing and reading.
template <typename Row, typename Visit>
void each_column(Row& r, const Visit& visit) {
    visit("tool", r.tool);
    visit("passes_a", r.passes_a);
    visit("passes_b", r.passes_b);
    visit("equal", r.equal);
    visit("moved", r.moved);
    visit("changed", r.changed);
    visit("reordered", r.reordered);
    visit("only_a", r.only_a);
    visit("only_b", r.only_b);
    visit("cut_a_mm", r.cut_a_mm);
    visit("cut_b_mm", r.cut_b_mm);
    visit("rapid_a_mm", r.rapid_a_mm);
    visit("rapid_b_mm", r.rapid_b_mm);
    visit("cut_a_s", r.cut_a_s);
    visit("cut_b_s", r.cut_b_s);
    visit("feed_a_mm_min", r.feed_a);
    visit("feed_b_mm_min", r.feed_b);
    visit("spindle_a_rpm", r.spindle_a);
    visit("spindle_b_rpm", r.spindle_b);
}

Json row_json(const regression::ToolRow& row) {
    Json j;
    each_column(row, [&](const char* name, const auto& value) { j[name] = value; });
    return j;
}

regression::ToolRow row_of(const Json& j) {
    regression::ToolRow row;
    each_column(row, [&](const char* name, auto& value) { j.at(name).get_to(value); });
    return row;
}

Json first_json(const regression::Comparison& c) {
    const auto open = std::find_if(c.differences.begin(), c.differences.end(),
                                   [](const regression::Difference& d) { return !d.expected; });
    if (open == c.differences.end()) return nullptr;
    return {{"a", place_json(open->a, false)},
            {"b", place_json(open->b, false)},
            {"what", valid_utf8(open->what)}};
}

/// The keys of the JSON format, then additional data for reports.
Json case_json(const regression::Comparison& c) {
    Json j = {{"equal", c.equal},
              {"by", name_of(c.by)},
              {"first", first_json(c)},
              {"worst",
               {{"position_mm", c.position_mm},
                {"direction_deg", c.direction_deg},
                {"a", place_json(c.worst_a, true)},
                {"b", place_json(c.worst_b, true)}}},
              {"compared", c.compared},
              {"name", valid_utf8(c.name)},
              {"file_a", valid_utf8(c.a)},
              {"file_b", valid_utf8(c.b)},
              {"setup", valid_utf8(c.setup)},
              {"setup_b", valid_utf8(c.setup_b)},
              {"status", regression::status_names[static_cast<std::size_t>(c.status)]},
              {"verdict", valid_utf8(c.verdict)}};
    j["layers"] = Json::array();
    for (const regression::LayerVerdict& l : c.layers)
        j["layers"].push_back({{"name", name_of(l.layer)}, {"equal", l.equal}});
    j["differences"] = Json::array();
    for (const regression::Difference& d : c.differences)
        j["differences"].push_back(difference_json(d));
    j["differences_left_out"] = c.differences_left_out;
    j["tools"] = Json::array();
    for (const regression::ToolRow& row : c.tools) j["tools"].push_back(row_json(row));
    j["time_a_s"] = c.time_a_s;
    j["time_b_s"] = c.time_b_s;
    j["alarm_a"] = valid_utf8(c.alarm_a);
    j["alarm_b"] = valid_utf8(c.alarm_b);
    j["notes"] = Json::array();
    for (const std::string& note : c.notes) j["notes"].push_back(valid_utf8(note));
    return j;
}

regression::Comparison case_of(const Json& j) {
    regression::Comparison c;
    c.equal = j.at("equal");
    c.by = static_cast<regression::Layer>(index_of_name(regression::layer_names, j.at("by")));
    c.position_mm = j.at("worst").at("position_mm");
    c.direction_deg = j.at("worst").at("direction_deg");
    c.worst_a = place_of(j.at("worst").at("a"));
    c.worst_b = place_of(j.at("worst").at("b"));
    c.compared = j.at("compared");
    c.name = j.at("name");
    c.a = j.at("file_a");
    c.b = j.at("file_b");
    c.setup = j.at("setup");
    c.setup_b = j.at("setup_b");
    c.status = static_cast<regression::CompareStatus>(
        index_of_name(regression::status_names, j.at("status")));
    c.verdict = j.at("verdict");
    for (const Json& l : j.at("layers"))
        c.layers.push_back(
            {static_cast<regression::Layer>(index_of_name(regression::layer_names, l.at("name"))),
             l.at("equal")});
    for (const Json& d : j.at("differences")) c.differences.push_back(difference_of(d));
    c.differences_left_out = j.at("differences_left_out");
    for (const Json& row : j.at("tools")) c.tools.push_back(row_of(row));
    c.time_a_s = j.at("time_a_s");
    c.time_b_s = j.at("time_b_s");
    c.alarm_a = j.at("alarm_a");
    c.alarm_b = j.at("alarm_b");
    c.notes = j.at("notes").get<std::vector<std::string>>();
    return c;
}

/// Parts of a close-up: JSON name and member, used for writing and reading.
template <typename Closeup, typename Visit>
void each_part(Closeup& c, const Visit& visit) {
    visit("difference", c.difference);
    visit("first", c.first);
    visit("worst", c.worst);
    visit("place_mm", c.place_mm);
    visit("other_mm", c.other_mm);
    visit("right", c.right);
    visit("up", c.up);
    visit("axis_a", c.axis_a);
    visit("axis_b", c.axis_b);
    visit("a", c.a);
    visit("b", c.b);
}

Json picture_json(const regression::ComparePicture& p) {
    Json j = {{"cuts_a", p.cuts_a},     {"cuts_b", p.cuts_b},     {"rapids_a", p.rapids_a},
              {"rapids_b", p.rapids_b}, {"marks", Json::array()}, {"closeups", Json::array()}};
    for (const regression::ComparePicture::Mark& m : p.marks)
        j["marks"].push_back({{"difference", m.difference}, {"a", m.a}, {"b", m.b}});
    for (const regression::ComparePicture::Closeup& c : p.closeups) {
        Json closeup;
        each_part(c, [&](const char* name, const auto& value) { closeup[name] = value; });
        j["closeups"].push_back(closeup);
    }
    return j;
}

regression::ComparePicture picture_of(const Json& j) {
    regression::ComparePicture p;
    j.at("cuts_a").get_to(p.cuts_a);
    j.at("cuts_b").get_to(p.cuts_b);
    j.at("rapids_a").get_to(p.rapids_a);
    j.at("rapids_b").get_to(p.rapids_b);
    for (const Json& m : j.at("marks")) {
        p.marks.emplace_back();
        m.at("difference").get_to(p.marks.back().difference);
        m.at("a").get_to(p.marks.back().a);
        m.at("b").get_to(p.marks.back().b);
    }
    for (const Json& closeup : j.at("closeups")) {
        p.closeups.emplace_back();
        each_part(p.closeups.back(),
                  [&](const char* name, auto& value) { closeup.at(name).get_to(value); });
    }
    return p;
}

Json expected_json(const std::vector<regression::ExpectedDifference>& list) {
    Json j = Json::array();
    for (const regression::ExpectedDifference& e : list)
        j.push_back({{"case", valid_utf8(e.case_name)},
                     {"fingerprint", valid_utf8(e.fingerprint)},
                     {"reason", valid_utf8(e.reason)}});
    return j;
}

Json suite_json(const regression::CompareReport& report) {
    Json j = {{"schema", "trunnion.compare/1"}, {"equal", regression::exit_code(report) == 0}};
    const regression::Comparison* worst = nullptr;
    const regression::Comparison* first = nullptr;
    const regression::Comparison* placed = nullptr;  // a program of one folder only has no place
    std::uint64_t compared = 0;
    for (const regression::Comparison& c : report.cases) {
        compared += c.compared;
        if (first == nullptr && !c.equal) first = &c;
        if (placed == nullptr && !c.equal && !first_json(c).is_null()) placed = &c;
        if (worst == nullptr || c.position_mm > worst->position_mm) worst = &c;
    }
    j["by"] = name_of(first != nullptr ? first->by : regression::Layer::path);
    j["first"] = placed != nullptr ? first_json(*placed) : Json(nullptr);
    j["worst"] = worst != nullptr ? case_json(*worst).at("worst") : Json(nullptr);
    j["compared"] = compared;
    j["suite"] = valid_utf8(report.suite);
    j["verdict"] = valid_utf8(verdict_of(report));
    j["cases"] = Json::array();
    for (const regression::Comparison& c : report.cases) j["cases"].push_back(case_json(c));
    j["no_longer_occurring"] = expected_json(regression::no_longer_occurring(report));
    return j;
}

}  // namespace

std::string comparison_json(const regression::CompareReport& report) {
    Json j = {{"schema", "trunnion.compare/1"}};
    if (!report.single || report.cases.size() != 1)
        j = suite_json(report);
    else
        j.update(case_json(report.cases.front()));
    add_inputs(j, report.inputs);
    return json_text(j, 2) + "\n";
}

std::string format_part(const ComparePart& part) {
    Json j = {{"schema", "trunnion.compare-part/1"},
              {"suite", part.report.suite},
              {"single", part.report.single},
              {"total", part.total},
              {"expected", expected_json(part.report.expected)},
              {"cases", Json::array()}};
    for (std::size_t k = 0; k < part.report.cases.size(); ++k) {
        Json c = case_json(part.report.cases[k]);
        c["place"] = part.places[k];
        c["picture"] = picture_json(part.report.cases[k].picture);
        j["cases"].push_back(c);
    }
    add_inputs(j, part.report.inputs);
    return json_text(j, 1) + "\n";
}

ComparePart parse_part(const std::string& text, const std::string& path) {
    const std::string refusal = "not a part written by 'compare --shard' or 'identify --shard'";
    const Json j = json_of_file(text, path, refusal);
    try {
        if (j.at("schema") != "trunnion.compare-part/1") throw InputError("another schema");
        ComparePart part;
        part.report.suite = j.at("suite");
        part.report.single = j.at("single");
        part.total = j.at("total");
        for (const Json& e : j.at("expected"))
            part.report.expected.push_back({e.at("case"), e.at("fingerprint"), e.at("reason")});
        for (const Json& c : j.at("cases")) {
            part.report.cases.push_back(case_of(c));
            part.report.cases.back().picture = picture_of(c.at("picture"));
            part.places.push_back(c.at("place"));
        }
        part.report.inputs = inputs_of(j);
        return part;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& fault) {
        throw InputError(refused_form(refusal, fault), {path});
    }
}

}  // namespace trunnion::report
