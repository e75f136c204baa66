#include "controller/offset_variables.h"

namespace trunnion {

namespace {

/// A store's entry behind a variable number.
struct Place {
    double* value = nullptr;
    bool length = true;  ///< in mm: read and written in the unit in force
};

/// Tool offsets, memory C. Rows from facts/control.md 2.5 [C]; 6000#3 V15 swaps wear and geometry.
struct ToolRange {
    int first, count;
    double ToolOffset::*wear_order;
    double ToolOffset::*v15_order;
};
constexpr ToolRange tool_ranges[] = {
    {2001, 200, &ToolOffset::length_wear_mm, &ToolOffset::length_geometry_mm},
    {2201, 200, &ToolOffset::length_geometry_mm, &ToolOffset::length_wear_mm},
    {10001, 999, &ToolOffset::length_wear_mm, &ToolOffset::length_geometry_mm},
    {11001, 999, &ToolOffset::length_geometry_mm, &ToolOffset::length_wear_mm},
    {12001, 999, &ToolOffset::radius_wear_mm, &ToolOffset::radius_geometry_mm},
    {13001, 999, &ToolOffset::radius_geometry_mm, &ToolOffset::radius_wear_mm},
};

Place tool_place(ControlState& c, int number) {
    for (const ToolRange& range : tool_ranges) {
        const int n = number - range.first + 1;
        if (n < 1 || n > range.count || n >= static_cast<int>(c.stores.tools.tool.size())) continue;
        const auto field = c.settings.wear_first ? range.v15_order : range.wear_order;
        return {&(c.stores.tools.tool[static_cast<std::size_t>(n)].*field), true};
    }
    return {};
}

/// Entry of axis number `n` (from 1) of a vector.
Place axis_place(ControlState& c, OffsetVector& vector, int n) {
    if (n < 1 || n > static_cast<int>(c.config.axes.size())) return {};
    const ControlAxis& axis = c.config.axes[static_cast<std::size_t>(n - 1)];
    return {&vector[axis.axis], !axis.rotary};
}

Place work_place(ControlState& c, int number) {
    WorkOffsets& work = c.stores.work;
    if (number >= 5201 && number < 5341) {
        const int set = (number - 5201) / 20, n = (number - 5201) % 20 + 1;
        return axis_place(
            c, set == 0 ? work.external : work.standard[static_cast<std::size_t>(set - 1)], n);
    }
    for (const auto& [first, sets] : {std::pair{7001, 48}, std::pair{14001, 300}}) {
        if (number < first || number >= first + 20 * sets) continue;
        const auto set = static_cast<std::size_t>((number - first) / 20);
        return axis_place(c, work.additional[set], (number - first) % 20 + 1);
    }
    return {};
}

/// #5521.. P1 to #5661.. P8, 20 apart (facts/control.md 2.2, low confidence).
Place fixture_place(ControlState& c, int number) {
    if (number < 5521 || number >= 5681) return {};
    FixtureOffset& set = c.stores.fixture.set[static_cast<std::size_t>((number - 5521) / 20)];
    const int n = (number - 5521) % 20 + 1;
    if (n > static_cast<int>(c.config.axes.size())) return {};
    const bool rotary = c.config.axes[static_cast<std::size_t>(n - 1)].rotary;
    return axis_place(c, rotary ? set.reference_angles : set.offset, n);
}

Place place_of(ControlState& c, int number) {
    if (number < 2001 || (number > 2400 && number < 5201)) return {};
    if (number <= 2400 || (number >= 10001 && number <= 13999)) return tool_place(c, number);
    if (number >= 5521 && number < 5681) return fixture_place(c, number);
    return work_place(c, number);
}

}  // namespace

bool read_offset_variable(const ControlState& c, int number, double& value) {
    // The places are the same for reading; nothing is changed through them here.
    const Place place = place_of(const_cast<ControlState&>(c), number);
    if (!place.value) return false;
    value = place.length ? *place.value / c.unit_mm : *place.value;
    return true;
}

bool write_offset_variable(ControlState& c, int number, double value) {
    const Place place = place_of(c, number);
    if (!place.value) return false;
    *place.value = place.length ? value * c.unit_mm : value;
    if (number >= 5521 && number < 5681)
        c.fixture_changed();
    else if (number >= 5201 && number <= 8000)
        c.read_work_offset();
    else if (number >= 14001)
        c.read_work_offset();
    return true;
}

}  // namespace trunnion
