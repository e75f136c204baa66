#include "report/run_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/numbers.h"
#include "base/rounded.h"
#include "base/units.h"
#include "report/json_values.h"
#include "report/packed_columns.h"
#include "report/svg.h"

namespace trunnion::report {
namespace {

using Json = nlohmann::ordered_json;

constexpr double position_step_mm = 1e-4, angle_step_rad = 1e-7, deviation_step_mm = 1e-6,
                 time_step_s = 1e-3;

/// Fields of a CSV line; a quoted field keeps its commas, a doubled quote becomes one.
std::vector<std::string> fields_of(std::string_view line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

double number_of(const std::string& text) {
    return parse_number(text).value_or(0.0);
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
        if (c == '\n')
            lines.emplace_back();
        else if (c != '\r')
            lines.back() += c;
    }
    return lines;
}

double deviation_mm(const RunPath::Point& p) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += std::pow(p.true_tip_W_mm[k] - p.tip_W_mm[k], 2);
    return std::sqrt(sum);
}

/// Uses moves with feed only, or all moves if there are none. After G49 the control believes in no
/// tool, so that the tips during a retract differ by the tool length, which is irrelevant for the
/// part.
std::size_t worst_point(const std::vector<RunPath::Point>& points) {
    std::size_t worst = 0;
    for (std::size_t i = 1; i < points.size(); ++i)
        if (std::pair(points[i].feed, deviation_mm(points[i])) >
            std::pair(points[worst].feed, deviation_mm(points[worst])))
            worst = i;
    return worst;
}

/// Colours of the path (viridis, as in web/src/run.js) from zero to the largest deviation.
std::string scale_svg(double largest_mm) {
    Svg svg(420.0, 34.0);
    constexpr std::array<const char*, 5> colours{"#450054", "#3b528c", "#21918c", "#5ec962",
                                                 "#fde725"};
    for (std::size_t k = 0; k < colours.size(); ++k)
        svg.rectangle({60.0 + 50.0 * static_cast<double>(k), 8.0}, 50.0, 16.0,
                      {"none", 0.0, colours[k], ""});
    svg.text({52.0, 21.0}, "0", {12, "end"});
    svg.text({318.0, 21.0}, length_words(um_from_mm(largest_mm)), 12);
    svg.describe("Colours of the path", "From zero, dark, to the largest deviation, yellow.");
    return svg.str();
}

template <class Value>
PackedColumn column(const std::string& name, double step, const std::vector<RunPath::Point>& points,
                    const Value& value) {
    PackedColumn packed{name, step, {}, -1, 1};
    packed.number.reserve(points.size());
    for (const RunPath::Point& p : points)
        packed.number.push_back(std::llround(static_cast<double>(value(p)) / step));
    return packed;
}

bool is_angle(const std::string& axis_column) {
    return axis_column.ends_with("_deg");
}

/// "x_mm" -> "X"
std::string axis_name(const std::string& axis_column) {
    std::string name = axis_column.substr(0, axis_column.rfind('_'));
    for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return name;
}

std::vector<PackedColumn> columns_of(const RunPath& path) {
    const auto& points = path.points();
    std::vector<PackedColumn> columns;
    for (std::size_t k = 0; k < path.axis_columns().size(); ++k) {
        const std::string& name = path.axis_columns()[k];
        if (is_angle(name))
            columns.push_back(column(axis_name(name), angle_step_rad, points,
                                     [k](const auto& p) { return rad_from_deg(p.axes[k]); }));
        else
            columns.push_back(column(axis_name(name), position_step_mm, points,
                                     [k](const auto& p) { return p.axes[k]; }));
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const char letter = "xyz"[k];
        columns.push_back(column(fmt::format("tip_{}", letter), position_step_mm, points,
                                 [k](const auto& p) { return p.tip_W_mm[k]; }));
        columns.push_back(
            column(fmt::format("dev_{}", letter), deviation_step_mm, points,
                   [k](const auto& p) { return p.true_tip_W_mm[k] - p.tip_W_mm[k]; }));
    }
    columns.push_back(column("time", time_step_s, points, [](const auto& p) { return p.time_s; }));
    columns.push_back(column("line", 1, points, [](const auto& p) { return p.line; }));
    columns.push_back(column("program", 1, points, [](const auto& p) { return p.program; }));
    columns.push_back(column("feed", 1, points, [](const auto& p) { return p.feed ? 1 : 0; }));
    columns.push_back(column("tool", 1, points, [](const auto& p) { return p.tool; }));
    return columns;
}

Json machine_json(const setup::Setup& setup) {
    Json axes = Json::array();
    for (const auto* side : {&setup.machine.chain.work, &setup.machine.chain.tool})
        for (const kinematics::AxisGeometry& axis : *side) {
            Json entry = {{"name", std::string(1, letter_of(axis.axis))},
                          {"kind", axis.rotary ? "rotary" : "linear"},
                          {"side", side == &setup.machine.chain.work ? "work" : "tool"},
                          {"direction", vector_json(axis.direction)},
                          {"point", vector_json(axis.point_mm)}};
            if (axis.min) entry["min"] = *axis.min;
            if (axis.max) entry["max"] = *axis.max;
            axes.push_back(std::move(entry));
        }
    return {{"name", setup.name}, {"axes", axes}};
}

/// Gauge point to tip of each tool used by the path, in S, in the control's belief.
Json tools_json(const setup::Setup& setup, const std::vector<RunPath::Point>& points) {
    Json tools = Json::object();
    for (const RunPath::Point& p : points) {
        const std::string key = std::to_string(p.tool);
        if (tools.contains(key)) continue;
        const auto n = static_cast<std::size_t>(std::max(0, p.tool));
        const auto& known = setup.stores.tools.tool;
        const double length_mm = n > 0 && n < known.size() ? known[n].length_mm() : 0.0;
        tools[key] = Json::array({0.0, 0.0, length_mm > 0.0 ? -length_mm : -100.0});
    }
    return tools;
}

/// Programs of one page, in bytes: with a path of the largest size it stays below 2 MB.
constexpr std::size_t most_text_bytes = 100'000;

/// All lines, or those around `middle` (0-based) that fit into `budget` bytes of JSON.
Json lines_json(const std::string& name, const std::vector<std::string>& all, std::size_t middle,
                std::size_t budget) {
    const auto fits = [&](std::size_t line) { return all[line].size() + 3 <= budget; };
    std::size_t first = std::min(middle, all.size()), end = first;
    for (bool grows = true; grows;) {
        grows = false;
        if (end < all.size() && fits(end)) {
            budget -= all[end++].size() + 3;
            grows = true;
        }
        if (first > 0 && fits(first - 1)) {
            budget -= all[--first].size() + 3;
            grows = true;
        }
    }
    const auto at = [&](std::size_t line) {
        return all.begin() + static_cast<std::ptrdiff_t>(line);
    };
    return {{"name", name},
            {"count", all.size()},
            {"first", first},
            {"lines", std::vector<std::string>(at(first), at(end))}};
}

Json programs_json(const RunPath& path, const ProgramTexts& texts) {
    Json programs = Json::array();
    const RunPath::Point& worst = path.points()[worst_point(path.points())];
    for (std::size_t k = 0; k < path.programs().size(); ++k) {
        const std::string& name = path.programs()[k];
        int last = 0;
        for (const RunPath::Point& p : path.points())
            if (p.program == static_cast<int>(k)) last = std::max(last, p.line);
        const auto text = texts.find(name);
        std::vector<std::string> lines =
            text == texts.end() ? std::vector<std::string>{} : lines_of(text->second);
        lines.resize(std::max(lines.size(), static_cast<std::size_t>(last)));
        const bool here = worst.program == static_cast<int>(k);
        programs.push_back(lines_json(name, lines,
                                      here ? static_cast<std::size_t>(std::max(worst.line, 0)) : 0,
                                      most_text_bytes / path.programs().size()));
    }
    return programs;
}

std::string data_json(const setup::Setup& setup, const RunPath& path, const ProgramTexts& texts) {
    std::vector<PackedColumn> columns = columns_of(path);
    find_likes(columns);
    Json packed = Json::array();
    for (const PackedColumn& c : columns)
        packed.push_back({{"name", c.name}, {"step", c.step}, {"like", c.like}, {"sign", c.sign}});
    const Json json = {{"machine", machine_json(setup)},
                       {"tools", tools_json(setup, path.points())},
                       {"programs", programs_json(path, texts)},
                       {"start", worst_point(path.points())},
                       {"path",
                        {{"count", path.points().size()},
                         {"columns", packed},
                         {"packed", packed_base64(columns)}}}};
    return json_text(json, -1);
}

constexpr const char* view_html =
    "<div class=\"viewer\">\n<div class=\"stage\" id=\"stage\"></div>\n"
    "<div class=\"blocks\" id=\"blocks\" tabindex=\"0\" role=\"listbox\" "
    "aria-label=\"Blocks of the program\"></div>\n</div>\n"
    "<p class=\"note\" id=\"place\" role=\"status\"></p>\n"
    "<div class=\"controls\">\n<button id=\"play\" type=\"button\">Play</button>\n"
    "<button id=\"home\" type=\"button\">Whole path</button>\n"
    "<label>Place <input id=\"time\" type=\"range\" min=\"0\" value=\"0\" step=\"1\"></label>\n"
    "<label>Exaggerate <input id=\"exaggeration\" type=\"range\" min=\"0\" max=\"4\" step=\"0.1\" "
    "value=\"0\"> <output id=\"factor\">1 ×</output></label>\n</div>\n"
    "<p class=\"note no-print\">Drag turns the view, two fingers or the right button move it, the "
    "wheel "
    "zooms. A click on the path selects its block; a click on a block shows where it ends.</p>\n";

std::string figures_html(const emulator::RunLog& log, const RunPath& path) {
    PageTable table{"", {}, "lr", {}};
    table.rows.push_back({"Blocks executed", fmt::format("{}", log.result.blocks)});
    table.rows.push_back({"Moves", fmt::format("{}", log.result.moves)});
    table.rows.push_back({"Cycle time", fmt::format("{:.1f} s", log.result.time_s)});
    table.rows.push_back({"Length of the path", fmt::format("{:.1f} mm", log.result.path_mm)});
    table.rows.push_back({"Readings", fmt::format("{}", log.readings.rows.size())});
    if (path.stride() > 1)
        table.rows.push_back(
            {"Points shown", fmt::format("{} of {}, every {}th", path.points().size(), path.rows(),
                                         path.stride())});
    return table_html(table);
}

void set_verdict(Page& page, const emulator::RunLog& log, const RunPath& path) {
    if (const auto& alarm = log.result.alarm) {
        page.tone = Tone::bad;
        page.verdict =
            fmt::format("The control stopped with {} at {}:{}.", emulator::title_of(*alarm),
                        alarm->where.program, alarm->where.line);
        return;
    }
    const std::string ended = log.result.status == controller::RunStatus::limit
                                  ? "The run ended at a limit. "
                                  : "The program ran to its end. ";
    if (path.points().empty()) {
        page.verdict = ended + "No axis moved.";
        return;
    }
    const RunPath::Point& worst = path.points()[worst_point(path.points())];
    page.verdict = fmt::format(
        "{}{} the real tool tip is up to {} away from where the control believes it to be: at "
        "{}:{}.",
        ended, worst.feed ? "While feeding," : "In rapid moves",
        length_words(um_from_mm(deviation_mm(worst))),
        path.programs()[static_cast<std::size_t>(worst.program)], worst.line);
    page.tone = log.result.status == controller::RunStatus::limit ? Tone::bad : Tone::neutral;
}

constexpr const char* reading_text =
    "The path is drawn where the physical tip was, as seen from the table. Its colour is the "
    "distance from the tip that the control believes in: dark is small, yellow is the largest. The "
    "deviation holds errors of the machine, effects and stores that do not fit the machine; "
    "exaggerate it to see its direction. Solids are symbols: their axes, pivots and travels are "
    "those of the setup, their sizes are not. The largest deviation is that of moves with feed.";

}  // namespace

void RunPath::add(std::string_view chunk) {
    rest_ += chunk;
    std::size_t from = 0;
    for (std::size_t end; (end = rest_.find('\n', from)) != std::string::npos; from = end + 1) {
        const std::string_view line = std::string_view(rest_).substr(from, end - from);
        column_.empty() ? take_header(line) : take_row(line);
    }
    rest_.erase(0, from);
}

void RunPath::take_header(std::string_view line) {
    const std::vector<std::string> names = fields_of(line);
    bool axes = false;
    for (std::size_t k = 0; k < names.size(); ++k) {
        column_[names[k]] = k;
        if (names[k] == "tip_x_mm") axes = false;
        if (axes) axis_columns_.push_back(names[k]);
        if (names[k] == "feed_mm_min") axes = true;  // the axis columns are between these two
    }
}

int RunPath::program_index(const std::string& name) {
    const auto at = std::find(programs_.begin(), programs_.end(), name);
    if (at != programs_.end()) return static_cast<int>(at - programs_.begin());
    programs_.push_back(name);
    return static_cast<int>(programs_.size()) - 1;
}

void RunPath::take_row(std::string_view line) {
    const bool kept = rows_++ % static_cast<std::size_t>(stride_) == 0;
    const std::vector<std::string> fields = fields_of(line);
    const auto field = [&](const char* name) -> const std::string& {
        return fields.at(column_.at(name));
    };
    if (!kept) {
        if (field("motion") != "SAMPLE") close_move(field("motion") != "G0");
        return;
    }
    Point p;
    for (const std::string& axis : axis_columns_) p.axes.push_back(number_of(field(axis.c_str())));
    p.tip_W_mm = {number_of(field("tip_x_mm")), number_of(field("tip_y_mm")),
                  number_of(field("tip_z_mm"))};
    p.true_tip_W_mm = {number_of(field("true_x_mm")), number_of(field("true_y_mm")),
                       number_of(field("true_z_mm"))};
    p.time_s = number_of(field("time_s"));
    p.program = program_index(field("program"));
    p.line = static_cast<int>(number_of(field("line")));
    p.tool = static_cast<int>(number_of(field("tool")));
    points_.push_back(std::move(p));
    if (field("motion") != "SAMPLE") close_move(field("motion") != "G0");
    if (points_.size() >= most) thin();
}

/// Samples precede the end of their move, which defines its kind.
void RunPath::close_move(bool feed) {
    for (; open_ < points_.size(); ++open_) points_[open_].feed = feed;
}

void RunPath::thin() {
    for (std::size_t i = 1; 2 * i < points_.size(); ++i) points_[i] = std::move(points_[2 * i]);
    points_.resize((points_.size() + 1) / 2);
    open_ = std::min(open_, points_.size());
    stride_ *= 2;
}

Page run_page(const setup::Setup& setup, const emulator::RunLog& log, const RunPath& path,
              const ProgramTexts& programs) {
    Page page;
    page.title = "Run";
    page.subject = setup.name.empty() ? setup.path : setup.name;
    set_verdict(page, log, path);
    if (!path.points().empty()) {
        page.script = PageScript::run;
        page.data_json = data_json(setup, path, programs);
        const RunPath::Point& worst = path.points()[worst_point(path.points())];
        const std::string scale =
            figure_html(scale_svg(deviation_mm(worst)),
                        "Colour of the path: distance between physical and believed tip.");
        page.body_html =
            section_html("Machine and path", view_html + scale) +
            section_html("Deviation over time", "<div class=\"chart\" id=\"chart\"></div>\n");
    }
    page.body_html += section_html("Figures", figures_html(log, path)) +
                      section_html("How to read this page", paragraph_html(reading_text));
    return page;
}

}  // namespace trunnion::report
