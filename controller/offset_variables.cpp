#include "controller/offset_variables.h"

#include "controller/fixture_offset_codes.h"
#include "controller/work_frames.h"

namespace trunnion::controller {

namespace {

/// The store entry of a variable number.
struct Place {
    double* value = nullptr;
    bool length = true;  ///< in mm: read and written in the active unit
    bool* given = nullptr;
};

/// Tool offsets, memory C. Rows quoted from memory; 6000#3 V15 exchanges wear and geometry. D
/// offsets are #2401 and on with 6004#5 D10 only; else work offsets have those numbers.
struct ToolRange {
    int first, count;
    double offsets::ToolOffset::*wear_order;
    double offsets::ToolOffset::*v15_order;
};
constexpr ToolRange tool_ranges[] = {
    {2001, 200, &offsets::ToolOffset::length_wear_mm, &offsets::ToolOffset::length_geometry_mm},
    {2201, 200, &offsets::ToolOffset::length_geometry_mm, &offsets::ToolOffset::length_wear_mm},
    {2401, 200, &offsets::ToolOffset::radius_wear_mm, &offsets::ToolOffset::radius_geometry_mm},
    {2601, 200, &offsets::ToolOffset::radius_geometry_mm, &offsets::ToolOffset::radius_wear_mm},
    {10001, 999, &offsets::ToolOffset::length_wear_mm, &offsets::ToolOffset::length_geometry_mm},
    {11001, 999, &offsets::ToolOffset::length_geometry_mm, &offsets::ToolOffset::length_wear_mm},
    {12001, 999, &offsets::ToolOffset::radius_wear_mm, &offsets::ToolOffset::radius_geometry_mm},
    {13001, 999, &offsets::ToolOffset::radius_geometry_mm, &offsets::ToolOffset::radius_wear_mm},
};

Place tool_place(const ControlSettings& settings, offsets::ToolOffsets& tools, int number) {
    for (const ToolRange& range : tool_ranges) {
        const int n = number - range.first + 1;
        if (n < 1 || n > range.count || n >= static_cast<int>(tools.tool.size())) continue;
        const auto field = settings.wear_first ? range.v15_order : range.wear_order;
        offsets::ToolOffset& tool = tools.tool[static_cast<std::size_t>(n)];
        const bool of_length = field == &offsets::ToolOffset::length_wear_mm ||
                               field == &offsets::ToolOffset::length_geometry_mm;
        return {&(tool.*field), true, of_length ? &tool.length_given : &tool.radius_given};
    }
    return {};
}

/// Entry of axis number `n` (from 1) of a vector.
Place axis_place(const ControlSettings& settings, offsets::OffsetVector& vector, int n) {
    if (n < 1 || n > static_cast<int>(settings.axes.size())) return {};
    const ControlAxis& axis = settings.axes[static_cast<std::size_t>(n - 1)];
    return {&vector[axis.axis], !axis.rotary};
}

/// #2500 external, #2501 G54 .. #2506 G59 of the first axis, #2600 .. of the second, up to the
/// fourth; from memory.
bool is_work_by_axis(const ControlSettings& settings, int number) {
    return !settings.d_offsets_from_2401 && number >= 2500 && number <= 2806 && number % 100 <= 6;
}

/// #100301 external, #100351 G54 .. #100601 G59, #101001 G54.1 P1 .., 50 numbers each; from memory.
Place work_place_of_six_digits(const ControlSettings& settings, offsets::WorkOffsets& work,
                               int number) {
    const int n = (number - 1) % 50 + 1, set = (number - 100301) / 50;
    if (number < 100301 || !settings.has_six_digit_variables) return {};
    if (set == 0) return axis_place(settings, work.external, n);
    if (set <= 6) return axis_place(settings, work.standard[static_cast<std::size_t>(set - 1)], n);
    if (number < 101001 || number >= 101001 + 50 * 300) return {};
    return axis_place(settings, work.additional[static_cast<std::size_t>((number - 101001) / 50)],
                      n);
}

Place work_place(const ControlSettings& settings, offsets::WorkOffsets& work, int number) {
    if (is_work_by_axis(settings, number)) {
        const int set = number % 100, n = (number - 2400) / 100;
        return axis_place(
            settings, set == 0 ? work.external : work.standard[static_cast<std::size_t>(set - 1)],
            n);
    }
    if (number >= 100301) return work_place_of_six_digits(settings, work, number);
    if (number >= 5201 && number < 5341) {
        const int set = (number - 5201) / 20, n = (number - 5201) % 20 + 1;
        return axis_place(
            settings, set == 0 ? work.external : work.standard[static_cast<std::size_t>(set - 1)],
            n);
    }
    for (const auto& [first, sets] : {std::pair{7001, 48}, std::pair{14001, 300}}) {
        if (number < first || number >= first + 20 * sets) continue;
        const auto set = static_cast<std::size_t>((number - first) / 20);
        return axis_place(settings, work.additional[set], (number - first) % 20 + 1);
    }
    return {};
}

/// #5521.. P1 to #5661.. P8, in steps of 20 (assumed).
Place fixture_place(const ControlSettings& settings, offsets::FixtureOffsets& fixture, int number) {
    if (number < 5521 || number >= 5681) return {};
    offsets::FixtureOffset& set = fixture.set[static_cast<std::size_t>((number - 5521) / 20)];
    const int n = (number - 5521) % 20 + 1;
    if (n > static_cast<int>(settings.axes.size())) return {};
    const bool rotary = settings.axes[static_cast<std::size_t>(n - 1)].rotary;
    return axis_place(settings, rotary ? set.reference_angles : set.offset, n);
}

Place place_of(int number, const ControlSettings& settings, offsets::Stores& stores) {
    const int last_tool = settings.d_offsets_from_2401 ? 2800 : 2400;
    if (number < 2001 || (number > 2806 && number < 5201)) return {};
    if (number <= last_tool || (number >= 10001 && number <= 13999))
        return tool_place(settings, stores.tools, number);
    if (number >= 5521 && number < 5681) return fixture_place(settings, stores.fixture, number);
    return work_place(settings, stores.work, number);
}

}  // namespace

std::optional<double> offset_variable(int number, const Modal& modal, Frames& frames) {
    const Place place = place_of(number, modal.settings, frames.stores());
    if (!place.value) return std::nullopt;
    return place.length ? *place.value / modal.units.unit_mm : *place.value;
}

bool set_offset_variable(int number, double value, const Modal& modal, Frames& frames,
                         Mover& mover) {
    const Place place = place_of(number, modal.settings, frames.stores());
    if (!place.value) return false;
    *place.value = place.length ? value * modal.units.unit_mm : value;
    if (place.given) *place.given = true;
    if (number >= 5521 && number < 5681)
        fixture_sets_changed(modal, frames, mover);
    else if ((number >= 5201 && number <= 8000) || number >= 14001 ||
             is_work_by_axis(modal.settings, number))
        work_offset_changed(modal, frames, mover);
    return true;
}

}  // namespace trunnion::controller
