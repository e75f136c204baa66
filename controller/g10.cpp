// G10: work offsets, tool offsets, fixture offsets and parameters set by the program.
#include "controller/g10.h"

#include "controller/control_state.h"
#include "controller/g_codes.h"
#include "controller/g_handlers.h"
#include "offsets/parameter_units.h"

namespace trunnion {

namespace {

/// Axis words into a vector: overwritten under G90, added under G91.
void set_vector(ControlState& c, OffsetVector& vector) {
    for (const ControlAxis& entry : c.config.axes) {
        if (!c.words.has(letter_of(entry.axis))) continue;
        const double value = c.axis_word(entry.axis);
        vector[entry.axis] = c.absolute() ? value : vector[entry.axis] + value;
    }
}

int p_word(ControlState& c, int low, int high) {
    if (!c.words.has('P')) raise_alarm(31);
    const int p = c.whole_word('P');
    if (p < low || p > high) raise_alarm(31, c.words.column_of('P'));
    return p;
}

void set_work_offset(ControlState& c) {
    const int p = p_word(c, 0, 6);
    set_vector(c, p == 0 ? c.stores.work.external
                         : c.stores.work.standard[static_cast<std::size_t>(p - 1)]);
    c.read_work_offset();
}

void set_additional_offset(ControlState& c) {
    const int p = p_word(c, 1, static_cast<int>(c.stores.work.additional.size()));
    set_vector(c, c.stores.work.additional[static_cast<std::size_t>(p - 1)]);
    c.read_work_offset();
}

double& tool_value(ToolOffset& tool, int l) {
    switch (l) {
        case 10:
            return tool.length_geometry_mm;
        case 11:
            return tool.length_wear_mm;
        case 12:
            return tool.radius_geometry_mm;
        default:
            return tool.radius_wear_mm;
    }
}

void set_tool_offset(ControlState& c, int l) {
    const int p = p_word(c, 1, static_cast<int>(c.stores.tools.tool.size()) - 1);
    if (!c.words.has('R')) raise_alarm(32);
    double& value = tool_value(c.stores.tools.tool[static_cast<std::size_t>(p)], l);
    value = (c.absolute() ? 0.0 : value) + c.length_word('R');
    if (value > 9999.0 || value < -9999.0) raise_alarm(32, c.words.column_of('R'));
}

void set_fixture_offset(ControlState& c) {
    const int p = p_word(c, 1, 8);
    FixtureOffset& set = c.stores.fixture.set[static_cast<std::size_t>(p - 1)];
    for (const ControlAxis& entry : c.config.axes) {
        if (!c.words.has(letter_of(entry.axis))) continue;
        double& value = (entry.rotary ? set.reference_angles : set.offset)[entry.axis];
        value = (c.absolute() ? 0.0 : value) + c.axis_word(entry.axis);
    }
    c.fixture_changed();
}

}  // namespace

void g_data_setting(ControlState& c, const GCode&) {
    if (!c.words.has('L')) return set_tool_offset(c, 10);  // G10 P R: offset memory A
    switch (const int l = c.whole_word('L')) {
        case 2:
            return set_work_offset(c);
        case 20:
            return set_additional_offset(c);
        case 10:
        case 11:
        case 12:
        case 13:
            return set_tool_offset(c, l);
        case 21:
            return set_fixture_offset(c);
        case 3:
            c.data_entry = DataEntry::tool_life;
            return c.note("G10 L3: tool life data are read and not used");
        case 50:
        case 52:
            c.data_entry = DataEntry::parameters;
            return;
        default:
            raise_alarm(10, c.words.column_of('L'));
    }
}

void g_data_setting_end(ControlState& c, const GCode&) {
    c.data_entry = DataEntry::none;
}

void enter_data(ControlState& c, const BlockWords& block) {
    if (c.data_entry == DataEntry::tool_life) return;
    const SortedWords& w = c.words;
    if (block.sequence_number < 0 || !w.has('R')) raise_alarm(231);
    Parameter& parameter = c.stores.parameters.entry[block.sequence_number];
    if (!w.has('P'))
        parameter.value =
            w.get('R') * parameter_unit_mm(c.stores.parameters, block.sequence_number);
    else
        parameter.by_axis[c.whole_word('P')] = w.get('R');
    c.parameters_changed();
}

}  // namespace trunnion
