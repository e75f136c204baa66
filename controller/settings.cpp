#include "controller/settings.h"

#include <algorithm>

#include "base/units.h"
#include "offsets/axis_numbers.h"
#include "offsets/whole_parameter.h"

namespace trunnion::controller {

namespace {

constexpr double default_corner_jump = 400.0;  // mm/min, deg/min: usual in handbooks (assumed)

double for_axis(const offsets::Parameters& parameters, int number, int axis_number) {
    return offsets::value_of_axis(parameters, number, axis_number).value_or(0.0);
}

void decode_axes(const offsets::Parameters& parameters, const ControlConfig& config,
                 ControlSettings& s) {
    for (std::size_t k = 0; k < config.axes.size(); ++k) {
        const int number = static_cast<int>(k) + 1;
        const std::size_t i = index_of(config.axes[k].axis);
        for (int r = 0; r < 4; ++r)
            s.reference[static_cast<std::size_t>(r)][i] = for_axis(parameters, 1240 + r, number);
        s.overrun[i] = for_axis(parameters, 5440, number);
        const double jump = for_axis(parameters, 1783, number);
        s.corner_jump[i] = jump > 0.0 ? jump : default_corner_jump;
        const auto roa = offsets::bits_of_parameter(for_axis(parameters, 1008, number));
        if (config.axes[k].rotary && (roa & 1U))
            s.rollover = static_cast<std::uint16_t>(s.rollover | (1U << i));
        if (config.axes[k].rotary && (roa & 2U))
            s.rollover_signed = static_cast<std::uint16_t>(s.rollover_signed | (1U << i));
    }
}

cutter::CutterSettings decode_cutter(const offsets::Parameters& parameters) {
    cutter::CutterSettings out;
    out.startup_type_b = parameters.bit(5003, 0);
    out.startup_type_c = parameters.bit(5003, 1);
    out.circular_corners = parameters.bit(19607, 2);
    out.blocks_ahead = static_cast<int>(std::clamp(parameters.get(19625, 3.0), 3.0, 8.0));
    return out;
}

}  // namespace

void sort_axes(std::vector<ControlAxis>& axes, const offsets::Parameters& parameters) {
    const auto rank = [&](const ControlAxis& axis) {
        const auto names = parameters.entry.find(1020);
        if (names != parameters.entry.end())
            for (const auto& [number, code] : names->second.by_axis)
                if (static_cast<int>(code) == letter_of(axis.axis)) return number;
        return (axis.auxiliary ? 200 : 100) + static_cast<int>(index_of(axis.axis));
    };
    std::stable_sort(axes.begin(), axes.end(),
                     [&](const ControlAxis& a, const ControlAxis& b) { return rank(a) < rank(b); });
}

void take_strokes(std::vector<ControlAxis>& axes, const offsets::Parameters& parameters) {
    for (std::size_t k = 0; k < axes.size(); ++k) {
        ControlAxis& axis = axes[k];
        const double unit = axis.rotary ? rad_from_deg(1.0) : 1.0;
        const int number = static_cast<int>(k) + 1;
        const auto top = offsets::value_of_axis(parameters, 1320, number);
        const auto bottom = offsets::value_of_axis(parameters, 1321, number);
        const bool none = top && bottom && *top < *bottom;
        if (top) axis.max = none ? std::optional<double>() : *top * unit;
        if (bottom) axis.min = none ? std::optional<double>() : *bottom * unit;
        if (const auto speed = offsets::value_of_axis(parameters, 1420, number);
            speed && *speed > 0.0)
            axis.rapid_speed = *speed * unit / 60.0;
    }
}

ControlSettings decode_settings(const offsets::Parameters& parameters,
                                const ControlConfig& config) {
    ControlSettings s;
    s.axes = config.axes;
    for (const ControlAxis& axis : config.axes)
        s.axis_letters |= 1U << (letter_of(axis.axis) - 'A');
    s.family = config.dialect.family;
    s.hurco = config.hurco;
    s.threading = config.threading;
    s.builder = config.builder;
    s.has_rotary_axis = std::any_of(s.axes.begin(), s.axes.end(), [](const ControlAxis& axis) {
        return axis.rotary && !axis.auxiliary;
    });
    s.g89_feeds_to_initial = config.g89_feeds_to_initial;
    s.tcp_frame = config.tcp_frame;
    if (config.dialect.generation == interpreter::ControlGeneration::fanuc_16i)
        s.largest_position = 99999999.0;
    s.has_six_digit_variables =
        !s.is_hurco() && config.dialect.generation != interpreter::ControlGeneration::fanuc_16i;
    s.g53_under_g91_moves = config.g53_under_g91_moves;
    s.rapids_are_doglegs =
        s.is_hurco() ? !config.hurco.rapids_are_interpolated : config.rapids_are_doglegs;
    s.variable_rounding = config.variable_rounding;
    s.bare_is_noted = !parameters.find(3401);
    s.bare_is_unit = s.bare_is_noted || parameters.bit(3401, 0);
    s.duplicates_alarm = parameters.bit(3403, 6);
    s.arc_needs_centre = parameters.bit(3403, 5);
    s.arc_tolerance_mm = parameters.get(3410);
    s.peck_return_mm = parameters.get(5114, 1.0);
    s.peck_clearance_mm = parameters.get(5115, 1.0);
    s.length_shifts = parameters.bit(5006, 6) || (s.is_hurco() && s.hurco.length_from_tool_change);
    s.length_axis_type = parameters.bit(5001, 0) ? 2 : parameters.bit(5001, 1) ? 1 : 0;
    s.radius_is_diameter = parameters.bit(5004, 2);
    s.cutter = decode_cutter(parameters);
    s.work_positions_with_length = config.work_positions_with_length;
    s.work_offset_is_group_12 = config.work_offset_is_group_12;
    s.wear_first = parameters.bit(6000, 3);
    s.d_offsets_from_2401 = parameters.bit(6004, 5);
    s.least_surface_rpm = parameters.get(3771);
    if (const double most = parameters.get(3772); most > 0.0) s.most_rpm = most;
    s.measuring = {parameters.get(6241), parameters.get(6251), parameters.get(6254)};
    s.surface_axis_number = std::max(1, offsets::whole_parameter(parameters.get(3770)));
    decode_axes(parameters, config, s);
    return s;
}

}  // namespace trunnion::controller
