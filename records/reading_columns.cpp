#include "records/reading_columns.h"

#include <array>
#include <cmath>

#include "base/numbers.h"
#include "base/units.h"

namespace trunnion::records {
namespace {

constexpr std::array<std::string_view, 8> device_names{"",       "sphere", "touch", "ballbar",
                                                       "linear", "angle",  "point", "axis"};
constexpr std::array<std::string_view, 5> mode_names{"", "dpp", "rtdfo", "rtcp", "tw"};

/// "a, b or c"; the empty name is shown as "empty".
template <class List>
std::string choice(const List& names) {
    std::string out;
    for (std::size_t i = 1; i < names.size(); ++i) out += std::string(names[i]) + ", ";
    return out.substr(0, out.size() - 2) + " or empty";
}

template <class List>
std::size_t find_name(const List& names, const char* what, const TableLine& line,
                      const TableCell& cell) {
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == cell.text) return i;
    line.fail(std::string(what) + " is " + choice(names), cell.column);
}

void store_index(Reading& row, const TableLine& line, const TableCell& cell) {
    const double value = line.number_of(cell, "index");
    if (std::abs(value) > 2e9 || value != static_cast<int>(value))
        line.fail("index is a whole number", cell.column);
    row.index = static_cast<int>(value);
}

void store_device(Reading& row, const TableLine& line, const TableCell& cell) {
    row.device = static_cast<Device>(find_name(device_names, "device", line, cell));
}

void store_mode(Reading& row, const TableLine& line, const TableCell& cell) {
    row.mode = static_cast<PositioningMode>(find_name(mode_names, "mode", line, cell));
}

void store_clamped(Reading& row, const TableLine& line, const TableCell& cell) {
    if (!cell.text.empty() && cell.text != "0" && cell.text != "1")
        line.fail("clamped is 0, 1 or empty", cell.column);
    row.clamped = cell.text == "1";
}

constexpr double same(double v) {
    return v;
}

using Convert = double (*)(double);
using Format = std::string (*)(Finite);

/// A number with a default value for an empty cell.
template <class Member>
ReadingColumn usual(std::string_view name, Member member, double otherwise, Convert in = same,
                    Format out = shortest) {
    return {name,
            [=](Reading& row, const TableLine& line, const TableCell& cell) {
                row.*member =
                    in(cell.text.empty() ? otherwise : line.number_of(cell, name).value());
            },
            [=](const Reading& row) { return out(row.*member); }};
}

ReadingColumn text_column(std::string_view name, std::string Reading::*member) {
    return {
        name,
        [=](Reading& row, const TableLine&, const TableCell& cell) { row.*member = cell.plain(); },
        [=](const Reading& row) { return cell_text(row.*member); }};
}

ReadingColumn direction_column(std::string_view name, Eigen::Index k) {
    return {name,
            [=](Reading& row, const TableLine& line, const TableCell& cell) {
                row.direction_M(k) = cell.text.empty() ? 0.0 : line.number_of(cell, name).value();
            },
            [=](const Reading& row) {
                return has_direction(row.device) ? shortest(row.direction_M(k)) : std::string();
            },
            false};
}

/// Programmed point; the three cells of a row are all filled or all empty.
ReadingColumn point_column(std::string_view name, Eigen::Index k) {
    return {name,
            [=](Reading& row, const TableLine& line, const TableCell& cell) {
                if (cell.text.empty() != !row.point_W_mm && k > 0)
                    line.fail("px_mm, py_mm, pz_mm are three numbers or three empty cells",
                              cell.column);
                if (cell.text.empty()) return;
                if (!row.point_W_mm) row.point_W_mm = Vector3::Zero();
                (*row.point_W_mm)(k) = line.number_of(cell, name);
            },
            [=](const Reading& row) {
                return row.point_W_mm ? shortest((*row.point_W_mm)(k)) : std::string();
            }};
}

/// A quantity with one column in mm and one in degrees; all filled cells of a row use the same one.
struct TwoUnits {
    std::string_view mm, deg;
    std::optional<double> Reading::*member;
};

bool has_quantity(const Reading& row) {
    return row.value_mm || row.sigma_mm || row.velocity_mm_s || row.acceleration_mm_s2;
}

ReadingColumn in_unit(const TwoUnits& both, bool angular) {
    const std::string_view name = angular ? both.deg : both.mm;
    return {name,
            [=](Reading& row, const TableLine& line, const TableCell& cell) {
                if (cell.text.empty()) return;
                if (has_quantity(row) && row.angular != angular)
                    line.fail("mm and degrees in one row", cell.column);
                const double value = line.number_of(cell, name);
                row.*both.member = angular ? rad_from_deg(value) : value;
                row.angular = angular;
            },
            [=](const Reading& row) {
                if (!(row.*both.member) || row.angular != angular) return std::string();
                return angular ? shortest_degrees(*(row.*both.member))
                               : shortest(*(row.*both.member));
            }};
}

ReadingColumn required(ReadingColumn column) {
    column.optional = false;
    return column;
}

std::vector<ReadingColumn> all_columns() {
    const TwoUnits value{"value_mm", "value_deg", &Reading::value_mm};
    const TwoUnits sigma{"sigma_mm", "sigma_deg", &Reading::sigma_mm};
    const TwoUnits velocity{"velocity_mm_s", "velocity_deg_s", &Reading::velocity_mm_s};
    const TwoUnits acceleration{"acceleration_mm_s2", "acceleration_deg_s2",
                                &Reading::acceleration_mm_s2};
    return {
        {"index", store_index, [](const Reading& r) { return std::to_string(r.index); }, false},
        {"time_s",
         [](Reading& r, const TableLine& line, const TableCell& c) {
             r.time_s = line.number_of(c, "time_s");
         },
         [](const Reading& r) { return shortest(r.time_s); }, false},
        required(text_column("test", &Reading::test)),
        {"device", store_device, [](const Reading& r) { return std::string(name_of(r.device)); },
         false},
        required(text_column("feature", &Reading::feature)),
        direction_column("dir_x", 0),
        direction_column("dir_y", 1),
        direction_column("dir_z", 2),
        {"mode", store_mode, [](const Reading& r) { return std::string(name_of(r.mode)); }},
        point_column("px_mm", 0),
        point_column("py_mm", 1),
        point_column("pz_mm", 2),
        usual("feed_mm_min", &Reading::feed_mm_min, 0.0),
        usual("spindle_deg", &Reading::spindle_rad, 0.0, rad_from_deg, shortest_degrees),
        usual("temperature_c", &Reading::temperature_c, 20.0),
        usual("load_kg", &Reading::load_kg, 0.0),
        {"clamped", store_clamped,
         [](const Reading& r) { return std::string(r.clamped ? "1" : "0"); }},
        usual("extension_mm", &Reading::extension_mm, 0.0),
        in_unit(velocity, false),
        in_unit(velocity, true),
        in_unit(acceleration, false),
        in_unit(acceleration, true),
        in_unit(sigma, false),
        in_unit(sigma, true),
        text_column("session", &Reading::session),
        text_column("instrument", &Reading::instrument),
        text_column("source", &Reading::source),
        required(in_unit(value, false)),
        required(in_unit(value, true)),
    };
}

}  // namespace

std::string_view name_of(Device device) {
    return device_names[static_cast<std::size_t>(device)];
}

std::string_view name_of(PositioningMode mode) {
    return mode_names[static_cast<std::size_t>(mode)];
}

bool has_direction(Device device) {
    return device == Device::sphere || device == Device::touch || device == Device::linear ||
           device == Device::angle || device == Device::point;
}

const std::vector<ReadingColumn>& reading_columns() {
    static const std::vector<ReadingColumn> columns = all_columns();
    return columns;
}

const ReadingColumn* find_reading_column(std::string_view name) {
    for (const ReadingColumn& column : reading_columns())
        if (column.name == name) return &column;
    return nullptr;
}

namespace {

/// True for a letter of ISO 841, or a letter with a number (j7), followed by _mm or _deg: meant as
/// an axis.
bool looks_like_axis(std::string_view column) {
    const std::size_t unit = column.rfind('_');
    if (unit == std::string_view::npos || unit == 0) return false;
    const std::string_view name = column.substr(0, unit), digits = name.substr(1);
    if (column.substr(unit) != "_mm" && column.substr(unit) != "_deg") return false;
    if (digits.empty()) return std::string_view("xyzabcuvw").find(name) != std::string_view::npos;
    return name[0] >= 'a' && name[0] <= 'z' &&
           digits.find_first_not_of("0123456789") == std::string_view::npos;
}

std::string list_of_columns(const AxisNames& names) {
    std::string out;
    for (const Axis axis : all_axes)
        if (names.has(axis)) out += (out.empty() ? "" : ", ") + names.column(axis);
    return out;
}

}  // namespace

std::optional<Axis> axis_of_column(const TableLine& line, const TableCell& cell,
                                   const AxisNames& names) {
    if (const auto axis = names.find_column(cell.text)) return axis;
    if (looks_like_axis(cell.text))
        line.fail("column '" + std::string(cell.text) + "': the machine's axes are " +
                      list_of_columns(names),
                  cell.column);
    return std::nullopt;
}

StoreCell axis_store(Axis axis, bool rotary) {
    return [axis, rotary](Reading& row, const TableLine& line, const TableCell& cell) {
        const double value = line.number_of(cell, "axis position");
        row.commanded[axis] = rotary ? rad_from_deg(value) : value;
    };
}

std::string axis_text(const Reading& row, Axis axis, bool rotary) {
    const double q = row.commanded[axis];
    return rotary ? shortest_degrees(q) : shortest(q);
}

}  // namespace trunnion::records
