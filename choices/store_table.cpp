#include "choices/store_table.h"

#include <algorithm>
#include <cmath>

#include "base/alarm.h"
#include "controller/settings.h"
#include "emulator/run.h"
#include "offsets/axis_numbers.h"
#include "offsets/pivot_parameters.h"

namespace trunnion::choices {

namespace {

using setup::Setup;

const char* unit_of(Axis axis) {
    return is_rotary(axis) ? "deg" : "mm";
}

std::vector<Axis> axes_of(const Setup& setup) {
    std::vector<Axis> out;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        if (is_letter(axis)) out.push_back(axis.axis);
    return out;
}

/// One number for each axis of an offset vector.
Store vector_store(const std::string& name, const std::string& what, const std::vector<Axis>& axes,
                   const std::function<offsets::OffsetVector&(Setup&)>& in) {
    Store out{name, what, {}};
    for (const Axis axis : axes)
        out.numbers.push_back({name + '.' + letter_of(axis), unit_of(axis),
                               [in, axis](Setup& s) -> double& { return in(s)[axis]; }});
    return out;
}

void add_work_offsets(const Setup& setup, const std::vector<Axis>& axes, const ProgramStores& used,
                      std::vector<Store>& out) {
    for (std::size_t k = 0; k < setup.stores.work.standard.size(); ++k) {
        const std::string name = "G" + std::to_string(54 + k);
        out.push_back(vector_store(
            name, "work offset " + name,
            axes, [k](Setup & s) -> auto& { return s.stores.work.standard[k]; }));
    }
    for (std::size_t k = 0; k < setup.stores.work.additional.size(); ++k) {
        const bool empty = setup.stores.work.additional[k] == offsets::OffsetVector{};
        if (empty && !used.additional.contains(static_cast<int>(k) + 1)) continue;
        const std::string name = "G54.1P" + std::to_string(k + 1);
        out.push_back(vector_store(
            name, "work offset " + name,
            axes, [k](Setup & s) -> auto& { return s.stores.work.additional[k]; }));
    }
    out.push_back(vector_store(
        "external", "external work offset", axes,
        [](Setup & s) -> auto& { return s.stores.work.external; }));
}

/// Of the numbers that the program calls: the offset along the linear axes, and the angles of the
/// rotary ones at which it was measured.
void add_fixture_offsets(const Setup& setup, const std::vector<Axis>& axes,
                         const ProgramStores& used, std::vector<Store>& out) {
    for (std::size_t k = 0; k < setup.stores.fixture.set.size(); ++k) {
        if (!used.fixture.contains(static_cast<int>(k) + 1)) continue;
        const std::string name = "G54.2P" + std::to_string(k + 1);
        out.push_back(vector_store(
            name, "fixture offset " + name,
            axes, [k](Setup & s) -> auto& { return s.stores.fixture.set[k].offset; }));
        for (std::size_t n = 0; n < axes.size(); ++n)
            if (const Axis axis = axes[n]; is_rotary(axis))
                out.back().numbers[n].in = [k, axis](Setup& s) -> double& {
                    return s.stores.fixture.set[k].reference_angles[axis];
                };
    }
}

/// Along the linear axes: each number costs a run, and such shifts are set for a part.
void add_left_shifts(const std::vector<Axis>& axes, const ProgramStores& used,
                     std::vector<Store>& out) {
    std::vector<Axis> linear = axes;
    std::erase_if(linear, is_rotary);
    if (used.left_local)
        out.push_back(vector_store(
            "G52", "G52 left in force before the program", linear,
            [](Setup & s) -> auto& { return s.stores.work.local; }));
    if (used.left_preset)
        out.push_back(vector_store(
            "G92", "G92 left in force before the program", linear,
            [](Setup & s) -> auto& { return s.stores.work.preset; }));
}

/// Before the offsets: a program that puts a variable into an offset shows it as the variable. One
/// store: what an earlier program left there, it left in all.
void add_variables(const ProgramStores& used, std::vector<Store>& out) {
    if (used.variables.empty()) return;
    Store store{"common variables", "values of common variables before the program", {}};
    for (const int number : used.variables) {
        StoredNumber entry{'#' + std::to_string(number), "",
                           [number](Setup& s) -> double& { return s.stores.variables[number]; }};
        entry.variable = number;
        store.numbers.push_back(std::move(entry));
    }
    out.push_back(std::move(store));
}

Store tool_store(std::size_t number, bool length) {
    const std::string name = 'H' + std::to_string(number);
    if (length)
        return {name,
                "length of offset " + std::to_string(number),
                {{name, "mm", [number](Setup& s) -> double& {
                      return s.stores.tools.tool[number].length_geometry_mm;
                  }}}};
    const std::string radius = 'D' + std::to_string(number);
    return {radius,
            "radius of offset " + std::to_string(number),
            {{radius, "mm", [number](Setup& s) -> double& {
                  return s.stores.tools.tool[number].radius_geometry_mm;
              }}}};
}

void add_tools(const Setup& setup, const std::set<int>& called, std::vector<Store>& out) {
    for (std::size_t n = 1; n < setup.stores.tools.tool.size(); ++n) {
        const offsets::ToolOffset& tool = setup.stores.tools.tool[n];
        const bool empty = tool.length_mm() == 0.0 && tool.radius_mm() == 0.0;
        if (empty && !called.contains(static_cast<int>(n))) continue;
        out.push_back(tool_store(n, true));
        out.push_back(tool_store(n, false));
    }
}

/// A parameter as a number; `otherwise`: value of an absent parameter.
StoredNumber parameter(int number, double otherwise) {
    return {
        std::to_string(number), "mm", [number, otherwise](Setup& s) -> double& {
            auto& entry = s.stores.parameters.entry;
            return entry.try_emplace(number, offsets::Parameter{otherwise, {}}).first->second.value;
        }};
}

StoredNumber axis_parameter(int number, Axis axis) {
    return {std::to_string(number) + '.' + letter_of(axis), unit_of(axis),
            [number, axis](Setup& s) -> double& { return axis_value(s, number, axis); }};
}

void add_axis_parameter(int number, const std::string& what, const std::vector<Axis>& axes,
                        std::vector<Store>& out) {
    Store store{std::to_string(number), what, {}};
    for (const Axis axis : axes) store.numbers.push_back(axis_parameter(number, axis));
    out.push_back(std::move(store));
}

void add_reference_positions(const std::vector<Axis>& axes, std::vector<Store>& out) {
    for (int number = 1240; number <= 1243; ++number)
        add_axis_parameter(
            number, "reference position " + std::to_string(number - 1239) + " of G28 and G30", axes,
            out);
}

void add_pivot(const Setup& setup, std::vector<Store>& out) {
    struct Row {
        const char *name, *what;
        int first, last;
    };
    constexpr Row rows[] = {
        {"19666", "distance from the tool's seat to the rotary axes of the tool", 19666, 19666},
        {"19700-19702", "place of the table's rotary axis", 19700, 19702},
        {"19703-19705", "second rotary axis of the table against the first", 19703, 19705},
        {"19709-19711", "rotary axis of the tool against the spindle", 19709, 19711},
        {"19712-19714", "second rotary axis of the tool against the first", 19712, 19714}};
    for (const Row& row : rows) {
        Store store{row.name, row.what, {}};
        for (int n = row.first; n <= row.last; ++n)
            if (setup.stores.parameters.find(n)) store.numbers.push_back(parameter(n, 0.0));
        if (!store.numbers.empty()) out.push_back(std::move(store));
    }
}

/// The two rotary axes of a table as the control believes them; empty for any other machine.
std::optional<offsets::PivotParameters> table_pivot(const Setup& setup,
                                                    const std::vector<Axis>& axes) {
    try {
        const auto pivot = offsets::decode_pivot(setup.stores.parameters, axes);
        const bool is_table = pivot && pivot->unit == offsets::MechanicalUnit::table_table;
        return is_table ? pivot : std::nullopt;
    } catch (const Alarm&) {  // a program that needs them has this alarm, others run
        return std::nullopt;
    }
}

/// The coordinates across the line of an axis. All of a line are set when one is written, because
/// a line lacking one is refused.
void add_centreline(const offsets::PivotAxis& axis, const Vector3& point_mm, Store& store) {
    std::vector<std::size_t> across;
    for (std::size_t k = 0; k < 3; ++k)
        if (std::abs(axis.line[static_cast<Eigen::Index>(k)]) <= 1.0 - 1e-9) across.push_back(k);
    for (const std::size_t k : across)
        store.numbers.push_back({std::string("centreline.") + letter_of(axis.axis) + '.' + "XYZ"[k],
                                 "mm",
                                 [across, k, point_mm, letter = axis.axis](Setup& s) -> double& {
                                     setup::Centreline& line = s.centrelines[letter];
                                     for (const std::size_t i : across)
                                         if (!line[i])
                                             line[i] = point_mm[static_cast<Eigen::Index>(i)];
                                     return *line[k];
                                 }});
}

/// One store: a place of the first axis is also the second one's reference.
void add_centrelines(const offsets::PivotParameters& pivot, std::vector<Store>& out) {
    Store store{"hurco.centreline", "centrelines of the part set-up", {}};
    add_centreline(pivot.first, pivot.table_point_mm, store);
    add_centreline(pivot.second, pivot.table_point_mm + pivot.table_offset_mm, store);
    out.push_back(std::move(store));
}

/// End of the stroke of Z, where M25 goes without a height of its own; empty: no limit.
std::optional<double> top_of_z(const Setup& setup) {
    std::vector<controller::ControlAxis> axes = emulator::control_config(setup).axes;
    controller::sort_axes(axes, setup.stores.parameters);
    controller::take_strokes(axes, setup.stores.parameters);
    const auto z = std::find_if(axes.begin(), axes.end(),
                                [](const auto& axis) { return axis.axis == Axis::Z; });
    return z == axes.end() ? std::nullopt : z->max;
}

void add_tool_change(const Setup& setup, std::vector<Store>& out) {
    const auto& given = setup.hurco.tool_change_z_mm;
    const std::optional<double> height = given ? given : top_of_z(setup);
    if (!height) return;
    const std::string name = "hurco.tool_change_z_mm";
    out.push_back({name, "height of M25", {{name, "mm", [height](Setup& s) -> double& {
                                                auto& own = s.hurco.tool_change_z_mm;
                                                return own ? *own : own.emplace(*height);
                                            }}}});
}

}  // namespace

bool is_hurco(const Setup& setup) {
    return setup.dialect.family == interpreter::DialectFamily::hurco;
}

double& axis_value(Setup& setup, int parameter, Axis axis) {
    offsets::Parameters& all = setup.stores.parameters;
    const std::vector<Axis> axes = axes_of(setup);
    offsets::Parameter& p = all.entry[parameter];
    if (p.by_axis.empty() && p.value != 0.0)  // one value for all axes
        for (const Axis other : axes)
            p.by_axis[offsets::number_of_named_axis(all, other, axes)] = p.value;
    return p.by_axis[offsets::number_of_named_axis(all, axis, axes)];
}

bool is_vacant(const Setup& setup, const StoredNumber& number) {
    return number.variable != 0 && !setup.stores.variables.contains(number.variable);
}

std::vector<Store> store_table(const Setup& setup, const ProgramStores& used) {
    const std::vector<Axis> axes = axes_of(setup);
    std::vector<Store> out;
    add_variables(used, out);
    add_work_offsets(setup, axes, used, out);
    add_fixture_offsets(setup, axes, used, out);
    add_left_shifts(axes, used, out);
    add_tools(setup, used.offsets, out);
    const auto pivot = is_hurco(setup) ? table_pivot(setup, axes) : std::nullopt;
    if (pivot)
        add_centrelines(*pivot, out);
    else
        add_pivot(setup, out);
    if (is_hurco(setup)) add_tool_change(setup, out);
    add_reference_positions(axes, out);
    out.push_back({"5114", "retreat of G73", {parameter(5114, 1.0)}});
    out.back().numbers.front().least = 0.0;
    out.push_back({"5115", "clearance of G83", {parameter(5115, 1.0)}});
    out.back().numbers.front().least = 0.0;
    out.push_back({"5410", "angle of G68 without R", {parameter(5410, 0.0)}});
    out.back().numbers.front().unit = "deg";
    add_axis_parameter(5440, "overrun of G60", axes, out);
    return out;
}

}  // namespace trunnion::choices
