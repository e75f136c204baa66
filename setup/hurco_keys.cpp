#include "setup/hurco_keys.h"

#include "offsets/pivot_parameters.h"
#include "setup/toml_text.h"

namespace trunnion::setup {

namespace {

using controller::HurcoChoices;

struct SwitchKey {
    const char* name;
    bool HurcoChoices::*on;
};
constexpr SwitchKey switches[] = {
    {"length_from_tool_change", &HurcoChoices::length_from_tool_change},
    {"g49_keeps_tool_length", &HurcoChoices::g49_keeps_tool_length},
    {"rapids_are_interpolated", &HurcoChoices::rapids_are_interpolated},
    {"m128_keeps_tip_between_ends", &HurcoChoices::m128_keeps_tip_between_ends},
    {"planes_stack", &HurcoChoices::planes_stack},
    {"g68_2_moved_axes", &HurcoChoices::g68_2_moved_axes},
    {"g86_feeds_out", &HurcoChoices::g86_feeds_out},
    {"g98_feeds_from_r", &HurcoChoices::g98_feeds_from_r},
    {"clamps_alarm", &HurcoChoices::clamps_alarm},
};

struct TiltName {
    const char* name;
    positioning::Branch tilt;
};
constexpr TiltName tilts[] = {{"nearest", positioning::Branch::nearest},
                              {"positive", positioning::Branch::positive},
                              {"negative", positioning::Branch::negative}};

void read_tilt(const TomlFile& file, const TomlValue& value, HurcoChoices& hurco) {
    for (const TiltName& row : tilts)
        if (file.text(value) == row.name) {
            hurco.tilt = row.tilt;
            return;
        }
    file.fail(value, "tilt is \"nearest\", \"positive\" or \"negative\"");
}

void read_numbers(const TomlFile& file, const TomlValue& table, HurcoChoices& hurco) {
    if (const auto mm = file.find_number(table, "back_off_mm")) hurco.back_off_mm = *mm;
    if (const auto part = file.find_number(table, "second_touch_feed"))
        hurco.second_touch_feed = *part;
    hurco.tool_change_z_mm = file.find_number(table, "tool_change_z_mm");
    if (!(hurco.back_off_mm > 0.0 && hurco.second_touch_feed > 0.0))
        file.fail(table, "back_off_mm and second_touch_feed are above 0");
}

void read_centrelines(const TomlFile& file, const TomlValue& table, Setup& setup) {
    for (const auto& [key, value] : file.table(table).entries) {
        value.used = true;
        const auto axis = setup.machine.chain.names().find(key);
        if (!axis || !is_rotary(*axis))
            file.fail(value, "'" + key + "' is not a rotary axis of this machine");
        Centreline& line = setup.centrelines[*axis];
        for (const auto& [letter, number] : file.table(value).entries) {
            number.used = true;
            if (letter.size() != 1 || letter[0] < 'X' || letter[0] > 'Z')
                file.fail(number, "a centreline has two of X, Y and Z");
            line[static_cast<std::size_t>(letter[0] - 'X')] = file.number(number);
        }
    }
}

/// Moves `point_mm` onto the line. False when the line specifies the coordinate along its own
/// direction or lacks another one.
bool put_on_line(const Centreline& line, const Vector3& direction, Vector3& point_mm) {
    for (int k = 0; k < 3; ++k) {
        const auto& place = line[static_cast<std::size_t>(k)];
        const bool along = std::abs(direction[k]) > 1.0 - 1e-9;
        if (along == place.has_value()) return false;
        if (place) point_mm[k] = *place;
    }
    return true;
}

}  // namespace

void read_hurco(const TomlFile& file, const TomlValue& table, Setup& setup) {
    HurcoChoices& hurco = setup.hurco;
    if (const TomlValue* nc = table.find("nc")) {
        hurco.bnc = file.text(*nc) == "bnc";
        if (!hurco.bnc && nc->text != "isnc") file.fail(*nc, "nc is \"isnc\" or \"bnc\"");
    }
    for (const SwitchKey& key : switches) {
        const TomlValue* value = table.find(key.name);
        if (!value) continue;
        if (value->kind != TomlValue::Kind::boolean)
            file.fail(*value, std::string(key.name) + " is true or false");
        hurco.*key.on = value->truth;
    }
    if (const TomlValue* tilt = table.find("tilt")) read_tilt(file, *tilt, hurco);
    read_numbers(file, table, hurco);
    if (const TomlValue* lines = table.find("centreline")) read_centrelines(file, *lines, setup);
}

std::string believe_centrelines(const Setup& setup, offsets::Parameters& parameters) {
    if (setup.centrelines.empty()) return {};
    std::vector<Axis> order;
    for (const kinematics::AxisGeometry& axis : setup.machine.chain.axes())
        if (is_letter(axis)) order.push_back(axis.axis);
    auto pivot = offsets::decode_pivot(parameters, order);
    if (!pivot || pivot->unit != offsets::MechanicalUnit::table_table)
        return "centrelines are those of two rotary axes of a table";
    Vector3 first = pivot->table_point_mm, second = first + pivot->table_offset_mm;
    for (const auto& [axis, line] : setup.centrelines) {
        const bool is_first = axis == pivot->first.axis;
        if (!put_on_line(line, (is_first ? pivot->first : pivot->second).line,
                         is_first ? first : second))
            return std::string("the centreline of ") + letter_of(axis) +
                   " needs the two coordinates across it";
    }
    pivot->table_point_mm = first;
    pivot->table_offset_mm = second - first;
    offsets::encode_pivot(*pivot, parameters, order);
    return {};
}

std::string hurco_text(const Setup& setup) {
    const HurcoChoices& hurco = setup.hurco;
    const HurcoChoices defaults;
    std::string out;
    if (hurco.bnc) out += "nc = \"bnc\"\n";
    for (const SwitchKey& key : switches)
        if (hurco.*key.on != defaults.*key.on)
            out += std::string(key.name) + (hurco.*key.on ? " = true\n" : " = false\n");
    for (const TiltName& row : tilts)
        if (hurco.tilt == row.tilt && hurco.tilt != defaults.tilt)
            out += "tilt = " + toml_quoted(row.name) + '\n';
    if (hurco.back_off_mm != defaults.back_off_mm)
        out += "back_off_mm = " + shortest(hurco.back_off_mm) + '\n';
    if (hurco.second_touch_feed != defaults.second_touch_feed)
        out += "second_touch_feed = " + shortest(hurco.second_touch_feed) + '\n';
    if (hurco.tool_change_z_mm)
        out += "tool_change_z_mm = " + shortest(*hurco.tool_change_z_mm) + '\n';
    for (const auto& [axis, line] : setup.centrelines) {
        std::string place;
        for (std::size_t k = 0; k < 3; ++k)
            if (line[k])
                place += (place.empty() ? "" : ", ") + std::string(1, "XYZ"[k]) + " = " +
                         shortest(*line[k]);
        out += std::string("centreline.") + letter_of(axis) + " = { " + place + " }\n";
    }
    return out.empty() ? out : "\n[control.hurco]\n" + out;
}

}  // namespace trunnion::setup
