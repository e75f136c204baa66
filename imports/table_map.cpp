// Any CSV file, with a map (TOML) that assigns its columns.
#include <fmt/format.h>

#include <algorithm>

#include "base/alarm.h"
#include "base/numbers.h"
#include "base/toml_reader.h"
#include "base/units.h"
#include "imports/missing_values.h"
#include "imports/row_writer.h"
#include "imports/time_column.h"
#include "records/reading_columns.h"

namespace trunnion::imports {
namespace {

/// One key of the map: a constant text or number, or a column (minus another one).
struct MappedColumn {
    std::string name;  ///< of the readings column
    records::StoreCell store;
    std::string constant;
    std::optional<NumberColumn> column, minus;
    std::optional<std::size_t> text_column, time_column;
    double factor = 1.0;    ///< from the column to the unit of the readings column
    bool optional = false;  ///< a condition: a cell may be empty
};

using Sources = std::vector<MappedColumn>;

struct Map {
    Sources common;
    std::vector<Sources> readings;  ///< generated rows of each line
    std::vector<std::string> columns;
    bool directions = false;
};

/// Quantity and unit of a readings column.
struct Told {
    std::optional<Quantity> quantity;  ///< empty: a text
    double per_inside = 1.0;           ///< from mm, rad, s to the unit of the column
};

Told told_in(const std::string& name) {
    const double deg = deg_from_rad(1.0);
    if (name == "feed_mm_min") return {Quantity::speed, 60.0};
    if (name.ends_with("_mm_s")) return {Quantity::speed, 1.0};
    if (name.ends_with("_deg_s")) return {Quantity::turning, deg};
    if (name.ends_with("_s2")) return {Quantity::per_s2, 1.0};
    if (name == "time_s") return {Quantity::time, 1.0};
    if (name.ends_with("_mm")) return {Quantity::length, 1.0};
    if (name.ends_with("_deg")) return {Quantity::angle, deg};
    if (name == "temperature_c") return {Quantity::temperature, 1.0};
    if (name.starts_with("dir_") || name == "load_kg" || name == "clamped" || name == "index")
        return {Quantity::temperature, 1.0};  // a number without a unit
    return {};
}

class MapReader {
  public:
    MapReader(const TomlFile& file, const TextTable& table, const setup::Setup& setup)
        : file_(file), table_(table), setup_(setup), names_(setup.machine.chain.names()) {}

    Map read() const {
        Map map;
        const TomlValue& root = file_.root();
        if (const TomlValue* common = root.find("columns"))
            map.common = sources(file_.table(*common), map);
        const TomlValue* list = root.find("reading");
        if (!list || list->kind != TomlValue::Kind::array)
            file_.fail(root, "the map has no [[reading]]: the rows that each line gives");
        for (const TomlValue& item : list->items)
            map.readings.push_back(sources(file_.table(item), map));
        return map;
    }

  private:
    Sources sources(const TomlValue& table, Map& map) const {
        Sources list;
        for (const auto& [key, value] : table.entries) {
            value.used = true;
            list.push_back(source(key, value));
            const records::ReadingColumn* column = records::find_reading_column(key);
            if (column && column->optional && key != "session" && key != "source" &&
                std::find(map.columns.begin(), map.columns.end(), key) == map.columns.end())
                map.columns.push_back(key);
            map.directions |= key.starts_with("dir_");
        }
        return list;
    }

    MappedColumn source(const std::string& key, const TomlValue& value) const {
        MappedColumn result;
        result.name = key;
        if (const records::ReadingColumn* column = records::find_reading_column(key)) {
            result.store = column->store;
            result.optional = column->optional && !key.starts_with("value_");
        } else if (const auto axis = names_.find_column(key)) {
            result.store = records::axis_store(*axis, names_.is_rotary(*axis));
        } else if (AxisNames().find_column(key)) {
            file_.fail(value, "the machine of " + setup_.path + " has no axis for " + key);
        } else {
            file_.fail(value, "readings have no column '" + key + "'");
        }
        const Told told = told_in(key);
        if (told.quantity)
            read_number(value, told, result);
        else
            read_text(value, result);
        return result;
    }

    void read_text(const TomlValue& value, MappedColumn& result) const {
        if (value.kind == TomlValue::Kind::table)
            result.text_column = column(*required(value, "column"));
        else
            result.constant = file_.text(value);
    }

    void read_number(const TomlValue& value, const Told& told, MappedColumn& result) const {
        if (value.kind == TomlValue::Kind::number) {
            result.constant = shortest(file_.number(value));
            return;
        }
        const bool whole = value.kind == TomlValue::Kind::table;
        const TomlValue& name = whole ? *required(value, "column") : value;
        std::string unit;
        if (const TomlValue* said = whole ? value.find("unit") : nullptr) unit = file_.text(*said);
        if (told.quantity == Quantity::time && unit.empty()) {
            result.time_column = column(name);
            return;
        }
        result.column = number(column(name), told, unit);
        const double sign = whole ? file_.find_number(value, "factor").value_or(1.0).value() : 1.0;
        result.factor = sign * told.per_inside;
        if (const TomlValue* minus = whole ? value.find("minus") : nullptr)
            result.minus = number(column(*minus), told, unit);
    }

    NumberColumn number(std::size_t index, const Told& told, const std::string& unit) const {
        if (*told.quantity == Quantity::temperature) return {index, 1.0};
        if (unit.empty()) return number_column(table_, index, *told.quantity, "");
        const auto found = find_unit(unit);
        if (!found || found->quantity != *told.quantity)
            table_.header_line().fail("'" + unit + "' is no unit for this column",
                                      table_.columns()[index].column);
        return {index, found->factor};
    }

    const TomlValue* required(const TomlValue& table, const char* key) const {
        const TomlValue* value = table.find(key);
        if (!value) file_.fail(table, std::string("'") + key + "' is missing here");
        return value;
    }

    std::size_t column(const TomlValue& name) const {
        for (std::size_t k = 0; k < table_.columns().size(); ++k)
            if (table_.columns()[k].name == file_.text(name)) return k;
        file_.fail(name, table_.path() + " has no column '" + name.text + "'");
    }

    const TomlFile& file_;
    const TextTable& table_;
    const setup::Setup& setup_;
    AxisNames names_;
};

/// Converts the values of one line into a row.
class LineReader {
  public:
    LineReader(const TextTable& table, const TimeColumn& time) : table_(table), time_(time) {}

    void next(std::size_t i) {
        row_ = i;
        table_.read(i, cells_);
    }
    void fill(const Sources& sources, records::Reading& reading) const {
        for (const MappedColumn& source : sources) fill(source, reading);
    }
    /// False where a value of a column is missing: empty, "-", "n.a.".
    bool has_all(const Sources& sources) const {
        return std::all_of(sources.begin(), sources.end(), [&](const MappedColumn& source) {
            const auto missing = [&](const std::optional<NumberColumn>& column) {
                return column && is_missing(cells_[column->index].text);
            };
            return source.time_column || source.optional ||
                   !(missing(source.column) || missing(source.minus));
        });
    }
    double time_s() const { return time_.time_s(table_, row_, cells_); }

  private:
    void fill(const MappedColumn& source, records::Reading& reading) const {
        if (source.time_column) return;  // read by TimeColumn, which also reads dates
        records::TableLine line = table_.line(row_);
        records::TableCell cell{source.constant, 1, false};
        std::string text;
        if (source.text_column) {
            cell = cells_[*source.text_column];
        } else if (source.column) {
            cell.column = cells_[source.column->index].column;
            const auto& minus = source.minus ? source.minus : source.column;
            const bool missing = is_missing(cells_[source.column->index].text) ||
                                 is_missing(cells_[minus->index].text);
            if (!missing) text = shortest(value(source));
            cell.text = text;
        }
        source.store(reading, line, cell);
    }
    double value(const MappedColumn& source) const {
        double v = number_in(table_, row_, cells_, *source.column);
        if (source.minus) v -= number_in(table_, row_, cells_, *source.minus);
        return v * source.factor;
    }

    const TextTable& table_;
    const TimeColumn& time_;
    std::size_t row_ = 0;
    std::vector<records::TableCell> cells_;
};

/// Checks the generated rows here, because a map may produce invalid readings; otherwise the next
/// command would fail.
void check_rows(const std::string& readings, const std::string& map_path, const AxisNames& names) {
    std::vector<std::string> notes;
    try {
        records::parse_readings(readings, map_path, notes, names);
    } catch (const InputError& error) {
        throw InputError("this map does not give valid readings: " + error.message, {map_path},
                         error.line_text);
    }
}

std::optional<std::size_t> time_column_of(const Map& map) {
    for (const MappedColumn& source : map.common)
        if (source.time_column) return source.time_column;
    return std::nullopt;
}

}  // namespace

namespace {

/// Rows of the lines of a table. A reading whose value is missing is left out; a line of which none
/// is left gives a row without a device, because its axes moved there.
class MappedRows {
  public:
    MappedRows(const Map& map, const TextTable& table, const records::Reading& first)
        : map_(map), table_(table), first_(first) {}

    void add(std::size_t i, const LineReader& line, RowWriter& rows) {
        const int number = table_.line(i).number;
        if (!line.has_all(map_.common)) {
            for (const Sources& sources : map_.readings) missing(number, sources);
            return;
        }
        records::Reading common = first_;
        line.fill(map_.common, common);
        common.time_s = line.time_s();
        bool moved = false;
        for (const Sources& sources : map_.readings) {
            if (!line.has_all(sources)) {
                missing(number, sources);
                continue;
            }
            records::Reading row = common;
            line.fill(sources, row);
            rows.add(std::move(row), number);
            ++count_;
            moved = true;
        }
        if (moved) return;
        common.device = records::Device::none;
        rows.add(std::move(common), number);
    }

    std::size_t count() const { return count_; }
    void note(std::vector<std::string>& notes) const { missing_.note(table_.path(), notes); }

  private:
    void missing(int line, const Sources& sources) {
        const auto value = std::find_if(sources.begin(), sources.end(), [](const auto& source) {
            return source.column && source.name.starts_with("value_");
        });
        missing_.add(line, value == sources.end() ? std::string()
                                                  : table_.columns()[value->column->index].name);
    }

    const Map& map_;
    const TextTable& table_;
    records::Reading first_;
    MissingValues missing_;
    std::size_t count_ = 0;
};

}  // namespace

Imported import_table(const ImportRequest& request) {
    if (request.map.path.empty())
        throw InputError("import table requires --map MAP.toml, which assigns the columns");
    const TomlFile map_file(request.map.text, request.map.path);
    Imported result;
    std::optional<RowWriter> rows;
    for (const TextTable& table : tables_of(request, result.notes)) {
        const Facts facts = request.facts.with_head_of(table, result.notes);
        const Map map = MapReader(map_file, table, request.setup).read();
        if (!rows) rows.emplace(request.setup, "table", map.columns, true, true);
        const TimeColumn time(table, facts, time_column_of(map));
        time.note_unit(table, result.notes);
        LineReader line(table, time);
        rows->begin_file(table, facts);
        if (time.dated()) rows->name_days();
        if (time.invented()) rows->invent_times();
        records::Reading first;
        first.commanded = positions_told(request.setup, facts.text("at"));
        first.test = facts.text("test", "table");
        MappedRows mapped(map, table, first);
        for (std::size_t i = 0; i < table.size(); ++i) {
            line.next(i);
            mapped.add(i, line, *rows);
        }
        result.summary.push_back(fmt::format("{}: {} lines, {} readings, {}; {}", table.path(),
                                             table.size(), mapped.count(), time.words(),
                                             table.dialect_words()));
        mapped.note(result.notes);
    }
    for (std::string& note : map_file.unknown_keys()) result.notes.push_back(std::move(note));
    result.readings = rows->take();
    check_rows(result.readings, request.map.path, request.setup.machine.chain.names());
    return result;
}

}  // namespace trunnion::imports
