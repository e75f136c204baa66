// [control]: dialect and stores of a setup file.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/numbers.h"
#include "offsets/parameter_units.h"
#include "setup/control_axes.h"
#include "setup/hurco_keys.h"
#include "setup/setup_reader.h"

namespace trunnion::setup {
namespace {

/// Numbers that a key may be, and what they are called.
struct KeyNumbers {
    int lowest, highest;
    const char* what;
};

int whole_number(const TomlFile& file, const std::string& key, const TomlValue& value,
                 const KeyNumbers& numbers) {
    const auto n = parse_number(key);
    if (!n || *n < numbers.lowest || *n > numbers.highest || *n != static_cast<int>(*n))
        file.fail(value, "'" + key + "' is not " + numbers.what);
    return static_cast<int>(*n);
}

offsets::OffsetVector read_offset(const TomlFile& file, const TomlValue& table) {
    offsets::OffsetVector offset;
    for (const auto& [key, value] : file.table(table).entries) {
        const auto axis = key.size() == 1 ? axis_of(key[0]) : std::nullopt;
        if (!axis) continue;  // reported as unknown
        value.used = true;
        offset[*axis] = file.number(value);
    }
    return offset;
}

offsets::OffsetVector* find_offset(offsets::WorkOffsets& work, const std::string& name) {
    if (name == "external" || name == "EXT") return &work.external;
    if (name == "G52") return &work.local;
    if (name == "G92") return &work.preset;
    if (name.size() == 3 && name.starts_with("G5") && name[2] >= '4' && name[2] <= '9')
        return &work.standard[static_cast<std::size_t>(name[2] - '4')];
    if (!name.starts_with("G54.1 P")) return nullptr;
    const auto n = parse_number(name.substr(7));
    const bool valid = n && *n >= 1 && *n <= 300 && *n == static_cast<int>(*n);
    return valid ? &work.additional[static_cast<std::size_t>(*n) - 1] : nullptr;
}

void read_work_offsets(const TomlFile& file, const TomlValue& table, offsets::WorkOffsets& work) {
    for (const auto& [key, value] : file.table(table).entries) {
        value.used = true;
        offsets::OffsetVector* offset = find_offset(work, key);
        if (!offset)
            file.fail(value, "'" + key +
                                 "' is not G54 ... G59, \"G54.1 P1\" ... P300, external, G52 or "
                                 "G92");
        *offset = read_offset(file, value);
    }
}

/// P1 = { X = .., Y = .., Z = .., reference = { B = .., C = .. } }
void read_fixtures(const TomlFile& file, const TomlValue& table, offsets::FixtureOffsets& fixture) {
    for (const auto& [key, value] : file.table(table).entries) {
        value.used = true;
        const std::string number = key.starts_with("P") ? key.substr(1) : key;
        const int n = whole_number(file, number, value, {1, 8, "P1 ... P8"});
        offsets::FixtureOffset& set = fixture.set[static_cast<std::size_t>(n) - 1];
        set.offset = read_offset(file, value);
        if (const TomlValue* angles = value.find("reference"))
            set.reference_angles = read_offset(file, *angles);
    }
}

void read_tools(const TomlFile& file, const TomlValue& table, offsets::ToolOffsets& tools) {
    for (const auto& [key, value] : file.table(table).entries) {
        value.used = true;
        const int n = whole_number(file, key, value, {1, 999, "a tool offset number"});
        offsets::ToolOffset& tool = tools.tool[static_cast<std::size_t>(n)];
        tool.length_geometry_mm = file.find_number(file.table(value), "length_mm").value_or(0.0);
        tool.length_wear_mm = file.find_number(value, "length_wear_mm").value_or(0.0);
        tool.radius_geometry_mm = file.find_number(value, "diameter_mm").value_or(0.0) / 2.0;
        tool.radius_wear_mm = file.find_number(value, "diameter_wear_mm").value_or(0.0) / 2.0;
        tool.length_given = value.find("length_mm") || value.find("length_wear_mm");
        tool.radius_given = value.find("diameter_mm") || value.find("diameter_wear_mm");
    }
}

double parameter_value(const TomlFile& file, const TomlValue& value) {
    if (value.kind != TomlValue::Kind::text) return file.number(value);
    if (value.text.size() != 8 || value.text.find_first_not_of("01") != std::string::npos)
        file.fail(value,
                  "a bit parameter is eight of 0 and 1, e.g. \"00000001\" (rightmost is bit 0)");
    double byte = 0.0;
    for (const char bit : value.text) byte = 2.0 * byte + (bit == '1' ? 1.0 : 0.0);
    return byte;
}

/// Backups number spindles from 101 and paths from 201 in the place of axes.
int axis_number(const std::string& key, const Setup& setup) {
    if (const auto n = parse_number(key)) return *n >= 1 && *n <= 999 ? static_cast<int>(*n) : 0;
    int number = 0;
    for (const kinematics::AxisGeometry& axis : control_axes(setup)) {
        ++number;
        if (key == axis.name) return number;
    }
    return 0;
}

/// A value, or one for each axis: [..] in the order of the control, { X = .., Y = .. } or { 1 = ..
/// }.
offsets::Parameter read_parameter(const TomlFile& file, const TomlValue& value,
                                  const Setup& setup) {
    offsets::Parameter parameter;
    if (value.kind == TomlValue::Kind::array) {
        for (std::size_t i = 0; i < value.items.size(); ++i)
            parameter.by_axis[static_cast<int>(i) + 1] = parameter_value(file, value.items[i]);
    } else if (value.kind == TomlValue::Kind::table) {
        for (const auto& [key, entry] : value.entries) {
            entry.used = true;
            const int axis = axis_number(key, setup);
            if (axis < 1) file.fail(entry, "'" + key + "' is not an axis of this machine");
            parameter.by_axis[axis] = parameter_value(file, entry);
        }
    } else {
        parameter.value = parameter_value(file, value);
    }
    return parameter;
}

void read_parameters(const TomlFile& file, const TomlValue& table, Setup& setup) {
    std::vector<int> read;
    for (const auto& [key, value] : file.table(table).entries) {
        value.used = true;
        const int number = whole_number(file, key, value, {0, 99999, "a parameter number"});
        setup.stores.parameters.entry[number] = read_parameter(file, value, setup);
        read.push_back(number);
    }
    // 1001 may be anywhere in the file, or in the backup.
    for (const int number : read)
        setup.stores.parameters.entry[number].value *=
            offsets::parameter_unit_mm(setup.stores.parameters, number);
}

void read_numbered(const TomlFile& file, const TomlValue& table, std::map<int, double>& store) {
    for (const auto& [key, value] : file.table(table).entries) {
        value.used = true;
        const std::string number = key.starts_with("#") ? key.substr(1) : key;
        store[whole_number(file, number, value, {1, 99999, "a variable number"})] =
            file.number(value);
    }
}

void read_switch(const TomlFile& file, const TomlValue& control, const char* name, bool& on) {
    const TomlValue* value = control.find(name);
    if (!value) return;
    if (value->kind != TomlValue::Kind::boolean)
        file.fail(*value, std::string(name) + " is true or false");
    on = value->truth;
}

/// C = { clamp = 10, release = 11, alarm = true }
void read_clamps(const TomlFile& file, const TomlValue& table, Setup& setup) {
    for (const auto& [key, value] : file.table(table).entries) {
        value.used = true;
        const auto axes = control_axes(setup);
        const auto axis = std::find_if(axes.begin(), axes.end(),
                                       [&name = key](const auto& a) { return a.name == name; });
        if (axis == axes.end()) file.fail(value, "'" + key + "' is not an axis of this machine");
        const auto code = [&, &codes = value](const char* name, int otherwise) {
            const double m = file.find_number(file.table(codes), name).value_or(otherwise);
            if (m < 0 || m > 999 || m != static_cast<int>(m))
                file.fail(codes, std::string(name) + " is an M code, 0 to 999");
            return static_cast<int>(m);
        };
        controller::ClampCode clamp{axis->axis, code("clamp", 10), code("release", 11), true};
        read_switch(file, value, "alarm", clamp.alarm);
        setup.clamps.push_back(clamp);
    }
}

void read_block_skip(const TomlFile& file, const TomlValue& value, std::vector<int>& on) {
    for (const double n : file.numbers(value)) {
        if (n < 1 || n > 9 || n != static_cast<int>(n))
            file.fail(value, "block_skip lists switches 1 to 9");
        on.push_back(static_cast<int>(n));
    }
}

void read_m_codes(const TomlFile& file, const TomlValue& value, std::vector<int>& codes) {
    for (const double m : file.numbers(value)) {
        if (!(m >= 0 && m <= 99999999) || m != std::floor(m))
            file.fail(value, "an M code is a whole number, 0 to 99999999");
        codes.push_back(static_cast<int>(m));
    }
}

/// [[first, last], ...] of variables from #1000 on.
void read_ranges(const TomlFile& file, const TomlValue& value,
                 std::vector<std::pair<int, int>>& ranges) {
    if (value.kind != TomlValue::Kind::array) file.fail(value, "variables lists pairs");
    for (const TomlValue& entry : value.items) {
        const std::vector<double> ends = file.numbers(entry);
        const bool right = ends.size() == 2 && ends[0] >= 1000 && ends[0] <= ends[1] &&
                           ends[1] <= 999999999 && ends[0] == std::floor(ends[0]) &&
                           ends[1] == std::floor(ends[1]);
        if (!right) file.fail(entry, "variables lists pairs [first, last] from 1000 on");
        ranges.emplace_back(static_cast<int>(ends[0]), static_cast<int>(ends[1]));
    }
}

void read_builder(const TomlFile& file, const TomlValue& table,
                  controller::BuilderProfile& builder) {
    if (const TomlValue* codes = table.find("g_codes"))
        for (const double g : file.numbers(*codes)) {
            const double tenfold = std::round(g * 10.0);
            if (!(g >= 0 && g < 1000) || std::abs(g * 10.0 - tenfold) > 1e-6)
                file.fail(*codes, "a G code is 0 to 999.9 with one decimal");
            if (controller::find_g_code(g))
                file.fail(*codes, "the control has one of these G codes itself");
            builder.add_g_code(static_cast<int>(tenfold));
        }
    if (const TomlValue* codes = table.find("m_codes")) read_m_codes(file, *codes, builder.m_codes);
    if (const TomlValue* codes = table.find("m_codes_after"))
        read_m_codes(file, *codes, builder.m_codes_after);
    if (const TomlValue* ranges = table.find("variables"))
        read_ranges(file, *ranges, builder.variables);
}

/// Generations of controls that differ in nesting limits and forms of M98 (docs/control.md).
interpreter::Dialect read_dialect(const TomlFile& file, const TomlValue& control) {
    const TomlValue* name = control.find("dialect");
    if (name && file.text(*name) == "hurco") return interpreter::hurco_dialect();
    if (name && file.text(*name) != "fanuc") file.fail(*name, "dialect is \"fanuc\" or \"hurco\"");
    const TomlValue* generation = control.find("generation");
    if (!generation || file.text(*generation) == "30i") return interpreter::fanuc_dialect();
    if (generation->text == "16i")
        return interpreter::fanuc_dialect(interpreter::ControlGeneration::fanuc_16i);
    if (generation->text == "0i-F")
        return interpreter::fanuc_dialect(interpreter::ControlGeneration::fanuc_0i_f);
    file.fail(*generation, "generation is \"16i\", \"30i\" or \"0i-F\"");
}

controller::VariableRounding read_variable_rounding(const TomlFile& file, const TomlValue& value) {
    for (const controller::VariableRoundingName& row : controller::variable_roundings)
        if (file.text(value) == row.name) return row.rounding;
    file.fail(value, "variable_rounding is \"none\", \"IS-A\", \"IS-B\" or \"IS-C\"");
}

void read_backup(const TomlFile& file, const TomlValue& value, const BackupReader& backup,
                 offsets::Stores& stores) {
    if (!backup) file.fail(value, "backups are not read here");
    const std::filesystem::path folder =
        std::filesystem::path(file.path()).parent_path() / file.text(value);
    backup(folder.string(), stores);
}

}  // namespace

void read_control(const TomlFile& file, const TomlValue& control, const BackupReader& backup,
                  Setup& setup) {
    setup.dialect = read_dialect(file, control);
    read_switch(file, control, "work_positions_with_length", setup.work_positions_with_length);
    read_switch(file, control, "work_offset_is_group_12", setup.work_offset_is_group_12);
    read_switch(file, control, "g89_feeds_to_initial", setup.g89_feeds_to_initial);
    read_switch(file, control, "g53_under_g91_moves", setup.g53_under_g91_moves);
    read_switch(file, control, "rapids_are_doglegs", setup.rapids_are_doglegs);
    if (const TomlValue* rounding = control.find("variable_rounding"))
        setup.variable_rounding = read_variable_rounding(file, *rounding);
    read_switch(file, control, "optional_stop", setup.optional_stop);
    read_switch(file, control, "threading", setup.threading);
    if (const TomlValue* table = control.find("builder"))
        read_builder(file, file.table(*table), setup.builder);
    if (const TomlValue* table = control.find("hurco")) read_hurco(file, file.table(*table), setup);
    if (const TomlValue* table = control.find("clamps")) read_clamps(file, *table, setup);
    if (const TomlValue* on = control.find("block_skip"))
        read_block_skip(file, *on, setup.block_skip);
    if (const TomlValue* frame = control.find("tcp_frame")) {
        if (file.text(*frame) != "start" && file.text(*frame) != "rotary_zero")
            file.fail(*frame, "tcp_frame is \"start\" or \"rotary_zero\"");
        setup.tcp_frame = frame->text == "rotary_zero" ? positioning::TcpFrame::rotary_zero
                                                       : positioning::TcpFrame::start;
    }
    if (const TomlValue* folder = control.find("backup"))
        read_backup(file, *folder, backup, setup.stores);
    if (const TomlValue* table = control.find("work_offsets"))
        read_work_offsets(file, *table, setup.stores.work);
    if (const TomlValue* table = control.find("fixture_offsets"))
        read_fixtures(file, *table, setup.stores.fixture);
    if (const TomlValue* table = control.find("tools"))
        read_tools(file, *table, setup.stores.tools);
    if (const TomlValue* table = control.find("parameters")) read_parameters(file, *table, setup);
    if (const TomlValue* table = control.find("variables"))
        read_numbered(file, *table, setup.stores.variables);
    if (const TomlValue* table = control.find("signals"))
        read_numbered(file, *table, setup.stores.signals);
}

}  // namespace trunnion::setup
