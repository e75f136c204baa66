#include "records/readings.h"

#include <array>
#include <cmath>
#include <functional>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/units.h"

namespace trunnion {
namespace {

constexpr std::array<std::string_view, 4> device_names{"", "sphere", "touch", "ballbar"};
constexpr std::array<std::string_view, 5> mode_names{"", "dpp", "rtdfo", "rtcp", "tw"};

template <class List>
std::optional<std::size_t> find_name(const List& names, std::string_view text) {
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == text) return i;
    return std::nullopt;
}

/// One cell of the table with its place, for messages.
struct Cell {
    std::string_view text;
    int column = 1;
};

struct Line {
    std::string_view text;
    int number = 0;
    std::string path;

    [[noreturn]] void fail(const std::string& message, int column) const {
        throw InputError(message, {path, number, column}, std::string(text));
    }
};

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    return text;
}

std::vector<Cell> split(const Line& line) {
    std::vector<Cell> cells;
    std::size_t start = 0;
    for (bool more = true; more;) {
        const bool quoted = start < line.text.size() && line.text[start] == '"';
        std::size_t end = 0;
        Cell cell;
        cell.column = static_cast<int>(start) + 1;
        if (quoted) {
            const std::size_t close = line.text.find('"', start + 1);
            if (close == std::string_view::npos) line.fail("quote is not closed", cell.column);
            cell.text = line.text.substr(start + 1, close - start - 1);
            end = line.text.find(',', close);
        } else {
            end = line.text.find(',', start);
            cell.text =
                trimmed(line.text.substr(start, end == std::string_view::npos ? end : end - start));
        }
        cells.push_back(cell);
        more = end != std::string_view::npos;
        start = end + 1;
    }
    return cells;
}

double number_of(const Line& line, const Cell& cell, const char* what) {
    const auto value = parse_number(cell.text);
    if (!value)
        line.fail(std::string(what) + ": '" + std::string(cell.text) + "' is not a finite number",
                  cell.column);
    return *value;
}

using Store = std::function<void(Reading&, const Line&, const Cell&)>;

template <class Set>
Store number(const char* what, double otherwise, Set set) {
    return [=](Reading& row, const Line& line, const Cell& cell) {
        set(row, cell.text.empty() ? otherwise : number_of(line, cell, what));
    };
}

template <class Set>
Store required_number(const char* what, Set set) {
    return [=](Reading& row, const Line& line, const Cell& cell) {
        set(row, number_of(line, cell, what));
    };
}

void store_device(Reading& row, const Line& line, const Cell& cell) {
    const auto i = find_name(device_names, cell.text);
    if (!i) line.fail("device is sphere, touch, ballbar or empty", cell.column);
    row.device = static_cast<Device>(*i);
}

void store_mode(Reading& row, const Line& line, const Cell& cell) {
    const auto i = find_name(mode_names, cell.text);
    if (!i) line.fail("mode is dpp, rtdfo, rtcp, tw or empty", cell.column);
    row.mode = static_cast<PositioningMode>(*i);
}

void store_index(Reading& row, const Line& line, const Cell& cell) {
    const double value = number_of(line, cell, "index");
    if (std::abs(value) > 2e9 || value != static_cast<int>(value))
        line.fail("index is a whole number", cell.column);
    row.index = static_cast<int>(value);
}

void store_clamped(Reading& row, const Line& line, const Cell& cell) {
    if (cell.text != "" && cell.text != "0" && cell.text != "1")
        line.fail("clamped is 0, 1 or empty", cell.column);
    row.clamped = cell.text == "1";
}

template <class Member>
Store optional_number(const char* what, Member member) {
    return [=](Reading& row, const Line& line, const Cell& cell) {
        if (!cell.text.empty()) row.*member = number_of(line, cell, what);
    };
}

const std::map<std::string_view, Store>& fixed_columns() {
    static const std::map<std::string_view, Store> columns{
        {"index", store_index},
        {"time_s", required_number("time_s", [](Reading& r, double v) { r.time_s = v; })},
        {"test", [](Reading& r, const Line&, const Cell& c) { r.test = c.text; }},
        {"device", store_device},
        {"feature", [](Reading& r, const Line&, const Cell& c) { r.feature = c.text; }},
        {"value_mm", optional_number("value_mm", &Reading::value_mm)},
        {"dir_x", number("dir_x", 0.0, [](Reading& r, double v) { r.direction_M.x() = v; })},
        {"dir_y", number("dir_y", 0.0, [](Reading& r, double v) { r.direction_M.y() = v; })},
        {"dir_z", number("dir_z", 0.0, [](Reading& r, double v) { r.direction_M.z() = v; })},
    };
    return columns;
}

const std::map<std::string_view, Store>& optional_columns() {
    static const std::map<std::string_view, Store> columns{
        {"mode", store_mode},
        {"feed_mm_min",
         number("feed_mm_min", 0.0, [](Reading& r, double v) { r.feed_mm_min = v; })},
        {"spindle_deg",
         number("spindle_deg", 0.0, [](Reading& r, double v) { r.spindle_rad = rad_from_deg(v); })},
        {"temperature_c",
         number("temperature_c", 20.0, [](Reading& r, double v) { r.temperature_c = v; })},
        {"load_kg", number("load_kg", 0.0, [](Reading& r, double v) { r.load_kg = v; })},
        {"clamped", store_clamped},
        {"extension_mm",
         number("extension_mm", 0.0, [](Reading& r, double v) { r.extension_mm = v; })},
        {"sigma_mm", optional_number("sigma_mm", &Reading::sigma_mm)},
    };
    return columns;
}

std::string axis_column(Axis axis) {
    const char lower = static_cast<char>(letter_of(axis) + ('a' - 'A'));
    return std::string(1, lower) + (is_rotary(axis) ? "_deg" : "_mm");
}

Store axis_store(Axis axis) {
    return [axis](Reading& row, const Line& line, const Cell& cell) {
        const double value = number_of(line, cell, "axis position");
        row.commanded[axis] = is_rotary(axis) ? rad_from_deg(value) : value;
    };
}

std::optional<Axis> axis_of_column(std::string_view name) {
    for (const Axis axis : all_axes)
        if (axis_column(axis) == name) return axis;
    return std::nullopt;
}

/// What each column of the file stores; unknown ones store nothing and are noted.
std::vector<Store> read_header(const Line& line, ReadingTable& table,
                               std::vector<std::string>& notes) {
    std::vector<Store> stores;
    std::map<std::string_view, int> seen;
    for (const Cell& cell : split(line)) {
        if (++seen[cell.text] > 1)
            line.fail("column '" + std::string(cell.text) + "' stands twice", cell.column);
        const auto fixed = fixed_columns().find(cell.text);
        const auto extra = optional_columns().find(cell.text);
        Store store;
        if (fixed != fixed_columns().end()) {
            store = fixed->second;
        } else if (extra != optional_columns().end()) {
            store = extra->second;
            table.optional_columns.emplace_back(cell.text);
        } else if (const auto axis = axis_of_column(cell.text)) {
            store = axis_store(*axis);
            table.axes.push_back(*axis);
        } else {
            notes.push_back(line.path + ": column '" + std::string(cell.text) +
                            "' is not known and ignored");
        }
        stores.push_back(std::move(store));
    }
    for (const char* name : {"index", "time_s", "test", "device", "feature", "value_mm"})
        if (!seen.contains(name)) line.fail(std::string("column '") + name + "' is missing", 1);
    if (table.axes.empty()) line.fail("no axis column (x_mm, y_mm, ..., c_deg)", 1);
    return stores;
}

void read_comment(std::string_view text, ReadingTable& table) {
    const auto equal = text.find('=');
    if (equal == std::string_view::npos) return;
    table.comment[std::string(trimmed(text.substr(1, equal - 1)))] =
        trimmed(text.substr(equal + 1));
}

void check_direction(const Line& line, const Reading& row) {
    if (row.device != Device::sphere && row.device != Device::touch) return;
    if (std::abs(row.direction_M.norm() - 1.0) > 1e-3)
        line.fail("dir_x, dir_y, dir_z of a " + std::string(name_of(row.device)) +
                      " row are a unit vector",
                  1);
}

void check_time(const Line& line, const Cell& cell, const Reading& before, const Reading& row) {
    if (row.time_s < before.time_s) line.fail("time_s runs backwards", cell.column);
    if (row.time_s == before.time_s && row.commanded != before.commanded)
        line.fail("same time_s as the row before, but other axis positions", cell.column);
}

Reading read_row(const Line& line, const std::vector<Store>& stores,
                 const std::vector<Cell>& cells) {
    if (cells.size() != stores.size())
        line.fail("row has " + std::to_string(cells.size()) + " cells, the header " +
                      std::to_string(stores.size()),
                  cells.size() < stores.size() ? static_cast<int>(line.text.size()) + 1
                                               : cells[stores.size()].column);
    Reading row;
    row.line = line.number;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (stores[i]) stores[i](row, line, cells[i]);
    check_direction(line, row);
    if (row.sigma_mm && *row.sigma_mm < 0.0) line.fail("sigma_mm is not below zero", 1);
    return row;
}

std::string_view next_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
}

}  // namespace

std::string_view name_of(Device device) {
    return device_names[static_cast<std::size_t>(device)];
}
std::string_view name_of(PositioningMode mode) {
    return mode_names[static_cast<std::size_t>(mode)];
}

ReadingTable parse_readings(std::string_view text, const std::string& path,
                            std::vector<std::string>& notes) {
    ReadingTable table;
    table.path = path;
    std::vector<Store> stores;
    std::size_t time_cell = 0;
    Line line{{}, 0, path};
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty()) {
        line.text = next_line(text);
        ++line.number;
        if (trimmed(line.text).empty()) continue;
        if (line.text[0] == '#') {
            read_comment(line.text, table);
            continue;
        }
        const std::vector<Cell> cells = split(line);
        if (stores.empty()) {
            stores = read_header(line, table, notes);
            while (cells[time_cell].text != "time_s") ++time_cell;
            continue;
        }
        Reading row = read_row(line, stores, cells);
        if (!table.rows.empty()) check_time(line, cells[time_cell], table.rows.back(), row);
        table.rows.push_back(std::move(row));
    }
    if (stores.empty())
        throw InputError("no header line: this is not a table of readings", {path, 1, 1});
    if (table.rows.empty()) throw InputError("the table has no rows", {path, line.number, 1});
    return table;
}

namespace {

std::string optional_text(const Reading& row, std::string_view column) {
    if (column == "mode") return std::string(name_of(row.mode));
    if (column == "feed_mm_min") return shortest(row.feed_mm_min);
    if (column == "spindle_deg") return shortest_degrees(row.spindle_rad);
    if (column == "temperature_c") return shortest(row.temperature_c);
    if (column == "load_kg") return shortest(row.load_kg);
    if (column == "clamped") return row.clamped ? "1" : "0";
    if (column == "extension_mm") return shortest(row.extension_mm);
    return row.sigma_mm ? shortest(*row.sigma_mm) : "";
}

std::string quoted(const std::string& text) {
    return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

void append_row(const ReadingTable& table, const Reading& row, bool directions, std::string& out) {
    out += std::to_string(row.index) + ',' + shortest(row.time_s) + ',' + quoted(row.test) + ',';
    out += std::string(name_of(row.device)) + ',' + quoted(row.feature);
    for (const Axis axis : table.axes) {
        const double q = row.commanded[axis];
        out += ',' + (is_rotary(axis) ? shortest_degrees(q) : shortest(q));
    }
    if (directions) {
        const bool directed = row.device == Device::sphere || row.device == Device::touch;
        for (const double v : row.direction_M) out += ',' + (directed ? shortest(v) : "");
    }
    for (const std::string& column : table.optional_columns)
        out += ',' + optional_text(row, column);
    out += ',' + (row.value_mm ? shortest(*row.value_mm) : "") + '\n';
}

}  // namespace

std::string format_readings(const ReadingTable& table) {
    std::string out;
    for (const auto& [key, value] : table.comment) out += "# " + key + " = " + value + '\n';
    bool directions = false;
    for (const Reading& row : table.rows)
        directions |= row.device == Device::sphere || row.device == Device::touch;
    out += "index,time_s,test,device,feature";
    for (const Axis axis : table.axes) out += ',' + axis_column(axis);
    if (directions) out += ",dir_x,dir_y,dir_z";
    for (const std::string& column : table.optional_columns) out += ',' + column;
    out += ",value_mm\n";
    for (const Reading& row : table.rows) append_row(table, row, directions, out);
    return out;
}

}  // namespace trunnion
