#include "controller/data_setting.h"

#include "controller/alarms.h"
#include "controller/fixture_offset_codes.h"
#include "controller/work_frames.h"
#include "offsets/parameter_units.h"

namespace trunnion::controller {

namespace {

int p_word(const SortedWords& words, int low, std::size_t high) {
    if (!words.has('P')) raise_alarm(31);
    const int p = words.whole('P');
    if (p < low || p > static_cast<int>(high)) raise_alarm(31, words.column_of('P'));
    return p;
}

/// Writes axis words into a vector: replaced under G90, added under G91.
void set_vector(const SortedWords& words, const Modal& modal, offsets::OffsetVector& vector) {
    for (const ControlAxis& entry : modal.settings.axes) {
        if (!words.has(entry.axis)) continue;
        const double value = words.axis_value(entry.axis);
        vector[entry.axis] = modal.absolute() ? value : vector[entry.axis] + value;
    }
}

offsets::OffsetVector& work_offset(const SortedWords& words, offsets::WorkOffsets& work,
                                   bool additional) {
    if (additional) {
        const int p = p_word(words, 1, work.additional.size());
        return work.additional[static_cast<std::size_t>(p - 1)];
    }
    const int p = p_word(words, 0, 6);
    return p == 0 ? work.external : work.standard[static_cast<std::size_t>(p - 1)];
}

double& tool_value(offsets::ToolOffset& tool, int l) {
    switch (l) {
        case 10: return tool.length_geometry_mm;
        case 11: return tool.length_wear_mm;
        case 12: return tool.radius_geometry_mm;
        default: return tool.radius_wear_mm;
    }
}

void set_tool_offset(const SortedWords& words, const Modal& modal, offsets::ToolOffsets& tools,
                     int l) {
    const int p = p_word(words, 1, tools.tool.size() - 1);
    if (!words.has('R')) raise_alarm(32);
    offsets::ToolOffset& tool = tools.tool[static_cast<std::size_t>(p)];
    (l == 10 || l == 11 ? tool.length_given : tool.radius_given) = true;
    double& value = tool_value(tool, l);
    value = (modal.absolute() ? 0.0 : value) + words.length_mm('R');
    if (value > 9999.0 || value < -9999.0) raise_alarm(32, words.column_of('R'));
}

void set_fixture_set(const SortedWords& words, const Modal& modal,
                     offsets::FixtureOffsets& fixture) {
    const int p = p_word(words, 1, fixture.set.size());
    offsets::FixtureOffset& set = fixture.set[static_cast<std::size_t>(p - 1)];
    for (const ControlAxis& entry : modal.settings.axes) {
        if (!words.has(entry.axis)) continue;
        double& value = (entry.rotary ? set.reference_angles : set.offset)[entry.axis];
        value = (modal.absolute() ? 0.0 : value) + words.axis_value(entry.axis);
    }
}

}  // namespace

DataEntry set_data(const SortedWords& words, const Modal& modal, Frames& frames, Mover& mover) {
    offsets::Stores& stores = frames.stores();
    const int l = words.has('L') ? words.whole('L') : 10;  // G10 P R: tool offset memory A
    switch (l) {
        case 2:
        case 20:
            set_vector(words, modal, work_offset(words, stores.work, l == 20));
            work_offset_changed(modal, frames, mover);
            return DataEntry::none;
        case 1:  // another spelling of L11 (B-63124EN/01 p. 236)
            set_tool_offset(words, modal, stores.tools, 11);
            return DataEntry::none;
        case 10:
        case 11:
        case 12:
        case 13: set_tool_offset(words, modal, stores.tools, l); return DataEntry::none;
        case 21:
            set_fixture_set(words, modal, stores.fixture);
            fixture_sets_changed(modal, frames, mover);
            return DataEntry::none;
        case 3:
            mover.note("G10 L3: tool life data are read and not used");
            return DataEntry::tool_life;
        case 50:
        case 52:
            if (modal.settings.is_hurco()) raise_alarm(9003, "G10 L52", words.column_of('L'));
            return DataEntry::parameters;
        default: raise_alarm(10, words.column_of('L'));
    }
}

void enter_parameter(const SortedWords& words, int sequence_number,
                     offsets::Parameters& parameters) {
    if (sequence_number < 0 || !words.has('R')) raise_alarm(231);
    offsets::Parameter& parameter = parameters.entry[sequence_number];
    if (!words.has('P'))
        parameter.value = words.get('R') * offsets::parameter_unit_mm(parameters, sequence_number);
    else
        parameter.by_axis[words.whole('P')] = words.get('R');
}

}  // namespace trunnion::controller
