#include "records/readings.h"

#include <algorithm>
#include <cmath>

#include "base/alarm.h"
#include "base/utf8_text.h"
#include "records/reading_columns.h"
#include "records/table_line.h"

namespace trunnion::records {
namespace {

using Cells = std::vector<TableCell>;

/// Storage function of each column of the file; unknown columns are ignored.
struct Header {
    std::vector<StoreCell> stores;
    std::size_t time_cell = 0;
    char separator = ',';
};

StoreCell store_of(const TableLine& line, const TableCell& cell, ReadingTable& table) {
    if (const ReadingColumn* column = find_reading_column(cell.text)) {
        if (column->optional) table.optional_columns.emplace_back(cell.text);
        return column->store;
    }
    if (const auto axis = axis_of_column(line, cell, table.names)) {
        table.axes.push_back(*axis);
        return axis_store(*axis, table.names.is_rotary(*axis));
    }
    return {};
}

bool stands(const Cells& cells, std::string_view name) {
    return std::any_of(cells.begin(), cells.end(), [&](auto& cell) { return cell.text == name; });
}

void check_header(const TableLine& line, const Cells& cells, const ReadingTable& table) {
    if (std::none_of(cells.begin(), cells.end(),
                     [](const TableCell& cell) { return find_reading_column(cell.text); }))
        line.fail("no header line: this is not a table of readings (trunnion import makes one)", 1);
    for (std::size_t i = 0; i < cells.size(); ++i)
        for (std::size_t k = 0; k < i; ++k)
            if (cells[i].text == cells[k].text)
                line.fail("column '" + std::string(cells[i].text) + "' stands twice",
                          cells[i].column);
    for (const char* name : {"index", "time_s", "test", "device", "feature"})
        if (!stands(cells, name)) line.fail(std::string("column '") + name + "' is missing", 1);
    if (!stands(cells, "value_mm") && !stands(cells, "value_deg"))
        line.fail("column 'value_mm' (or 'value_deg') is missing", 1);
    if ((stands(cells, "px_mm") + stands(cells, "py_mm") + stands(cells, "pz_mm")) % 3 != 0)
        line.fail("px_mm, py_mm and pz_mm stand together", 1);
    if (table.axes.empty()) line.fail("no axis column (x_mm, y_mm, ..., c_deg)", 1);
}

Header read_header(const TableLine& line, const Cells& cells, ReadingTable& table,
                   std::vector<std::string>& notes) {
    Header header;
    for (const TableCell& cell : cells) {
        if (cell.text == "time_s") header.time_cell = header.stores.size();
        header.stores.push_back(store_of(line, cell, table));
        if (!header.stores.back())
            notes.push_back(table.path + ": column '" + std::string(cell.text) +
                            "' is not known and ignored");
    }
    check_header(line, cells, table);
    return header;
}

void read_comment(std::string_view text, ReadingTable& table) {
    const auto equal = text.find('=');
    if (equal == std::string_view::npos) return;
    text = text.substr(0, text.find_last_not_of(",; \t") + 1);  // empty cells of a spreadsheet
    table.comment[std::string(without_blanks(text.substr(1, equal - 1)))] =
        without_blanks(text.substr(std::min(equal + 1, text.size())));
}

void check_schema(const TableLine& line, const ReadingTable& table) {
    const auto schema = table.comment.find("schema");
    if (schema != table.comment.end() && schema->second != "trunnion.readings/1")
        line.fail("this version reads schema trunnion.readings/1", 1);
}

/// Parses "X+ Y+ C-"; `line` is the head line.
AxisSides read_sides(const TableLine& line, const ReadingTable& table) {
    AxisSides sides{};
    const auto column = [&](std::string_view at) {
        return static_cast<int>(at.data() - line.text.data()) + 1;
    };
    std::string_view left = line.text.substr(line.text.find('=') + 1);
    while (!(left = without_blanks(left)).empty()) {
        const std::string_view word = left.substr(0, left.find_first_of(" \t,"));
        left.remove_prefix(std::min(word.size() + 1, left.size()));
        if (word.empty()) continue;
        if (word.back() != '+' && word.back() != '-')
            line.fail("side reads X+ Y- ..., one word an axis", column(word));
        const auto axis = table.names.find(word.substr(0, word.size() - 1));
        if (!axis) line.fail("side of an axis that the machine does not have", column(word));
        if (std::find(table.axes.begin(), table.axes.end(), *axis) == table.axes.end())
            line.fail("side of an axis that has no column", column(word));
        if (sides[index_of(*axis)] != 0) line.fail("side of this axis stands twice", column(word));
        sides[index_of(*axis)] = word.back() == '+' ? 1 : -1;
    }
    return sides;
}

void check_time(const TableLine& line, const TableCell& cell, const Reading& before,
                const Reading& row) {
    if (row.time_s < before.time_s) line.fail("time_s runs backwards", cell.column);
    if (row.time_s == before.time_s && row.commanded != before.commanded)
        line.fail("same time_s as the row before, but other axis positions", cell.column);
}

/// The axis of a servo row.
Axis servo_axis(const TableLine& line, const Reading& row, const ReadingTable& table) {
    for (const Axis axis : table.axes)
        if (row.feature == table.names[axis]) return axis;
    line.fail("feature of an axis row is an axis of this table, not '" + row.feature + "'", 1);
}

/// A row is in degrees if and only if its device reads an angle.
void check_unit(const TableLine& line, Reading& row, const ReadingTable& table) {
    const bool angular =
        row.device == Device::angle ||
        (row.device == Device::axis && table.names.is_rotary(servo_axis(line, row, table)));
    if (angular != row.angular && (row.value_mm || row.sigma_mm || row.velocity_mm_s))
        line.fail(std::string(name_of(row.device)) + " row of " + row.feature +
                      (angular ? " is read in degrees (value_deg)" : " is read in mm (value_mm)"),
                  1);
    row.angular = angular;
}

void check_row(const TableLine& line, Reading& row, const ReadingTable& table) {
    if (has_direction(row.device) && std::abs(row.direction_M.norm() - 1.0) > 1e-3)
        line.fail("dir_x, dir_y, dir_z of a " + std::string(name_of(row.device)) +
                      " row are a unit vector",
                  1);
    if (row.sigma_mm && *row.sigma_mm < 0.0)
        line.fail(
            row.angular ? "sigma_deg must not be below zero" : "sigma_mm must not be below zero",
            1);
    check_unit(line, row, table);
}

Reading read_row(const TableLine& line, const Cells& cells, const Header& header,
                 const ReadingTable& table) {
    const auto& stores = header.stores;
    if (cells.size() != stores.size())
        line.fail("row has " + std::to_string(cells.size()) + " cells, the header " +
                      std::to_string(stores.size()),
                  cells.size() < stores.size() ? static_cast<int>(line.text.size()) + 1
                                               : cells[stores.size()].column);
    Reading row;
    row.line = line.number;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (stores[i]) stores[i](row, line, cells[i]);
    check_row(line, row, table);
    if (!table.rows.empty()) check_time(line, cells[header.time_cell], table.rows.back(), row);
    return row;
}

}  // namespace

ReadingTable parse_readings(std::string_view text, const std::string& path,
                            std::vector<std::string>& notes, const AxisNames& names) {
    ReadingTable table;
    table.path = path;
    table.names = names;
    Header header;
    Cells cells;
    TableLine line{{}, 0, path}, side;
    const std::string converted = is_utf16(text) ? utf8_of(std::string(text), path) : "";
    if (is_utf16(text)) text = converted;
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    while (!text.empty()) {
        line.text = take_line(text);
        ++line.number;
        if (without_blanks(line.text).empty()) continue;
        if (line.text[0] == '#') {
            read_comment(line.text, table);
            if (table.comment.erase("side") > 0) side = line;
            check_schema(line, table);
            continue;
        }
        if (header.stores.empty()) {
            const char separator = separator_of(line.text);
            line.split(separator, cells);
            header = read_header(line, cells, table, notes);
            header.separator = separator;
            continue;
        }
        line.split(header.separator, cells);
        table.rows.push_back(read_row(line, cells, header, table));
    }
    if (header.stores.empty())
        throw InputError("no header line: this is not a table of readings", {path, 1, 1});
    if (table.rows.empty()) throw InputError("the table has no rows", {path, line.number, 1});
    if (side.number > 0) table.side_before = read_sides(side, table);
    return table;
}

namespace {

/// The columns of a table without those of the axes; value_mm and value_deg are the last.
std::vector<const ReadingColumn*> written_columns(const ReadingTable& table, bool directions,
                                                  bool degrees) {
    std::vector<const ReadingColumn*> columns, values;
    for (const ReadingColumn& column : reading_columns()) {
        if (column.optional || (!directions && column.name.starts_with("dir_"))) continue;
        if (column.name == "value_deg" && !degrees) continue;
        (column.name.starts_with("value_") ? values : columns).push_back(&column);
    }
    for (const std::string& name : table.optional_columns)
        columns.push_back(find_reading_column(name));
    columns.insert(columns.end(), values.begin(), values.end());
    return columns;
}

}  // namespace

std::string format_sides(const std::vector<Axis>& axes, const AxisSides& sides,
                         const AxisNames& names) {
    std::string out;
    for (const Axis axis : axes)
        if (const int side = sides[index_of(axis)]; side != 0)
            out += (out.empty() ? "" : " ") + names[axis] + (side > 0 ? '+' : '-');
    return out;
}

struct ReadingWriter::Columns {
    std::vector<const ReadingColumn*> list;
};

ReadingWriter::ReadingWriter(const ReadingTable& head, bool directions, bool degrees)
    : head_(head),
      columns_(std::make_shared<Columns>(Columns{written_columns(head, directions, degrees)})) {}

std::string ReadingWriter::head_text() const {
    std::string out;
    for (const auto& [key, value] : head_.comment) out += "# " + key + " = " + value + '\n';
    const std::string sides = format_sides(head_.axes, head_.side_before, head_.names);
    if (!sides.empty()) out += "# side = " + sides + '\n';
    for (const ReadingColumn* column : columns_->list) {
        if (column != columns_->list.front()) out += ',';
        out += column->name;
        if (column->name == "feature")
            for (const Axis axis : head_.axes) out += ',' + head_.names.column(axis);
    }
    return out + '\n';
}

void ReadingWriter::append(const Reading& row, std::string& out) const {
    for (const ReadingColumn* column : columns_->list) {
        if (column != columns_->list.front()) out += ',';
        out += column->text(row);
        if (column->name == "feature")
            for (const Axis axis : head_.axes)
                out += ',' + axis_text(row, axis, head_.names.is_rotary(axis));
    }
    out += '\n';
}

std::string format_readings(const ReadingTable& table) {
    const auto any = [&](const auto& has) {
        return std::any_of(table.rows.begin(), table.rows.end(), has);
    };
    const ReadingWriter writer(table, any([](auto& row) { return has_direction(row.device); }),
                               any([](auto& row) { return row.angular; }));
    std::string out = writer.head_text();
    for (const Reading& row : table.rows) writer.append(row, out);
    return out;
}

bool has_times(const ReadingTable& table) {
    const auto told = table.comment.find(times_key);
    return told == table.comment.end() || told->second != invented;
}

bool only_angles(const ReadingTable& table) {
    bool any = false;
    for (const Reading& row : table.rows) {
        if (row.device == Device::none) continue;
        if (!row.angular) return false;
        any = true;
    }
    return any;
}

double micro_per_one(const ReadingTable& table) {
    return only_angles(table) ? 1e6 : 1e3;
}

}  // namespace trunnion::records
