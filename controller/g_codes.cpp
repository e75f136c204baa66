#include "controller/g_codes.h"

#include <array>
#include <cmath>

#include "controller/g_handlers.h"

namespace trunnion {

namespace {

using enum ModalGroup;

constexpr GCode table[] = {
    {0, motion, Phase::motion, nullptr, "rapid positioning"},
    {10, motion, Phase::motion, nullptr, "linear interpolation"},
    {20, motion, Phase::motion, nullptr, "circular interpolation clockwise"},
    {30, motion, Phase::motion, nullptr, "circular interpolation counter-clockwise"},
    {40, one_shot, Phase::shot, g_dwell, "dwell"},
    {50, one_shot, Phase::shot, g_accepted, "high-speed machining, G5 P10000 / P0"},
    {51, one_shot, Phase::shot, g_accepted, "AI contour control"},
    {71, one_shot, Phase::shot, g_cylinder, "cylindrical interpolation"},
    {80, one_shot, Phase::shot, g_accepted, "look-ahead control"},
    {90, one_shot, Phase::reading, g_exact_stop, "exact stop"},
    {100, one_shot, Phase::shot, g_data_setting, "programmable data input"},
    {110, one_shot, Phase::reading, g_data_setting_end, "end of data input"},
    {121, polar_motion, Phase::shot, g_polar_motion, "polar coordinate interpolation"},
    {131, polar_motion, Phase::shot, g_polar_motion, "polar coordinate interpolation off"},
    {150, polar_words, Phase::reading, nullptr, "polar coordinate words off"},
    {160, polar_words, Phase::reading, g_polar_words, "polar coordinate words"},
    {170, plane, Phase::plane, g_plane, "XY plane"},
    {180, plane, Phase::plane, g_plane, "ZX plane"},
    {190, plane, Phase::plane, g_plane, "YZ plane"},
    {200, units, Phase::units, g_units, "inch"},
    {210, units, Phase::units, g_units, "mm"},
    {220, stored_stroke, Phase::reading, nullptr, "stored stroke check on"},
    {230, stored_stroke, Phase::reading, nullptr, "stored stroke check off"},
    {270, one_shot, Phase::shot, g_reference_check, "reference position check"},
    {280, one_shot, Phase::shot, g_reference, "to the reference position"},
    {290, one_shot, Phase::shot, g_from_reference, "from the reference position"},
    {300, one_shot, Phase::shot, g_reference, "to the 2nd to 4th reference position"},
    {310, one_shot, Phase::shot, g_skip, "skip function"},
    {390, one_shot, Phase::shot, g_corner_arc, "corner arc of cutter compensation"},
    {400, cutter, Phase::offsets, g_cutter, "cutter compensation off"},
    {410, cutter, Phase::offsets, g_cutter, "cutter compensation, tool left"},
    {412, cutter, Phase::offsets, g_five_axis_cutter, "cutter compensation for five axes, left"},
    {413, cutter, Phase::offsets, g_five_axis_cutter, "leading edge offset for five axes"},
    {414, cutter, Phase::offsets, g_five_axis_cutter, "the same as G41.2, type 2"},
    {415, cutter, Phase::offsets, g_five_axis_cutter, "the same for table machines, type 1"},
    {416, cutter, Phase::offsets, g_five_axis_cutter, "the same for mixed machines"},
    {420, cutter, Phase::offsets, g_cutter, "cutter compensation, tool right"},
    {422, cutter, Phase::offsets, g_five_axis_cutter, "cutter compensation for five axes, right"},
    {424, cutter, Phase::offsets, g_five_axis_cutter, "the same as G42.2, type 2"},
    {425, cutter, Phase::offsets, g_five_axis_cutter, "the same for table machines, type 1"},
    {426, cutter, Phase::offsets, g_five_axis_cutter, "the same for mixed machines"},
    {430, length, Phase::offsets, g_tool_length, "tool length compensation +"},
    {434, length, Phase::offsets, g_tool_centre, "tool centre point control, rotary words"},
    {435, length, Phase::offsets, g_tool_centre, "tool centre point control, tool axis vector"},
    {440, length, Phase::offsets, g_tool_length, "tool length compensation -"},
    {490, length, Phase::offsets, g_tool_length, "tool length compensation off"},
    {500, scaling, Phase::frame, g_scaling_off, "scaling off"},
    {501, mirror, Phase::shot, g_mirror_off, "programmable mirror image off"},
    {510, scaling, Phase::shot, g_scaling, "scaling"},
    {511, mirror, Phase::shot, g_mirror, "programmable mirror image"},
    {520, one_shot, Phase::shot, g_local_shift, "local coordinate system"},
    {530, one_shot, Phase::shot, g_machine_position, "machine coordinate position"},
    {531, one_shot, Phase::shot, g_tool_axis, "tool axis along the tilted plane's normal"},
    {536, one_shot, Phase::shot, g_tool_axis_keeping_tip, "the same with the tip kept"},
    {540, work_offset, Phase::work_offset, g_work_offset, "work coordinate system 1"},
    {541, work_offset, Phase::work_offset, g_work_offset, "additional work coordinates"},
    {542, fixture, Phase::work_offset, g_fixture_offset, "dynamic fixture offset"},
    {550, work_offset, Phase::work_offset, g_work_offset, "work coordinate system 2"},
    {560, work_offset, Phase::work_offset, g_work_offset, "work coordinate system 3"},
    {570, work_offset, Phase::work_offset, g_work_offset, "work coordinate system 4"},
    {580, work_offset, Phase::work_offset, g_work_offset, "work coordinate system 5"},
    {590, work_offset, Phase::work_offset, g_work_offset, "work coordinate system 6"},
    {610, path_mode, Phase::reading, nullptr, "exact stop mode"},
    {620, path_mode, Phase::reading, nullptr, "automatic corner override"},
    {630, path_mode, Phase::reading, nullptr, "tapping mode"},
    {640, path_mode, Phase::reading, nullptr, "cutting mode"},
    {680, rotation, Phase::shot, g_rotation, "coordinate rotation"},
    {682, rotation, Phase::shot, g_tilted_plane, "tilted working plane"},
    {683, rotation, Phase::shot, g_tilted_plane_by_tool, "tilted working plane by the tool axis"},
    {684, rotation, Phase::shot, g_tilted_plane, "tilted working plane, incremental"},
    {690, rotation, Phase::frame, g_rotation_cancel, "rotation, tilted plane off"},
    {730, ModalGroup::cycle, Phase::cycle, g_cycle, "pecking with chip breaking"},
    {740, ModalGroup::cycle, Phase::cycle, g_cycle, "left-hand tapping"},
    {760, ModalGroup::cycle, Phase::cycle, g_cycle, "fine boring"},
    {810, ModalGroup::cycle, Phase::cycle, g_cycle, "drilling"},
    {820, ModalGroup::cycle, Phase::cycle, g_cycle, "drilling with dwell"},
    {830, ModalGroup::cycle, Phase::cycle, g_cycle, "pecking"},
    {840, ModalGroup::cycle, Phase::cycle, g_cycle, "tapping"},
    {850, ModalGroup::cycle, Phase::cycle, g_cycle, "boring, feed out"},
    {860, ModalGroup::cycle, Phase::cycle, g_cycle, "boring, rapid out"},
    {870, ModalGroup::cycle, Phase::cycle, g_cycle, "back boring"},
    {880, ModalGroup::cycle, Phase::cycle, g_cycle, "boring, stop"},
    {890, ModalGroup::cycle, Phase::cycle, g_cycle, "boring with dwell, feed out"},
    {800, cycle, Phase::reading, nullptr, "canned cycle off"},
    {900, distance, Phase::reading, nullptr, "absolute words"},
    {910, distance, Phase::reading, nullptr, "incremental words"},
    {920, one_shot, Phase::shot, g_preset, "setting of the work coordinates"},
    {921, one_shot, Phase::shot, g_preset_cancel, "preset of the work coordinates"},
    {930, feed_mode, Phase::feed, g_feed_mode, "inverse time feed"},
    {940, feed_mode, Phase::feed, g_feed_mode, "feed per minute"},
    {950, feed_mode, Phase::feed, g_feed_mode, "feed per turn"},
    {960, surface_speed, Phase::speed, g_speed_mode, "constant surface speed"},
    {970, surface_speed, Phase::speed, g_speed_mode, "constant surface speed off"},
    {980, cycle_return, Phase::reading, nullptr, "cycle returns to the initial level"},
    {990, cycle_return, Phase::reading, nullptr, "cycle returns to level R"},
};

constexpr int highest_code10 = 10000;

/// Row of each code * 10, or -1.
std::array<std::int16_t, highest_code10> make_index() {
    std::array<std::int16_t, highest_code10> index;
    index.fill(-1);
    for (std::size_t i = 0; i < std::size(table); ++i)
        index[static_cast<std::size_t>(table[i].code10)] = static_cast<std::int16_t>(i);
    return index;
}
const std::array<std::int16_t, highest_code10> row_of = make_index();

}  // namespace

const GCode* find_g_code(double value) {
    const double tenfold = value * 10.0;
    if (!(tenfold >= 0.0) || tenfold > highest_code10 - 1) return nullptr;
    const int code10 = static_cast<int>(tenfold + 0.5);
    if (std::abs(tenfold - code10) > 1e-6) return nullptr;
    const int row = row_of[static_cast<std::size_t>(code10)];
    return row < 0 ? nullptr : &table[row];
}

std::span<const GCode> g_code_table() {
    return table;
}

}  // namespace trunnion
